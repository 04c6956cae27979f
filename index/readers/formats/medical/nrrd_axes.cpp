// Finds the roles of the axes of an NRRD file, after "Definition of NRRD File Format",
// https://teem.sourceforge.net/nrrd/format.html#kinds.
#include "index/readers/formats/medical/nrrd_axes.h"

#include "index/error.h"
#include "index/lower_case.h"
#include "index/readers/formats/text_header.h"
#include "index/volume/time_unit.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <set>

namespace isochron::index {
namespace {

// Splits a list of vectors. They may have blanks inside, so each ends at its bracket.
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

bool is_space(const std::string& kind) {
    return kind == "domain" || kind == "space";
}

bool is_unknown(const std::string& kind) {
    return kind.empty() || kind == "???" || kind == "none";
}

/// The axes of space in a file without directions.
std::vector<bool> spatial_by_kind(const std::vector<std::string>& kinds) {
    const std::size_t count = kinds.size();
    std::vector<bool> spatial(count);
    const bool told = std::ranges::count_if(kinds, is_space) >= 3;
    std::size_t left = 3;
    for (std::size_t axis = 0; axis < count; ++axis) {
        spatial[axis] = left > 0 && (is_space(kinds[axis]) || (!told && is_unknown(kinds[axis])));
        left -= spatial[axis];
    }
    return spatial;
}

/// What 3D Slicer says of a list of volumes (MultiVolume, or a sequence); none: nothing.
std::optional<NrrdTimes> listed_times(const NrrdHeader& header, std::size_t axis,
                                      const std::vector<std::string>& units, std::size_t count) {
    const auto words = [](std::string text) {
        std::ranges::replace(text, ',', ' ');
        return words_of(text);
    };
    const std::string multi = "MultiVolume.Frame", index = fmt::format("axis {} index ", axis);
    NrrdTimes listed;
    std::vector<std::string> labels;
    if (const auto tag = header.own(multi + "IdentifyingDICOMTagName")) {
        // Echoes, flip angles and the like are no times.
        if (tag->find("Temporal") == tag->npos &&
            (!tag->ends_with("Time") || *tag == "EchoTime" || *tag == "InversionTime" ||
             *tag == "RepetitionTime"))
            return std::nullopt;
        listed = {.by = *tag,
                  .unit = header.own(multi + "IdentifyingDICOMTagUnits").value_or(""),
                  .keys = {multi + "IdentifyingDICOMTagName", multi + "IdentifyingDICOMTagUnits",
                           multi + "Labels", "MultiVolume.NumberOfFrames"}};
        labels = words(header.own(multi + "Labels").value_or(""));
    } else if (header.own(index + "type") || header.own(index + "values")) {
        const auto names = quoted_in(header.find("labels").value_or(""));
        listed = {.by = axis < names.size() && !names[axis].empty() ? names[axis] : "index",
                  .unit = axis < units.size() ? units[axis] : "",
                  .keys = {index + "type", index + "values"}};
        labels = words(header.own(index + "values").value_or(""));
    } else {
        return std::nullopt;
    }
    for (const std::string& label : labels) {
        double time = 0;
        const char* end = label.data() + label.size();
        if (std::from_chars(label.data(), end, time).ptr == end && std::isfinite(time))
            listed.times.push_back(time);
    }
    const std::set<double> different(listed.times.begin(), listed.times.end());
    if (labels.size() != count || different.size() != count)
        listed.times.clear();
    return listed;
}

enum class Role : std::uint8_t { components, time };

/// The role of an axis that is not an axis of space.
Role role_of(const NrrdHeader& header, std::size_t axis, const std::string& kind, NrrdAxes& axes,
             const ReadOptions& options) {
    if (header.own("modality") == "DWMRI" && !options.extra_axis_is_time) // directions of diffusion
        return Role::components;
    if (kind == "time" || kind == "list" || is_unknown(kind))
        axes.listed =
            listed_times(header, axis, axes.units, static_cast<std::size_t>(axes.sizes[axis]));
    if (kind == "time" || axes.listed || options.extra_axis_is_time)
        return Role::time;
    if (axis < axes.units.size() && times_in("s", axes.units[axis], {}))
        return Role::time;
    const bool unknown = is_unknown(kind) || is_space(kind);
    if (kind.empty() && axis > 0) {
        axes.time_is_guessed = true;
        return Role::time;
    }
    if (!unknown || kind.empty() || options.component)
        return Role::components;
    throw Error("{}: axis {}, of {}, is neither space nor said to be time (its kind is {}): "
                "--extra-axis-is-time reads it as time, --component N takes one of it",
                header.file(), axis, axes.sizes[axis], kind);
}

} // namespace

std::optional<std::vector<double>> nrrd_vector(std::string_view text, const std::string& key,
                                               const std::string& file, std::size_t dimensions) {
    if (text == "none")
        return std::nullopt;
    std::string numbers(text);
    std::replace_if(
        numbers.begin(), numbers.end(), [](char c) { return c == '(' || c == ')' || c == ','; },
        ' ');
    auto v = numbers_of(numbers, key, file);
    if (v.size() != dimensions)
        throw Error("{}: {}: {} has {} numbers, expected {}", file, key, excerpt(text), v.size(),
                    dimensions);
    return v;
}

std::size_t space_dimensions(const NrrdHeader& header) {
    const std::string space = lower_case(header.find("space").value_or(""));
    const auto said = header.find("spacedimension");
    const bool timed = space.ends_with("-time") ||
                       (space.size() == 4 && space.ends_with('t')) || // rast
                       (said && trimmed(*said) == "4");
    return timed ? 4 : 3;
}

std::vector<double> per_axis(const NrrdHeader& header, const std::string& key, std::size_t count) {
    const auto text = header.find(key);
    if (!text)
        return {};
    auto numbers = numbers_of(*text, key, header.file());
    if (numbers.size() != count)
        throw Error("{}: {} {}, expected {}", header.file(), numbers.size(), key, count);
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

NrrdAxes axes_of(const NrrdHeader& header, const ReadOptions& options) {
    const std::string& file = header.file();
    NrrdAxes axes;
    axes.sizes = integers_of(header.need("sizes"), "sizes", file);
    const std::size_t count = axes.sizes.size();
    const auto dimension = integers_of(header.need("dimension"), "dimension", file);
    if (dimension.size() != 1 || dimension[0] != static_cast<std::int64_t>(count))
        throw Error("{}: {} sizes, dimension is {}", file, count,
                    excerpt(header.need("dimension")));
    if (count < 3 || count > 5)
        throw Error("{}: {} dimensions, expected 3, or 4 with time", file, count);
    axes.units = quoted_in(header.find("units").value_or(""));
    if (axes.units.size() != count)
        axes.units.clear();
    std::vector<std::string> kinds = words_of(lower_case(header.find("kinds").value_or("")));
    if (kinds.size() != count)
        kinds.assign(count, "");
    std::vector<bool> spatial = spatial_by_kind(kinds);
    if (const auto text = header.find("spacedirections")) {
        const std::size_t dimensions = space_dimensions(header);
        for (const std::string& vector : vectors_in(*text)) {
            const auto v = nrrd_vector(vector, "space directions", file, dimensions);
            const bool along_time = v && dimensions == 4 && (*v)[3] != 0;
            if (along_time && ((*v)[0] != 0 || (*v)[1] != 0 || (*v)[2] != 0))
                throw Error(
                    "{}: space directions: {} goes through space and time, expected one of them",
                    file, excerpt(vector));
            if (along_time && axes.directions.size() < count)
                axes.time_step = (*v)[3], kinds[axes.directions.size()] = "time";
            axes.directions.push_back(v && !along_time
                                          ? std::optional(glm::dvec3((*v)[0], (*v)[1], (*v)[2]))
                                          : std::nullopt);
        }
        if (axes.directions.size() != count)
            throw Error("{}: {} space directions, expected {}", file, axes.directions.size(),
                        count);
        for (std::size_t axis = 0; axis < count; ++axis)
            spatial[axis] = axes.directions[axis].has_value();
    }
    std::size_t found = 0;
    for (std::size_t axis = 0; axis < count; ++axis) {
        if (spatial[axis]) {
            if (found == 3)
                throw Error("{}: more than 3 axes of space", file);
            axes.space[found++] = axis;
            continue;
        }
        if (count > 4 && axis != 0 && axis < 3)
            throw Error("{}: axis {} is not one of space; expected that of the slowest axes or the "
                        "fastest one only",
                        file, axis);
        const Role role = role_of(header, axis, kinds[axis], axes, options);
        std::optional<std::size_t>& place = role == Role::time ? axes.time : axes.components;
        if (place)
            throw Error("{}: axes {} and {} are both {}, expected one", file, *place, axis,
                        role == Role::time ? "time" : "components");
        place = axis;
    }
    if (found != 3)
        throw Error("{}: {} axes of space, expected 3", file, found);
    return axes;
}

} // namespace isochron::index
