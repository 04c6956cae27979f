// Finds the axes of an NRRD file that are space, time and components.
#pragma once

#include "index/readers/formats/medical/nrrd_header.h"
#include "index/volume/volume_series.h"

#include <glm/vec3.hpp>

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace isochron::index {

/// The times of a list of volumes, as 3D Slicer writes them.
struct NrrdTimes {
    std::string by;                 ///< what they are: `TriggerTime`
    std::vector<double> times = {}; ///< one for each; empty: they are not said
    std::string unit = {};
    std::vector<std::string> keys = {}; ///< that say so
};

/// The axes, fastest first, and their roles.
struct NrrdAxes {
    std::vector<std::int64_t> sizes;
    std::vector<std::optional<glm::dvec3>> directions; ///< none: not an axis of space
    /// Where space has time as its fourth dimension: the time between steps.
    std::optional<double> time_step;
    std::vector<std::string> units; ///< unit of each axis; may be empty
    std::array<std::size_t, 3> space{};
    /// The fastest or the slowest axis, if any.
    std::optional<std::size_t> components, time;
    std::optional<NrrdTimes> listed; ///< times of a list
    bool time_is_guessed = false;    ///< by the order of the axes, as the file gives no kinds
};

/// Finds the roles of axes by their kinds: `time` is time; `list`, `vector`, `3-color` and similar
/// kinds are components, except for lists that name times. An axis of another kind is time if its unit or `options` say so. In a file
/// without kinds and with more than three axes, the slowest is time and the fastest components.
/// @throws Error when the role of an axis stays open: it names the options that decide
NrrdAxes axes_of(const NrrdHeader& header, const ReadOptions& options);

/// The values of a field with one value for each axis; empty when the field is missing.
std::vector<double> per_axis(const NrrdHeader& header, const std::string& key, std::size_t count);

/// Reads a vector such as `(1,0,0)`; none for `none`.
std::optional<std::vector<double>> nrrd_vector(std::string_view text, const std::string& key,
                                               const std::string& file, std::size_t dimensions);

/// 4 of a space with time, such as `right-anterior-superior-time`, else 3.
std::size_t space_dimensions(const NrrdHeader& header);

/// The texts between quotation marks.
std::vector<std::string> quoted_in(std::string_view text);

} // namespace isochron::index
