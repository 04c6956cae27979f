// Units of length as files write them, and axes with units of their own.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <glm/vec3.hpp>

namespace isochron::index {

/// Meters in a unit, by its name or sign (`um`, `µm`, `micron`, `micrometers`); none: unknown.
std::optional<double> meters_in(std::string_view unit);

/// The sign that is shown for a unit: `um` of `microns`; others as they are, none of `pixel`.
std::string tidy_length_unit(const std::string& unit);

/// Factors that turn lengths with a unit for each axis into lengths with one unit.
struct OneLengthUnit {
    std::string unit;               ///< unit of the first axis that has any
    glm::dvec3 factor{1.0};         ///< factor of each axis to this unit
    std::vector<std::string> notes; ///< one sentence, where units differ
};

/// @param units of x, y and z; axes without any are taken to have that of the others
OneLengthUnit one_length_unit(const std::array<std::string, 3>& units);

} // namespace isochron::index
