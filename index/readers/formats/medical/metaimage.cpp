// MetaImage (.mhd, .mha). Read without VTK, whose reader ignores TransformMatrix, so that left and
// right get lost.
//
// Keys after "MetaIO documentation", https://itk.org/Wiki/MetaIO/Documentation; geometry as in
// ITK's MetaImageIO: TransformMatrix lists the directions of the axes one after another, and space
// is LPS, whatever AnatomicalOrientation says.
#include "index/error.h"
#include "index/lower_case.h"
#include "index/readers/formats/length_units.h"
#include "index/readers/formats/named_file.h"
#include "index/readers/formats/own_formats.h"
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

constexpr std::array<std::pair<std::string_view, StoredType>, 12> kTypes{{
    {"MET_CHAR", StoredType::i8},
    {"MET_UCHAR", StoredType::u8},
    {"MET_SHORT", StoredType::i16},
    {"MET_USHORT", StoredType::u16},
    {"MET_INT", StoredType::i32},
    {"MET_UINT", StoredType::u32},
    {"MET_LONG", StoredType::i32}, // 4 bytes in MetaIO, on every system
    {"MET_ULONG", StoredType::u32},
    {"MET_LONG_LONG", StoredType::i64},
    {"MET_ULONG_LONG", StoredType::u64},
    {"MET_FLOAT", StoredType::f32},
    {"MET_DOUBLE", StoredType::f64},
}};

class MetaImageHeader {
  public:
    explicit MetaImageHeader(const fs::path& path) : file_(path.string()) {
        constexpr std::size_t kMost = 1 << 20;
        const std::string head = head_of(path, kMost);
        std::size_t at = 0;
        while (at < head.size() && !fields_.contains("ElementDataFile")) {
            const std::string_view line = take_line(head, at);
            if (auto field = field_of(line, '='))
                fields_[field->key] = std::move(field->value);
            else if (!trimmed(line).empty())
                break;
        }
        bytes_ = at;
        while (at < head.size() &&
               lower_case(find({"ElementDataFile"}).value_or("")).starts_with("list")) {
            if (const auto line = trimmed(take_line(head, at)); !line.empty())
                listed_.emplace_back(line);
        }
        if (!fields_.contains("ElementDataFile") || !fields_.contains("DimSize"))
            throw Error("{}: not MetaImage: no DimSize or no ElementDataFile", file_);
    }

    /// The value of the first of these keys that the header has.
    std::optional<std::string> find(std::initializer_list<const char*> keys) const {
        for (const char* key : keys)
            if (const auto found = fields_.find(key); found != fields_.end())
                return found->second;
        return std::nullopt;
    }

    std::vector<double> numbers(std::initializer_list<const char*> keys, std::size_t count) const {
        const auto text = find(keys);
        if (!text)
            return {};
        std::vector<double> numbers = numbers_of(*text, *keys.begin(), file_);
        if (numbers.size() != count)
            throw Error("{}: {} has {} numbers, expected {}", file_, *keys.begin(), numbers.size(),
                        count);
        return numbers;
    }

    bool truth(std::initializer_list<const char*> keys) const {
        const std::string text = lower_case(find(keys).value_or("false"));
        return text.starts_with('t') || text.starts_with('1') || text.starts_with('y');
    }

    /// Fields that none of these keys are, with their values.
    std::vector<std::string> others(const std::set<std::string_view>& keys) const {
        return fields_besides(keys, fields_);
    }

    /// Names that follow `ElementDataFile = LIST`.
    const std::vector<std::string>& listed() const { return listed_; }
    std::uint64_t bytes() const { return bytes_; } ///< size of the header, up to LOCAL data

  private:
    std::string file_;
    std::map<std::string, std::string> fields_;
    std::vector<std::string> listed_;
    std::uint64_t bytes_ = 0;
};

