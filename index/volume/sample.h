// Interpolates the value at a place between the vertices of a step.
#pragma once

#include "index/volume/step_values.h"

#include <glm/vec3.hpp>

#include <array>
#include <cstdint>
#include <functional>
#include <optional>

namespace isochron::index {

/// Trilinear interpolation of the scaled values, in double.
/// @param at physical space
/// @return nothing outside the grid, or if one of the cell's vertices is NaN or infinite
std::optional<double> value_at(const StepValues& values, std::uint32_t step, const glm::dvec3& at);

/// Gives the scaled value of a vertex, by its coordinates along x, y and z.
using ScaledVertex = std::function<double(const std::array<std::uint32_t, 3>&)>;
/// The value at a place between vertices whose values `vertex` gives.
std::optional<double> value_at(const Grid& grid, const glm::dvec3& at, const ScaledVertex& vertex);

} // namespace isochron::index
