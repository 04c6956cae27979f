// BOV, "brick of values": a text header beside one file of values.
//
// Keys after "Creating a header file for brick of values",
// https://visit-sphinx-github-user-manual.readthedocs.io/en/develop/data_into_visit/BOVFormat.html
#include "index/error.h"
#include "index/lower_case.h"
#include "index/readers/formats/data_parts.h"
#include "index/readers/formats/named_file.h"
#include "index/readers/formats/own_formats.h"
#include "index/readers/formats/series/joined_blocks.h"
#include "index/readers/formats/stored_file.h"
#include "index/readers/formats/text_header.h"
#include "index/readers/formats/unread_fields.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>
#include <optional>
#include <set>
#include <string_view>
#include <utility>

namespace isochron::index {
namespace {

namespace fs = std::filesystem;

constexpr std::array<std::pair<std::string_view, StoredType>, 7> kBovTypes{{
    {"byte", StoredType::u8},
    {"short", StoredType::i16},
    {"int", StoredType::i32},
    {"long", StoredType::i64},
    {"float", StoredType::f32},
    {"real", StoredType::f32},
    {"double", StoredType::f64},
}};

class BovHeader {
  public:
    explicit BovHeader(const fs::path& path) : file_(path.string()) {
        constexpr std::size_t kMost = 1 << 16;
        const std::string head = head_of(path, kMost);
        for (std::size_t at = 0; at < head.size();) {
            const std::string_view line = take_line(head, at);
            if (auto field = field_of(line.substr(0, line.find('#')), ':'))
                fields_[lower_case(field->key)] = std::move(field->value);
        }
        if (!fields_.contains("data_file") || !fields_.contains("data_size"))
            throw Error("{}: not BOV: no DATA_FILE or no DATA_SIZE", file_);
    }

    std::string text(const std::string& key, const std::string& otherwise = "") const {
        const auto found = fields_.find(key);
        return found == fields_.end() ? otherwise : found->second;
    }
    std::optional<glm::dvec3> vec3(const std::string& key) const {
        const auto numbers = numbers_of(text(key), key, file_);
        if (numbers.empty())
            return std::nullopt;
        if (numbers.size() != 3)
            throw Error("{}: {} has {} numbers, expected 3", file_, key, numbers.size());
        return glm::dvec3(numbers[0], numbers[1], numbers[2]);
    }
    std::int64_t integer(const std::string& key, std::int64_t otherwise) const {
        const auto numbers = integers_of(text(key), key, file_);
        if (numbers.empty())
            return otherwise;
        if (numbers.size() != 1 || numbers[0] < 0)
            throw Error("{}: {} {}, expected 0 or more", file_, key, excerpt(text(key)));
        return numbers[0];
    }

    /// Fields that none of these keys are, with their values.
    std::vector<std::string> others(const std::set<std::string_view>& keys) const {
        return fields_besides(keys, fields_);
    }

