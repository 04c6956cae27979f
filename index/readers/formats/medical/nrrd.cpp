// NRRD (.nrrd, .nhdr). Read without VTK, whose reader ignores the space directions, and gives the
// wrong spacing if they permute the axes.
//
// Fields after "Definition of NRRD File Format", https://teem.sourceforge.net/nrrd/format.html.
#include "index/error.h"
#include "index/lower_case.h"
#include "index/readers/formats/medical/nrrd_axes.h"
#include "index/readers/formats/medical/nrrd_header.h"
#include "index/readers/formats/named_file.h"
#include "index/readers/formats/own_formats.h"
#include "index/readers/formats/reordered_file.h"
#include "index/readers/formats/stated/array_places.h"
#include "index/readers/formats/stored_file.h"
#include "index/readers/formats/text_header.h"
#include "index/readers/formats/unread_fields.h"
#include "index/system/input_file.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <set>
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

std::string unquoted(std::string text) {
    if (text.size() >= 2 && text.front() == '"' && text.back() == '"')
        text = text.substr(1, text.size() - 2);
    return text;
}

/// Units of space, one for all axes or one for each: of the axes of space, or of those of the file.
std::array<std::string, 3> units_of_space(const NrrdAxes& axes,
                                          const std::vector<std::string>& space_units) {
    std::array<std::string, 3> units;
    for (std::size_t i = 0; i < 3; ++i)
        if (!space_units.empty())
            units[i] = space_units[std::min(i, space_units.size() - 1)];
        else if (!axes.units.empty())
            units[i] = axes.units[axes.space[i]];
    return units;
}

/// The record of the axes of space, z, y and x.
StatedArray stated_axes(const NrrdHeader& header, const NrrdAxes& axes) {
    StatedArray stated{.file = header.file(), .name = "values", .axes = std::vector<StatedAxis>(3)};
    if (const auto labels = quoted_in(header.find("labels").value_or(""));
        labels.size() == axes.sizes.size())
        for (std::size_t i = 0; i < 3; ++i)
            stated.axes[2 - i].name = labels[axes.space[i]];
    return stated;
}

