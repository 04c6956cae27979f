// NRRD (.nrrd, .nhdr), read by hand: VTK's reader drops the space directions and takes the wrong
// spacing where they permute the axes.
//
// Fields after "Definition of NRRD File Format", https://teem.sourceforge.net/nrrd/format.html.
#include "index/error.h"
#include "index/formats/readers.h"
#include "index/formats/stored_file.h"
#include "index/formats/text_header.h"
#include "index/system/input_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>
#include <utility>

namespace isochron::index {
namespace {

namespace fs = std::filesystem;

struct TypeNames {
    StoredType type;
    std::string_view names; ///< each between bars
};
constexpr std::array<TypeNames, 10> kNrrdTypes{{
    {StoredType::i8, "|signed char|int8|int8_t|"},
    {StoredType::u8, "|uchar|unsigned char|uint8|uint8_t|"},
    {StoredType::i16, "|short|short int|signed short|signed short int|int16|int16_t|"},
    {StoredType::u16, "|ushort|unsigned short|unsigned short int|uint16|uint16_t|"},
    {StoredType::i32, "|int|signed int|int32|int32_t|"},
    {StoredType::u32, "|uint|unsigned int|uint32|uint32_t|"},
    {StoredType::i64,
     "|longlong|long long|long long int|signed long long|signed long long int|int64|int64_t|"},
    {StoredType::u64, "|ulonglong|unsigned long long|unsigned long long int|uint64|uint64_t|"},
    {StoredType::f32, "|float|"},
    {StoredType::f64, "|double|"},
}};

/// Space names, and the signs that turn their axes into RAS or LPS (x, y; z is always superior).
struct SpaceName {
    std::string_view name, letters;
    Anatomy anatomy;
    glm::dvec3 signs;
};
constexpr std::array<SpaceName, 5> kSpaces{{
    {"right-anterior-superior", "ras", Anatomy::ras, {1, 1, 1}},
    {"left-posterior-superior", "lps", Anatomy::lps, {1, 1, 1}},
    {"left-anterior-superior", "las", Anatomy::ras, {-1, 1, 1}},
    {"scanner-xyz", "3d-right-handed", Anatomy::none, {1, 1, 1}},
    {"3d-left-handed", "3d-left-handed", Anatomy::none, {1, 1, -1}},
}};

class NrrdHeader {
  public:
    explicit NrrdHeader(const fs::path& path) : file_(path.string()) {
        constexpr std::uint64_t kMost = 16 << 20;
        InputStream in(path);
        std::string line;
        if (!read_line(in, line) || !line.starts_with("NRRD000"))
            throw Error(fmt::format("{}: not NRRD: it does not start with NRRD000", file_));
        while (read_line(in, line) && !line.empty()) {
            if (bytes_ > kMost)
                throw Error(
                    fmt::format("{}: not NRRD: its header is longer than {} bytes", file_, kMost));
            const std::size_t colon = line.find(':');
            if (line.starts_with('#') || colon == line.npos)
                continue;
            if (line.compare(colon, 2, ":=") == 0)
                continue; // the user's own keys
            std::string key = lower_case(trimmed(std::string_view(line).substr(0, colon)));
            std::erase(key, ' ');
            fields_[key] = trimmed(std::string_view(line).substr(colon + 1));
        }
    }

    /// A field, its key in lower case without blanks, as its spelling varies.
    std::optional<std::string> find(const std::string& key) const {
        const auto found = fields_.find(key);
        return found == fields_.end() ? std::nullopt : std::optional(found->second);
    }
    std::string need(const std::string& key) const {
        if (auto text = find(key))
            return *text;
        throw Error(fmt::format("{}: has no {}", file_, key));
    }
    const std::string& file() const { return file_; }
    std::uint64_t bytes() const { return bytes_; }