void orient(const MetaImageHeader& header, std::size_t dimensions, const std::string& name,
            SeriesInfo& info, double& time_step, double& first_time) {
    std::vector<double> spacing = header.numbers({"ElementSpacing", "ElementSize"}, dimensions);
    const auto matrix =
        header.numbers({"TransformMatrix", "Rotation", "Orientation"}, dimensions * dimensions);
    const auto origin = header.numbers({"Offset", "Position", "Origin"}, dimensions);
    if (spacing.empty())
        spacing.assign(dimensions, 1.0);
    glm::dmat3 axes(0.0);
    for (int axis = 0; axis < 3; ++axis) {
        for (int row = 0; row < 3; ++row)
            axes[axis][row] =
                (matrix.empty() ? (axis == row ? 1.0 : 0.0) : matrix[axis * dimensions + row]) *
                spacing[axis];
        if (!origin.empty())
            info.grid.origin[axis] = origin[axis];
    }
    set_axes(info.grid, axes, name);
    info.anatomy = Anatomy::lps;
    if (dimensions == 4) {
        time_step = spacing[3];
        first_time = origin.empty() ? 0.0 : origin[3];
    }
}

/// [s] of the frames that PLUS and 3D Slicer list; empty: they are not said.
std::vector<double> times_of_frames(const MetaImageHeader& header, std::size_t frames) {
    std::vector<double> times;
    while (times.size() < frames) {
        const std::string key = fmt::format("Seq_Frame{:04}_Timestamp", times.size());
        const auto time = header.numbers({key.c_str()}, 1);
        if (time.empty())
            return {};
        times.push_back(time.front());
    }
    const std::set<double> different(times.begin(), times.end());
    return different.size() == frames ? times : std::vector<double>();
}

/// The third axis of a film is its frames, which lie nowhere behind each other.
void expect_slices(const MetaImageHeader& header, std::int64_t frames, const std::string& name,
                   const ReadOptions& options) {
    const auto kinds = words_of(lower_case(header.find({"Kinds"}).value_or("")));
    const bool film = header.find({"Seq_Frame0000_Timestamp", "Seq_Frame0000_Status"}) ||
                      (kinds.size() == 3 && (kinds[2] == "list" || kinds[2] == "time"));
    if (film && !options.spacing)
        throw Error("{}: a film, {} frames of one slice, expected slices; --spacing X Y Z takes "
                    "the frames for slices, Z apart",
                    name, frames);
}

void find_data(const MetaImageHeader& header, const fs::path& path, std::uint64_t vertices,
               StoredLayout& layout) {
    const std::string name = path.string();
    const std::string file = *header.find({"ElementDataFile"});
    layout.big_endian = header.truth({"BinaryDataByteOrderMSB", "ElementByteOrderMSB"});
    layout.ascii = header.find({"BinaryData"}) && !header.truth({"BinaryData"});
    if (header.truth({"CompressedData"}) && !layout.ascii)
        layout.compression = Compression::deflate;
    if (lower_case(file) == "local") {
        layout.data = path;
        layout.offset = header.bytes();
        return;
    }
    std::vector<std::string> names{file};
    if (is_numbered(file))
        names = numbered_names(file, name);
    else if (lower_case(file).starts_with("list"))
        names = header.listed();
    if (names.empty())
        throw Error("{}: ElementDataFile LIST, expected names of files after it", name);
    layout.data = file_named_in(path, names.front());
    for (const std::string& one : names.size() > 1 ? names : std::vector<std::string>())
        layout.parts.push_back({file_named_in(path, one), 0, 0});
    const auto skipped = header.find({"HeaderSize"});
    if (!skipped)
        return;
    const auto bytes = integers_of(*skipped, "HeaderSize", name);
    if (bytes.size() != 1 || bytes[0] < -1)
        throw Error("{}: HeaderSize {}, expected -1 or more", name, excerpt(*skipped));
    layout.offset = static_cast<std::uint64_t>(std::max<std::int64_t>(bytes[0], 0));
    // -1: the values are at the end of the file.
    const std::uint64_t values = vertices * layout.array.components * layout.steps *
                                 size_of(*layout.array.type) / names.size();
    const auto begin = [&](const fs::path& data) {
        const std::uint64_t size = bytes[0] == -1 ? file_bytes(data) : 0;
        return bytes[0] == -1 ? size - std::min(size, values) : layout.offset;
    };
    for (DataPart& part : layout.parts)
        part.offset = begin(part.path);
    layout.offset = begin(layout.data);
}

} // namespace

