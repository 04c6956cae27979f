// The value between the vertices of a step.
#pragma once

#include "index/volume/step_values.h"

#include <glm/vec3.hpp>

#include <optional>

namespace isochron::index {

/// Trilinear, of the scaled values, in double.
/// @param at physical space
/// @return nothing beyond the grid, and where one of the vertices around is not a number
std::optional<double> value_at(const StepValues& values, std::uint32_t step, const glm::dvec3& at);

} // namespace isochron::index