void orient(const NrrdHeader& header, const NrrdAxes& axes, const ReadOptions& options,
            SeriesInfo& info, StoredLayout& layout) {
    const std::string& file = header.file();
    const std::size_t count = axes.sizes.size();
    const auto spacings = per_axis(header, "spacings", count);
    const auto minima = per_axis(header, "axismins", count);
    const auto maxima = per_axis(header, "axismaxs", count);
    const auto centers = words_of(
        lower_case(header.find("centers").value_or(header.find("centerings").value_or(""))));
    bool centers_guessed = false;
    glm::dvec3 signs(1);
    if (const auto space = header.find("space")) {
        std::string name = lower_case(*space);
        if (space_dimensions(header) == 4 && name.ends_with("-time"))
            name.resize(name.size() - std::string_view("-time").size());
        else if (name.size() == 4 && name.ends_with('t'))
            name.pop_back();
        const auto known = std::find_if(kSpaces.begin(), kSpaces.end(), [&](const SpaceName& s) {
            return s.name == name || s.letters == name;
        });
        if (known == kSpaces.end())
            throw Error("{}: space {}, expected one of three dimensions", file, excerpt(*space));
        info.anatomy = known->anatomy;
        signs = known->signs;
    }
    StatedDirections directions{.steps = glm::dmat3(0.0)};
    for (int i = 0; i < 3; ++i) {
        const std::size_t axis = axes.space[i];
        if (!axes.directions.empty()) {
            directions.steps[i] = *axes.directions[axis] * signs;
        } else {
            const bool said = !spacings.empty() && std::isfinite(spacings[axis]);
            const bool begins = !minima.empty() && std::isfinite(minima[axis]);
            const bool ends = begins && !maxima.empty() && std::isfinite(maxima[axis]);
            const std::string center = axis < centers.size() ? centers[axis] : "";
            const bool told = center == "node" || center == "cell";
            // As Teem has it: samples are centers of cells unless they are said to be nodes.
            const bool cell = center == "cell" || (ends && !told);
            const auto size = static_cast<double>(axes.sizes[axis]);
            double step = said ? spacings[axis] : 1.0;
            if (!said && ends && maxima[axis] != minima[axis])
                step = (maxima[axis] - minima[axis]) / (cell ? size : size - 1);
            centers_guessed = centers_guessed || (ends && !told);
            directions.steps[i][i] = step * signs[i];
            if (begins)
                directions.origin[i] = (minima[axis] + (cell ? step / 2 : 0)) * signs[i];
        }
    }
    if (centers_guessed)
        info.notes.push_back(
            "axis mins and maxs are taken for the outer faces of cells: centers are "
            "not said");
    std::optional<std::vector<double>> first;
    if (const auto origin = header.find("spaceorigin"))
        first = nrrd_vector(*origin, "space origin", file, space_dimensions(header));
    if (first)
        directions.origin = glm::dvec3((*first)[0], (*first)[1], (*first)[2]) * signs;
    const auto space_units = quoted_in(header.find("spaceunits").value_or(""));
    directions.units = units_of_space(axes, space_units);
    StatedArray stated = stated_axes(header, axes);
    stated.directions = directions;
    place_axes(stated, layout_of_zyx(), options, info);
    info.value_unit = unquoted(header.find("sampleunits").value_or(""));
    if (!axes.time)
        return;
    const std::int64_t steps = axes.sizes[*axes.time];
    if (steps < 1)
        throw Error("{}: {} steps, expected at least 1", file, steps);
    expect_few_steps(static_cast<std::size_t>(steps), file);
    layout.steps = static_cast<std::size_t>(steps);
    StatedAxis time{.name = "time", .length = layout.steps};
    const auto take_step = [&](double step) {
        time.step = step;
        time.regular = std::isfinite(step);
    };
    if (!axes.units.empty())
        time.unit = axes.units[*axes.time];
    else if (axes.time_step && space_units.size() == 4)
        time.unit = space_units[3];
    if (axes.time_step) {
        take_step(*axes.time_step);
        if (first && first->size() == 4)
            time.first = (*first)[3];
    }
    if (!spacings.empty())
        take_step(spacings[*axes.time]);
    if (!minima.empty() && std::isfinite(minima[*axes.time])) {
        time.first = minima[*axes.time];
        if (const double last = maxima.empty() ? NAN : maxima[*axes.time];
            !time.regular && steps > 1) {
            const bool cells = *axes.time < centers.size() && centers[*axes.time] == "cell";
            take_step((last - time.first) / static_cast<double>(cells ? steps : steps - 1));
        }
    }
    if (axes.listed) {
        info.notes.push_back("steps by " + axes.listed->by);
        if (!axes.listed->times.empty()) {
            time.at = axes.listed->times;
            time.unit = axes.listed->unit;
        }
    } else if (axes.time_is_guessed) {
        info.notes.push_back("its slowest axis is taken for time: it gives no kinds");
    }
    place_steps(time, options, info);
    if (info.times.size() != layout.steps)
        info.times.clear(); // the values of all steps are there
}

/// What is not said elsewhere: fields of the format that nothing is done with.
void note_unread(const NrrdHeader& header, const NrrdAxes& axes, SeriesInfo& info) {
    std::set<std::string_view> read{
        "dimension",   "type",     "encoding", "endian",         "space",
        "sizes",       "spacings", "axismins", "axismaxs",       "centers",
        "centerings",  "units",    "kinds",    "spacedimension", "spaceunits",
        "spaceorigin", "lineskip", "byteskip", "datafile",       "spacedirections",
        "sampleunits", "labels",   "number"};
    if (axes.listed && !axes.listed->times.empty())
        read.insert(axes.listed->keys.begin(), axes.listed->keys.end());
    if (auto note = note_on_unread(header.others(read)))
        info.notes.push_back(std::move(*note));
}

