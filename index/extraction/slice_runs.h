// Which values a plane through a grid needs, and where they go: without a file, for whoever has chunks.
#pragma once

#include "index/file/chunks/chunk_grid.h"
#include "index/volume/grid.h"
#include "index/volume/instant.h"
#include "index/volume/value_type.h"

#include <glm/vec3.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
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
/// Runs of vertices along one axis: those of the cells that a plane cuts.
class SliceRuns {
  public:
    using Vertex = std::array<std::uint32_t, 3>;
    SliceRuns(const Grid& grid, const SliceQuery& query);

    /// Whether the plane cuts nothing of the grid's box.
    bool empty() const { return outline_.empty(); }
    /// Number of values, and of columns, that a slice has.
    std::size_t values() const { return values_; }
    std::size_t columns() const { return first_.size(); }
    /// The chunks that hold vertices of the runs: by layer, their places, ascending.
    std::vector<std::vector<std::uint32_t>> chunks(const ChunkGrid& chunks) const;
    /// A slice in which every value is missing.
    /// @param whole as in `SliceValues` @param type, scaling of what is copied to it
    SliceValues empty_slice(const std::array<double, 2>& whole, ValueType type,
                            const Scaling& scaling) const;
    /// Copies what a block of stored values has of the runs.
    /// @param values [z][y][x], x fastest, in the slice's type @param low its first vertex
    void copy(std::span<const std::byte> values, const Vertex& low, const Vertex& size,
              SliceValues& slice) const;

  private:
    template <class T>
    void copy_of(const T* values, const Vertex& low, const Vertex& size, SliceValues& slice) const;

    SliceQuery query_;
    int axis_ = 2;
    std::uint32_t along1_ = 0, along2_ = 0;   ///< columns along the two other axes
    std::vector<std::uint32_t> first_, last_; ///< vertices; first > last: none
    std::size_t values_ = 0;
    std::vector<glm::dvec3> outline_;
};

} // namespace isochron::index
