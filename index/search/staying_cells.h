// Which cells of a step are as they were at another step, with all that lies around them.
#pragma once

#include "index/file/step_view.h"
#include "index/search/chunk_reach.h"

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace isochron::index {

/// Cells all of whose values, and with normals those of their neighbors, lie in chunks that have the
/// same bytes at both steps. The others may have changed.
class StayingCells {
  public:
    /// What the tables of an index say. @param step of the series @param at the other step
    /// @param normals whether the neighbors of the cells' vertices must have stayed, too
    /// @throws Error as ChunkStore does
    StayingCells(const StepView& step, Instant at, bool normals);

    /// Whether a chunk has the same bytes at both steps.
    bool has(std::uint32_t layer, std::uint32_t place) const {
        return !changed_[std::size_t{layer} * chunks_->chunks_of_layer() + place];
    }
    /// The cells of a chunk that may have changed, by where they lie in it.
    SidesOfCells others(std::uint32_t layer, std::uint32_t place) const {
        const auto [x, y] = chunks_->at(place);
        return others_[number(x, y, layer)];
    }
    bool has_cell(std::uint32_t x, std::uint32_t y, std::uint32_t z) const {
        return (others_[number(x / kChunkEdge, y / kChunkEdge, z / kChunkEdge)] >>
                    side_of_cell(x, y, z) &
                1) == 0;
    }
    /// Whether a cell stays together with all that share an edge with it. False for some that do.
    bool has_around(std::uint32_t x, std::uint32_t y, std::uint32_t z) const {
        const unsigned region =
            kRegion[x % kChunkEdge] +
            kRegions * (kRegion[y % kChunkEdge] + kRegions * unsigned{kRegion[z % kChunkEdge]});
        return (around_[number(x / kChunkEdge, y / kChunkEdge, z / kChunkEdge)] >> region & 1) == 0;
    }

  private:
    /// Along an axis: the cells of a chunk whose neighbors reach the chunk below, none, or that above.
    static constexpr unsigned kRegions = 3;
    static constexpr std::array<std::uint8_t, kChunkEdge> kRegion{0, 0, 1, 1, 1, 1, 1, 1,
                                                                  1, 1, 1, 1, 1, 2, 2, 2};
    static const std::array<std::uint32_t, kChunksAround> kRegionsNeeding;

    std::size_t number(std::uint32_t x, std::uint32_t y, std::uint32_t z) const {
        const auto& n = chunks_->counts();
        return (std::size_t{z} * n[1] + y) * n[0] + x;
    }

    const ChunkGrid* chunks_;
    std::vector<std::uint8_t> changed_; ///< by layer and place
    std::vector<SidesOfCells> others_;  ///< by position of the chunk, x fastest
    /// By position of the chunk: regions, all around which may have changed.
    std::vector<std::uint32_t> around_;
};

/// The share of chunks with the same bytes at both steps, among those that may hold active cells of
/// the isovalues at the step. 1 if there are none. Only tables are read. The index must have
/// bricks.
double staying_share(const StepView& step, Instant at, std::span<const double> isovalues);

} // namespace isochron::index