  private:
    // A header's line is short: one that is not is no header.
    bool read_line(std::istream& in, std::string& line) {
        constexpr std::size_t kMost = 1 << 16;
        line.clear();
        char c = 0;
        for (; in.get(c) && c != '\n'; line += c)
            if (line.size() > kMost)
                throw Error(fmt::format("{}: not NRRD: a line of the header has no end", file_));
        bytes_ += line.size() + (c == '\n');
        if (line.ends_with('\r'))
            line.pop_back();
        return !in.fail();
    }

    std::string file_;
    std::map<std::string, std::string> fields_;
    std::uint64_t bytes_ = 0;
};

/// What each axis is, fastest first.
struct Axes {
    std::vector<std::int64_t> sizes;
    std::vector<std::optional<glm::dvec3>> directions; ///< none: not an axis of space
    std::optional<std::size_t> components, time;
    std::array<std::size_t, 3> space{};
};

std::optional<glm::dvec3> vector_of(std::string_view text, const std::string& key,
                                    const std::string& file) {
    if (text == "none")
        return std::nullopt;
    std::string numbers(text);
    std::replace_if(
        numbers.begin(), numbers.end(), [](char c) { return c == '(' || c == ')' || c == ','; },
        ' ');
    const auto v = numbers_of(numbers, key, file);
    if (v.size() != 3)
        throw Error(fmt::format("{}: {}: {} has {} numbers, expected 3", file, key, excerpt(text),
                                v.size()));
    return glm::dvec3(v[0], v[1], v[2]);
}

// Vectors may have blanks inside: each ends at its bracket.
std::vector<std::string> vectors_in(std::string_view text) {
    std::vector<std::string> vectors;
    while (!(text = trimmed(text)).empty()) {
        const std::size_t end =
            text.front() == '(' ? text.find(')') : text.find_first_of(" \t(") - 1;
        const std::size_t length = end >= text.size() ? text.size() : end + 1;
        vectors.emplace_back(trimmed(text.substr(0, length)));
        text.remove_prefix(length);
    }
    return vectors;
}

Axes axes_of(const NrrdHeader& header) {
    const std::string& file = header.file();
    Axes axes;
    axes.sizes = integers_of(header.need("sizes"), "sizes", file);
    const std::size_t count = axes.sizes.size();
    const auto dimension = integers_of(header.need("dimension"), "dimension", file);
    if (dimension.size() != 1 || dimension[0] != static_cast<std::int64_t>(count))
        throw Error(fmt::format("{}: {} sizes, dimension is {}", file, count,
                                excerpt(header.need("dimension"))));
    if (count < 3 || count > 5)
        throw Error(fmt::format("{}: {} dimensions, expected 3, or 4 with time", file, count));
    const std::vector<std::string> kinds = words_of(lower_case(header.find("kinds").value_or("")));
    const auto spatial_kind = [&](std::size_t axis) {
        return kinds.size() != count || kinds[axis] == "domain" || kinds[axis] == "space" ||
               kinds[axis] == "???" || kinds[axis] == "none";
    };
    std::vector<bool> spatial(count, true);
    if (const auto text = header.find("spacedirections")) {
        for (const std::string& vector : vectors_in(*text))
            axes.directions.push_back(vector_of(vector, "space directions", file));
        if (axes.directions.size() != count)
            throw Error(fmt::format("{}: {} space directions, expected {}", file,
                                    axes.directions.size(), count));
        for (std::size_t axis = 0; axis < count; ++axis)
            spatial[axis] = axes.directions[axis].has_value();
    } else {
        std::size_t left = 3;
        for (std::size_t axis = 0; axis < count; ++axis) {
            spatial[axis] = left > 0 && (count == 3 || spatial_kind(axis));
            left -= spatial[axis];
        }
    }
    std::size_t found = 0;
    for (std::size_t axis = 0; axis < count; ++axis) {
        if (spatial[axis]) {
            if (found == 3)
                throw Error(fmt::format("{}: more than 3 axes of space", file));
            axes.space[found++] = axis;
        } else if (axis == 0 && (kinds.size() != count || kinds[0] != "time")) {
            axes.components = axis;
        } else if (axis == count - 1) {
            axes.time = axis;
        } else {
            throw Error(fmt::format("{}: axis {} is not one of space; expected that of the slowest "
                                    "axis (time) or the fastest (components) only",
                                    file, axis));
        }
    }
    if (found != 3)
        throw Error(fmt::format("{}: {} axes of space, expected 3", file, found));
    return axes;
}

std::vector<double> per_axis(const NrrdHeader& header, const std::string& key, std::size_t count) {
    const auto text = header.find(key);
    if (!text)
        return {};
    auto numbers = numbers_of(*text, key, header.file());
    if (numbers.size() != count)
        throw Error(
            fmt::format("{}: {} {}, expected {}", header.file(), numbers.size(), key, count));
    return numbers;
}

std::vector<std::string> quoted_in(std::string_view text) {
    std::vector<std::string> quoted;
    for (std::size_t begin = text.find('"'); begin != text.npos;) {
        const std::size_t end = text.find('"', begin + 1);
        if (end == text.npos)
            break;
        quoted.emplace_back(text.substr(begin + 1, end - begin - 1));
        begin = text.find('"', end + 1);
    }
    return quoted;
}

void orient(const NrrdHeader& header, const Axes& axes, SeriesInfo& info, StoredLayout& layout) {
    const std::string& file = header.file();
    const std::size_t count = axes.sizes.size();
    const auto spacings = per_axis(header, "spacings", count);
    const auto minima = per_axis(header, "axismins", count);
    glm::dvec3 signs(1);
    if (const auto space = header.find("space")) {
        const std::string name = lower_case(*space);
        const auto known = std::find_if(kSpaces.begin(), kSpaces.end(), [&](const SpaceName& s) {
            return s.name == name || s.letters == name;
        });
        if (known == kSpaces.end())
            throw Error(fmt::format("{}: space {}, expected one of three dimensions", file,
                                    excerpt(*space)));
        info.anatomy = known->anatomy;
        signs = known->signs;
    }
    glm::dmat3 steps(0.0);
    for (int i = 0; i < 3; ++i) {
        const std::size_t axis = axes.space[i];
        if (!axes.directions.empty()) {
            steps[i] = *axes.directions[axis] * signs;
        } else {
            const bool said = !spacings.empty() && std::isfinite(spacings[axis]);
            steps[i] = glm::dvec3(0);
            steps[i][i] = (said ? spacings[axis] : 1.0) * signs[i];
            if (!minima.empty() && std::isfinite(minima[axis]))
                info.grid.origin[i] = minima[axis] * signs[i];
        }
    }
    set_axes(info.grid, steps, file);
    if (const auto origin = header.find("spaceorigin"))
        info.grid.origin = vector_of(*origin, "space origin", file).value_or(glm::dvec3(0)) * signs;
    const auto units = quoted_in(header.find("units").value_or(""));
    const auto space_units = quoted_in(header.find("spaceunits").value_or(""));
    if (!space_units.empty())
        info.length_unit = space_units[0];
    else if (units.size() == count)
        info.length_unit = units[axes.space[0]];
    if (!axes.time)
        return;
    if (axes.sizes[*axes.time] < 1)
        throw Error(fmt::format("{}: {} steps, expected at least 1", file, axes.sizes[*axes.time]));
    layout.steps = static_cast<std::size_t>(axes.sizes[*axes.time]);
    if (!spacings.empty())
        layout.time_step = spacings[*axes.time];
    if (!minima.empty() && std::isfinite(minima[*axes.time]))
        layout.first_time = minima[*axes.time];
    if (units.size() == count)
        info.time_unit = units[*axes.time];
}

/// Where the line begins that follows `lines` others.
std::uint64_t after_lines(const fs::path& path, std::uint64_t offset, std::uint64_t lines) {
    if (lines == 0)
        return offset;
    const InputFile file(path);
    std::vector<std::byte> part(1 << 18);
    std::uint64_t left = lines;
    while (const std::size_t got = file.read(offset, part)) {
        for (std::size_t i = 0; i < got; ++i)
            if (part[i] == std::byte{'\n'} && --left == 0)
                return offset + i + 1;
        offset += got;
    }
    throw Error(fmt::format("{}: truncated: {} lines, expected {} to skip", path.string(),
                            lines - left, lines));
}

void find_data(const NrrdHeader& header, const fs::path& path, std::uint64_t value_bytes,
               StoredLayout& layout) {
    const std::string& file = header.file();
    const std::string encoding = lower_case(header.need("encoding"));
    if (encoding == "gzip" || encoding == "gz")
        layout.compression = Compression::deflate;
    else if (encoding == "bzip2" || encoding == "bz2")
        layout.compression = Compression::bzip2;
    else if (encoding == "ascii" || encoding == "text" || encoding == "txt")
        layout.ascii = true;
    else if (encoding != "raw")
        throw Error(fmt::format("{}: encoding {}, expected raw, ascii, gzip or bzip2", file,
                                excerpt(encoding)));
    layout.big_endian = lower_case(header.find("endian").value_or("little")) == "big";
    layout.data = path;
    layout.offset = header.bytes();
    if (const auto data = header.find("datafile")) {
        if (data->find('%') != data->npos || lower_case(*data).starts_with("list"))
            throw Error(fmt::format("{}: data file {}, expected one file", file, excerpt(*data)));
        layout.data = path.parent_path() / *data;
        layout.offset = 0;
    }
    const auto skip = [&](const char* key) {
        const auto text = header.find(key);
        const auto number = integers_of(text.value_or("0"), key, file);
        if (number.size() != 1 || number[0] < 0)
            throw Error(fmt::format("{}: {} {}, expected 0 or more", file, key, excerpt(*text)));
        return static_cast<std::uint64_t>(number[0]);
    };
    layout.offset = after_lines(layout.data, layout.offset, skip("lineskip"));
    // Compressed data skip bytes of what comes out; -1 says that the values end the file.
    if (header.find("byteskip") == "-1" && layout.compression == Compression::none) {
        const std::uint64_t size = file_bytes(layout.data);
        layout.offset = size > value_bytes ? size - value_bytes : 0;
        return;
    }
    (layout.compression == Compression::none ? layout.offset : layout.skip) += skip("byteskip");
}

} // namespace

std::unique_ptr<VolumeFile> open_nrrd(const fs::path& path, const ReadOptions& options) {
    const NrrdHeader header(path);
    const std::string& file = header.file();
    const Axes axes = axes_of(header);
    SeriesInfo info;
    info.grid.vertices = checked_vertices(
        {axes.sizes[axes.space[0]], axes.sizes[axes.space[1]], axes.sizes[axes.space[2]]}, file);
    StoredLayout layout;
    orient(header, axes, info, layout);

    const std::string type = lower_case(header.need("type"));
    const auto known =
        std::find_if(kNrrdTypes.begin(), kNrrdTypes.end(), [&](const TypeNames& entry) {
            return entry.names.find("|" + type + "|") != entry.names.npos;
        });
    if (known == kNrrdTypes.end())
        throw Error(fmt::format("{}: type {}, expected integers of up to 64 bits, float or double",
                                file, excerpt(type)));
    layout.array = {"values", known->type};
    if (axes.components) {
        const std::int64_t number = axes.sizes[*axes.components];
        if (number < 1 || number > 4096)
            throw Error(fmt::format("{}: {} components, expected 1 to 4096", file, number));
        layout.array.components = static_cast<std::uint32_t>(number);
    }
    find_data(header, path,
              info.grid.vertex_count() * layout.array.components * layout.steps *
                  size_of(*layout.array.type),
              layout);
    return open_stored(path, std::move(info), layout, options);
}

} // namespace isochron::index
