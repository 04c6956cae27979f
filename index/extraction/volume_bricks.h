// Volume bricks: the parts of a step's volume that its active cells need, packed for a GPU.
#pragma once

#include "index/extraction/brick_values.h"
#include "index/file/step_view.h"
#include "index/surface/cell_set.h"
#include "index/volume/step_values.h"

#include <array>
#include <cstdint>
#include <span>
#include <stop_token>
#include <vector>

namespace isochron::index {

/// Vertices along each side of a volume brick. In this file, "brick" always means a volume brick;
/// the bricks of scan/bricks.h are blocks of 8 x 4 x 4 cells.
constexpr std::uint32_t kBrickEdge = 8;
constexpr std::uint32_t kBrickVertices = kBrickEdge * kBrickEdge * kBrickEdge;

using BrickId = std::uint32_t; ///< x fastest, then y, then z

/// The bricks that tile the vertices of a grid; the last ones of an axis may reach beyond the grid.
struct BrickTiling {
    explicit BrickTiling(const Grid& grid);
    std::size_t count() const { return std::size_t{bricks[0]} * bricks[1] * bricks[2]; }
    std::array<std::uint32_t, 3> bricks;
};

/// A hash of 128 bits of a brick's bytes: equal digests mean equal bytes.
struct BrickDigest {
    std::uint64_t low = 0, high = 0;
    bool operator==(const BrickDigest&) const = default;
};

/// Some bricks of one step.
struct VolumeBricks {
    ValueType held = ValueType::f32;  ///< of the values in `bytes`
    float factor = 1;                 ///< see BrickValues
    float range = 1;                  ///< width of the data set's range, in brick units
    std::vector<BrickId> ids;         ///< ascending
    std::vector<BrickDigest> digests; ///< in the same order: a brick with the same id and digest
                                      ///< need not be uploaded again
    std::vector<std::byte> bytes;     ///< same order; [z][y][x], x fastest; 0 beyond the grid

    std::size_t brick_bytes() const { return kBrickVertices * size_of(held); }
    std::span<const std::byte> brick(std::size_t i) const {
        return std::span(bytes).subspan(i * brick_bytes(), brick_bytes());
    }
};

/// Collects the bricks that hold the vertices of cells and the neighbors of these along each axis,
/// which central differences need.
class BrickGatherer {
  public:
    BrickGatherer(const Grid& grid, const BrickValues& values);

    /// The result of `gather` if nothing is marked.
    VolumeBricks none() const;
    /// Marks the bricks that a set's cells need. @param set with points, if the grid has wide ids
    void need(const CellSet& set);
    /// Copies the bricks that have been marked since the last call, then clears the marks. From
    /// chunks it does so with all cores.
    /// @return false when it was stopped and the bricks are incomplete
    /// @throws Error as ChunkStore does
    bool gather(const StepView& step, const BrickLevels& levels, VolumeBricks& bricks,
                const std::stop_token& stop = {});
    /// The same from values in memory.
    bool gather(const StepValues& step, Instant at, const BrickLevels& levels, VolumeBricks& bricks,
                const std::stop_token& stop = {});

  private:
    struct Box;
    template <class PlaceOf>
    void mark(std::size_t cells, PlaceOf&& place_of);
    void mark_row(std::uint32_t y, std::uint32_t z);
    std::array<std::uint32_t, 3> at(BrickId brick) const;
    void take_marked(VolumeBricks& bricks);
    bool gather_chunks(const StepView& step, const BrickLevels& levels, VolumeBricks& bricks,
                       const std::stop_token& stop);
    void copy(const Box& from, const BrickLevels& levels, VolumeBricks& bricks,
              std::size_t i) const;

    Grid grid_;
    BrickTiling tiling_;
    BrickValues values_;
    std::vector<std::uint8_t> needed_;                ///< by brick id
    std::vector<std::uint8_t> row_inner_, row_outer_; ///< of a row of cells, by brick along x
};

} // namespace isochron::index
