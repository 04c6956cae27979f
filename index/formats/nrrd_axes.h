// Which axes of an NRRD file are space, time and components.
#pragma once

#include "index/formats/nrrd_header.h"
#include "index/volume/volume_series.h"

#include <glm/vec3.hpp>

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace isochron::index {

/// What each axis is, fastest first.
struct NrrdAxes {
    std::vector<std::int64_t> sizes;
    std::vector<std::optional<glm::dvec3>> directions; ///< none: not an axis of space
    std::vector<std::string> units;                    ///< of each axis, or empty
    std::array<std::size_t, 3> space{};
    /// The fastest or the slowest axis, if any.
    std::optional<std::size_t> components, time;
    bool time_is_guessed = false; ///< from the order of the axes, where the file gives no kinds
};

/// Kinds decide: `time` is time, `list`, `vector`, `3-color` and their like are components. An axis
/// of no such kind is time where its unit or `options` say so. In a file without kinds the slowest
/// axis of more than three is time and the fastest components.
/// @throws Error when that leaves open what an axis is: it names the options that decide
NrrdAxes axes_of(const NrrdHeader& header, const ReadOptions& options);

/// The values of a field that has one for each axis; empty when there is none.
std::vector<double> per_axis(const NrrdHeader& header, const std::string& key, std::size_t count);

/// `(1,0,0)` as numbers; none for `none`.
std::optional<glm::dvec3> nrrd_vector(std::string_view text, const std::string& key,
                                      const std::string& file);

/// The texts between quotation marks.
std::vector<std::string> quoted_in(std::string_view text);

} // namespace isochron::index
