// The values on a plane through an array: what a slice shows, from only the chunks that it cuts.
//
//     const index::SliceValues slice = index::slice_values(array, {.point = at, .normal = {0, 0, 1}});
//     const auto value = index::value_on(slice, array.info().grid, at);
#pragma once

#include "index/extraction/slice_runs.h"
#include "index/file/index_file.h"

#include <glm/vec3.hpp>

#include <cstddef>
#include <optional>
#include <stop_token>

namespace isochron::index {

/// Slices of more values or columns are refused: drivers hold no more in a buffer.
inline constexpr std::size_t kMostSliceValues = std::size_t{1} << 27;

/// @param array the array of the query
/// @throws Error when chunks cannot be read or are damaged, and for too large a slice
/// @throws Stopped when it is asked to stop
SliceValues slice_values(const IndexFile& array, const SliceQuery& query,
                         const std::stop_token& stop = {});

/// The value at a place on the plane, as `value_at` has it.
/// @param at physical space, within half a cell of the plane
/// @return nothing outside the grid or away from the plane, and in cells that miss a value
std::optional<double> value_on(const SliceValues& slice, const Grid& grid, const glm::dvec3& at);

} // namespace isochron::index
