// BOV, "brick of values": a text header beside one file of values.
//
// Keys after "Creating a header file for brick of values",
// https://visit-sphinx-github-user-manual.readthedocs.io/en/develop/data_into_visit/BOVFormat.html
#include "index/error.h"
#include "index/formats/readers.h"
#include "index/formats/stored_file.h"
#include "index/formats/text_header.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>
#include <optional>
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
            const std::size_t end = std::min(head.find('\n', at), head.size());
            std::string_view line = std::string_view(head).substr(at, end - at);
            at = end + 1;
            line = trimmed(line.substr(0, line.find('#')));
            const std::size_t colon = line.find(':');
            if (colon != line.npos)
                fields_[lower_case(trimmed(line.substr(0, colon)))] =
                    trimmed(line.substr(colon + 1));
        }
        if (!fields_.contains("data_file") || !fields_.contains("data_size"))
            throw Error(fmt::format("{}: not BOV: no DATA_FILE or no DATA_SIZE", file_));
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
            throw Error(
                fmt::format("{}: {} has {} numbers, expected 3", file_, key, numbers.size()));
        return glm::dvec3(numbers[0], numbers[1], numbers[2]);
    }
    std::int64_t integer(const std::string& key, std::int64_t otherwise) const {
        const auto numbers = integers_of(text(key), key, file_);
        if (numbers.empty())
            return otherwise;
        if (numbers.size() != 1 || numbers[0] < 0)
            throw Error(
                fmt::format("{}: {} {}, expected 0 or more", file_, key, excerpt(text(key))));
        return numbers[0];
    }

  private:
    std::string file_;
    std::map<std::string, std::string> fields_;
};

void place_brick(const BovHeader& header, const std::string& name, SeriesInfo& info) {
    const auto size = header.vec3("brick_size");
    const glm::dvec3 origin = header.vec3("brick_origin").value_or(glm::dvec3(0));
    const std::string centering = lower_case(header.text("centering", "zonal"));
    if (centering != "zonal" && centering != "nodal")
        throw Error(
            fmt::format("{}: CENTERING {}, expected zonal or nodal", name, excerpt(centering)));
    const bool cells = centering == "zonal";
    glm::dmat3 steps(1.0);
    info.grid.origin = origin;
    for (int axis = 0; axis < 3; ++axis) {
        const std::uint32_t count = info.grid.vertices[static_cast<std::size_t>(axis)];
        if (size)
            steps[axis][axis] = (*size)[axis] / (cells ? count : count - 1);
        if (cells)
            info.grid.origin[axis] += steps[axis][axis] / 2;
    }
    set_axes(info.grid, steps, name);
    if (cells)
        info.notes.push_back("values of cells: taken at the cells' centers");
}

} // namespace

std::unique_ptr<VolumeFile> open_bov(const fs::path& path, const ReadOptions& options) {
    const std::string name = path.string();
    const BovHeader header(path);
    const auto sizes = integers_of(header.text("data_size"), "DATA_SIZE", name);
    if (sizes.size() != 3)
        throw Error(fmt::format("{}: DATA_SIZE has {} numbers, expected 3", name, sizes.size()));
    if (const auto bricklets = integers_of(header.text("data_bricklets"), "DATA_BRICKLETS", name);
        (!bricklets.empty() && bricklets != sizes) || is_numbered(header.text("data_file")))
        throw Error(fmt::format("{}: a brick cut into several, expected one of DATA_SIZE", name));
    SeriesInfo info;
    info.grid.vertices = checked_vertices({sizes[0], sizes[1], sizes[2]}, name);
    place_brick(header, name, info);
    StoredLayout layout;
    const std::string type = lower_case(header.text("data_format", "float"));
    const auto known = std::ranges::find_if(
        kBovTypes, [&](const auto& entry) { return type.starts_with(entry.first); });
    if (known == kBovTypes.end())
        throw Error(fmt::format("{}: DATA_FORMAT {}, expected BYTE, SHORT, INT, LONG, FLOAT or "
                                "DOUBLE",
                                name, excerpt(type)));
    std::string variable = header.text("variable", "values");
    std::erase(variable, '"');
    layout.array = {variable, known->second};
    const std::int64_t components = header.integer("data_components", 1);
    if (components < 1 || components > 64)
        throw Error(fmt::format("{}: DATA_COMPONENTS {}, expected 1 to 64", name, components));
    layout.array.components = static_cast<std::uint32_t>(components);
    layout.data = path.parent_path() / header.text("data_file");
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

} // namespace isochron::index