  private:
    std::string file_;
    std::map<std::string, std::string> fields_;
};

/// The whole brick, or one of the bricklets that it is cut into, each in a file of its own.
struct Bricklet {
    std::array<std::int64_t, 3> whole{}, sizes{};
    std::array<std::int64_t, 3> begin{}; ///< its first value in the whole
    fs::path data;
};

void place_brick(const BovHeader& header, const Bricklet& brick, const std::string& name,
                 SeriesInfo& info) {
    const auto size = header.vec3("brick_size");
    const glm::dvec3 origin = header.vec3("brick_origin").value_or(glm::dvec3(0));
    const std::string centering = lower_case(header.text("centering", "zonal"));
    if (centering != "zonal" && centering != "nodal")
        throw Error("{}: CENTERING {}, expected zonal or nodal", name, excerpt(centering));
    const bool cells = centering == "zonal";
    glm::dmat3 steps(1.0);
    info.grid.origin = origin;
    for (int axis = 0; axis < 3; ++axis) {
        const auto i = static_cast<std::size_t>(axis);
        if (size)
            steps[axis][axis] =
                (*size)[axis] / static_cast<double>(brick.whole[i] - (cells ? 0 : 1));
        info.grid.origin[axis] +=
            steps[axis][axis] * (static_cast<double>(brick.begin[i]) + (cells ? 0.5 : 0.0));
    }
    set_axes(info.grid, steps, name);
    if (cells)
        info.notes.push_back("values of cells: taken at the cells' centers");
    static const std::set<std::string_view> kRead{
        "time",         "data_file",      "data_size",      "data_format", "variable",
        "data_endian",  "centering",      "brick_origin",   "brick_size",  "byte_offset",
        "divide_brick", "data_bricklets", "data_components"};
    if (auto note = note_on_unread(header.others(kRead)))
        info.notes.push_back(std::move(*note));
}

StoredArray array_of(const BovHeader& header, const std::string& name) {
    const std::string type = lower_case(header.text("data_format", "float"));
    const auto known = std::ranges::find_if(
        kBovTypes, [&](const auto& entry) { return type.starts_with(entry.first); });
    if (known == kBovTypes.end())
        throw Error("{}: DATA_FORMAT {}, expected BYTE, SHORT, INT, LONG, FLOAT or DOUBLE", name,
                    excerpt(type));
    std::string variable = header.text("variable", "values");
    std::erase(variable, '"');
    StoredArray array{variable, known->second};
    const std::int64_t components = header.integer("data_components", 1);
    if (components < 1 || components > 64)
        throw Error("{}: DATA_COMPONENTS {}, expected 1 to 64", name, components);
    array.components = static_cast<std::uint32_t>(components);
    return array;
}

std::unique_ptr<VolumeFile> open_brick(const BovHeader& header, const fs::path& path,
                                       const Bricklet& brick, const ReadOptions& options) {
    const std::string name = path.string();
    SeriesInfo info;
    info.grid.vertices = checked_vertices(brick.sizes, name);
    place_brick(header, brick, name, info);
    StoredLayout layout;
    layout.array = array_of(header, name);
    layout.data = brick.data;
    layout.big_endian = lower_case(header.text("data_endian", "little")) == "big";
    const auto skipped = static_cast<std::uint64_t>(header.integer("byte_offset", 0));
    if (is_gzip(layout.data)) {
        layout.compression = Compression::deflate;
        layout.skip = skipped;
    } else {
        layout.offset = skipped;
    }
    if (const auto time = numbers_of(header.text("time"), "TIME", name); time.size() == 1)
        info.times = {time.front()};
    return open_stored(path, std::move(info), layout, options);
}

std::array<std::int64_t, 3> three_sizes(const BovHeader& header, const char* key,
                                        const std::string& name) {
    const auto sizes = integers_of(header.text(lower_case(key)), key, name);
    if (sizes.size() != 3)
        throw Error("{}: {} has {} numbers, expected 3", name, key, sizes.size());
    return {sizes[0], sizes[1], sizes[2]};
}

/// The bricklets in the order of their files' numbers, from 0: x fastest.
std::vector<Bricklet> bricklets_of(const BovHeader& header, const Bricklet& whole,
                                   const fs::path& path) {
    const std::string name = path.string();
    constexpr std::int64_t kMost = 100'000;
    Bricklet one = whole;
    one.sizes = three_sizes(header, "DATA_BRICKLETS", name);
    std::array<std::int64_t, 3> along{};
    std::int64_t count = 1;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        if (one.sizes[axis] < 1 || whole.sizes[axis] % one.sizes[axis] != 0)
            throw Error("{}: DATA_BRICKLETS {}, expected a divisor of {}", name, one.sizes[axis],
                        whole.sizes[axis]);
        along[axis] = whole.sizes[axis] / one.sizes[axis];
        count = along[axis] > kMost ? kMost + 1 : std::min(count * along[axis], kMost + 1);
    }
    if (count > kMost)
        throw Error("{}: more than {} bricklets", name, kMost);
    const auto files =
        numbered_names(fmt::format("{} 0 {} 1", header.text("data_file"), count - 1), name);
    std::vector<Bricklet> bricklets;
    for (const std::string& file : files) {
        const auto number = static_cast<std::int64_t>(bricklets.size());
        one.begin = {number % along[0] * one.sizes[0], number / along[0] % along[1] * one.sizes[1],
                     number / along[0] / along[1] * one.sizes[2]};
        one.data = file_named_in(path, file);
        bricklets.push_back(one);
    }
    return bricklets;
}

} // namespace

std::unique_ptr<VolumeFile> open_bov(const fs::path& path, const ReadOptions& options) {
    const std::string name = path.string();
    const BovHeader header(path);
    const auto sizes = three_sizes(header, "DATA_SIZE", name);
    checked_vertices(sizes, name);
    const Bricklet whole{sizes, sizes, {}, file_named_in(path, header.text("data_file"))};
    if (!is_numbered(header.text("data_file")))
        return open_brick(header, path, whole, options);
    std::vector<SeriesFile> parts;
    for (const Bricklet& brick : bricklets_of(header, whole, path))
        parts.push_back({.path = brick.data,
                         .open =
                             [header, path, brick](const fs::path&, const ReadOptions& asked) {
                                 return open_brick(header, path, brick, asked);
                             },
                         .time = {}});
    return join_blocks(std::move(parts), options);
}

} // namespace isochron::index