/// The file offset after `lines` lines from `offset` on.
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
    throw Error("{}: truncated: {} lines, expected {} to skip", path.string(), lines - left, lines);
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
    else if (encoding == "hex")
        layout.compression = Compression::hex;
    else if (encoding != "raw")
        throw Error("{}: encoding {}, expected raw, ascii, hex, gzip or bzip2", file,
                    excerpt(encoding));
    layout.big_endian = lower_case(header.find("endian").value_or("little")) == "big";
    layout.data = path;
    layout.offset = header.bytes();
    if (const auto data = header.find("datafile")) {
        std::vector<std::string> names{*data};
        if (is_numbered(*data))
            names = numbered_names(*data, file);
        else if (lower_case(*data).starts_with("list"))
            names = header.listed();
        if (names.empty())
            throw Error("{}: data file LIST, expected names of files after it", file);
        layout.data = file_named_in(path, names.front());
        layout.offset = 0;
        for (const std::string& one : names.size() > 1 ? names : std::vector<std::string>())
            layout.parts.push_back({file_named_in(path, one), 0, 0});
    }
    const auto skip = [&](const char* key) {
        const auto text = header.find(key);
        const auto number = integers_of(text.value_or("0"), key, file);
        if (number.size() != 1 || number[0] < 0)
            throw Error("{}: {} {}, expected 0 or more", file, key, excerpt(*text));
        return static_cast<std::uint64_t>(number[0]);
    };
    const std::uint64_t lines = skip("lineskip");
    const bool at_end = header.find("byteskip") == "-1" && layout.compression == Compression::none;
    const std::uint64_t bytes = at_end ? 0 : skip("byteskip");
    const std::uint64_t share = value_bytes / std::max<std::size_t>(layout.parts.size(), 1);
    const auto begin = [&](DataPart part) {
        part.offset = after_lines(part.path, part.offset, lines);
        // For compressed data, byteskip counts decompressed bytes. -1: the values are at the
        // file's end.
        const std::uint64_t size = at_end ? file_bytes(part.path) : 0;
        if (at_end)
            part.offset = size - std::min(size, share);
        (layout.compression == Compression::none ? part.offset : part.skip) += bytes;
        return part;
    };
    for (DataPart& part : layout.parts)
        part = begin(part);
    const DataPart whole = begin({layout.data, layout.offset, 0});
    layout.offset = whole.offset;
    if (layout.parts.empty())
        layout.skip = whole.skip;
}

} // namespace

std::unique_ptr<VolumeFile> open_nrrd(const fs::path& path, const ReadOptions& options) {
    const NrrdHeader header(path);
    const std::string& file = header.file();
    const NrrdAxes axes = axes_of(header, options);
    SeriesInfo info;
    info.grid.vertices = checked_vertices(
        {axes.sizes[axes.space[0]], axes.sizes[axes.space[1]], axes.sizes[axes.space[2]]}, file);
    StoredLayout layout;
    orient(header, axes, options, info, layout);
    note_unread(header, axes, info);

    const std::string type = lower_case(header.need("type"));
    const auto known =
        std::find_if(kNrrdTypes.begin(), kNrrdTypes.end(), [&](const TypeNames& entry) {
            return entry.names.find("|" + type + "|") != entry.names.npos;
        });
    if (known == kNrrdTypes.end())
        throw Error("{}: type {}, expected integers of up to 64 bits, float or double", file,
                    excerpt(type));
    layout.array = {"values", known->type};
    if (axes.components) {
        const std::int64_t number = axes.sizes[*axes.components];
        if (number < 1 || number > 4096)
            throw Error("{}: {} components, expected 1 to 4096", file, number);
        layout.array.components = static_cast<std::uint32_t>(number);
        layout.array.maybe_steps = !axes.time;
    }
    find_data(header, path,
              info.grid.vertex_count() * layout.array.components * layout.steps *
                  size_of(*layout.array.type),
              layout);
    const std::optional<std::size_t> other = axes.time ? axes.time : axes.components;
    if (axes.sizes.size() == 4 && other && axes.sizes[*other] > 1 && (*other == 1 || *other == 2))
        return open_axis_between(path, std::move(info), layout, static_cast<int>(*other), options);
    const bool interleaved = axes.time == 0u;
    const bool stacked = axes.components && *axes.components != 0;
    if (interleaved && stacked)
        throw Error(
            "{}: time is its fastest and components its slowest axis, expected the other way round",
            file);
    if (interleaved)
        return open_interleaved_steps(path, std::move(info), layout, options);
    if (stacked)
        return open_stacked_components(path, std::move(info), layout, axes.time > axes.components,
                                       options);
    return open_stored(path, std::move(info), layout, options);
}

} // namespace isochron::index
