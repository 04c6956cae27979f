// The values on a plane through an array: what a slice shows, from only the chunks that it cuts.
//
//     const index::SliceValues slice = index::slice_values(array, {.point = at, .normal = {0, 0, 1}});
//     const auto value = index::value_on(slice, array.info().grid, at);
#pragma once

#include "index/file/index_file.h"
#include "index/volume/instant.h"

#include <glm/vec3.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <stop_token>
#include <vector>

namespace isochron::index {

struct SliceQuery {
    Instant instant = {};
    std::uint32_t array = 0;                      ///< number of the index's array
    glm::dvec3 point{0.0}, normal{0.0, 0.0, 1.0}; ///< plane in physical space; normal: unit
    bool operator==(const SliceQuery&) const = default;
};

/// The values at the vertices of all cells that a plane cuts. Between vertices they are trilinear in
/// each cell. Vertices lie in columns along the axis that the plane is most across; of each column
/// only a run is held.
struct SliceValues {
    struct Column {
        std::uint32_t offset = 0; ///< where its run begins in `shares`
        std::uint32_t first = 0;  ///< index along `axis` of the run's first vertex
    };
    SliceQuery query;
    std::array<double, 2> whole{}; ///< lowest and highest value of the array at any step
    int axis = 2;                  ///< axis along which columns lie
    /// [i2][i1], i1 fastest: indices of vertices along the axes after `axis`, and after that.
    std::vector<Column> columns;
    /// Runs of values as shares of `whole`, 0 to 1; kNoShare where a value is missing.
    std::vector<float> shares;
    /// The values themselves in their type, as they are stored.
    std::vector<std::byte> stored;
    ValueType type{};
    Scaling scaling;
    /// Corners of the plane within the data's box, around it, in even coordinates; empty outside.
    std::vector<glm::dvec3> outline;
};
using SliceValuesPtr = std::shared_ptr<const SliceValues>;

/// Stands for a missing value: NaN or infinite.
inline constexpr float kNoShare = 3e38f;
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