std::unique_ptr<VolumeFile> open_metaimage(const fs::path& path, const ReadOptions& options) {
    const std::string name = path.string();
    const MetaImageHeader header(path);
    const auto sizes = integers_of(*header.find({"DimSize"}), "DimSize", name);
    if (sizes.size() != 3 && sizes.size() != 4)
        throw Error("{}: {} dimensions, expected 3, or 4 with time", name, sizes.size());
    if (const auto said = header.numbers({"NDims"}, 1);
        !said.empty() && said.front() != static_cast<double>(sizes.size()))
        throw Error("{}: NDims {}, expected {}, as many as DimSize has numbers", name, said.front(),
                    sizes.size());
    SeriesInfo info;
    info.grid.vertices = checked_vertices({sizes[0], sizes[1], sizes[2]}, name);
    StoredLayout layout;
    orient(header, sizes.size(), name, info, layout.time_step, layout.first_time);
    info.length_unit = tidy_length_unit(header.find({"DistanceUnits"}).value_or(""));
    static const std::set<std::string_view> kRead{
        "ObjectType",
        "NDims",
        "BinaryData",
        "BinaryDataByteOrderMSB",
        "ElementByteOrderMSB",
        "CompressedData",
        "CompressedDataSize",
        "TransformMatrix",
        "Rotation",
        "Orientation",
        "Offset",
        "Position",
        "Origin",
        "ElementSpacing",
        "ElementSize",
        "DimSize",
        "HeaderSize",
        "ElementNumberOfChannels",
        "ElementType",
        "ElementDataFile",
        "DistanceUnits",
    };
    if (sizes.size() == 3)
        expect_slices(header, sizes[2], name, options);
    else
        info.times =
            times_of_frames(header, static_cast<std::size_t>(std::max<std::int64_t>(sizes[3], 0)));
    std::vector<std::string> unread = header.others(kRead);
    if (!info.times.empty()) {
        info.time_unit = "s";
        info.notes.emplace_back("steps by Seq_Frame Timestamp");
        std::erase_if(unread, [](const std::string& field) {
            return field.starts_with("Seq_Frame") && field.find("_Timestamp ") != field.npos;
        });
    }
    if (header.find({"ElementSpacing"}) && header.find({"ElementSize"}))
        unread.emplace_back("ElementSize (ElementSpacing counts)");
    // Where a matrix turns space, the center only says about which point: Offset has it in already.
    // The letters say the matrix again.
    const bool has_matrix = header.find({"TransformMatrix", "Rotation", "Orientation"}).has_value();
    std::erase_if(unread, [has_matrix](const std::string& field) {
        return field == "CenterOfRotation 0 0 0" || (field.starts_with("AnatomicalOrientation ") &&
                                                     (field.ends_with(" ???") || has_matrix));
    });
    if (auto note = note_on_unread(unread))
        info.notes.push_back(std::move(*note));
    if (sizes.size() == 4) {
        if (sizes[3] < 1)
            throw Error("{}: {} steps, expected at least 1", name, sizes[3]);
        layout.steps = static_cast<std::size_t>(sizes[3]);
    }

    const std::string type = header.find({"ElementType"}).value_or("none");
    const auto known = std::find_if(kTypes.begin(), kTypes.end(),
                                    [&](const auto& entry) { return entry.first == type; });
    if (known == kTypes.end())
        throw Error("{}: ElementType {}, expected MET_UCHAR to MET_DOUBLE", name, excerpt(type));
    layout.array = {"values", known->second};
    if (const auto channels = header.find({"ElementNumberOfChannels"})) {
        const auto number = integers_of(*channels, "ElementNumberOfChannels", name);
        if (number.size() != 1 || number[0] < 1 || number[0] > 64)
            throw Error("{}: ElementNumberOfChannels {}, expected 1 to 64", name,
                        excerpt(*channels));
        layout.array.components = static_cast<std::uint32_t>(number[0]);
    }
    find_data(header, path, info.grid.vertex_count(), layout);
    return open_stored(path, std::move(info), layout, options);
}

} // namespace isochron::index
