// Blends two whole steps where cells may be active, and leaves out all else.
#pragma once

#include "index/file/step_view.h"
#include "index/search/step_slab.h"
#include "index/system/huge_pages.h"
#include "index/volume/level_map.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <stop_token>
#include <vector>

namespace isochron::index {

/// Two steps in memory, and their blends in the bricks that may hold active cells and one vertex
/// around these, which normals need. Of two steps that differ little these are as few as at a step.
/// Layers are of chunks; work on different ones may overlap in time.
class NearBlend {
  public:
    /// Whether both steps of a view are better worked on as a whole, and there is room for blends.
    static bool worth(const StepView& step);
    /// Reads both steps, and finds the bricks. @param cut among the levels of the view, which
    /// outlives this @throws Stopped, and Error as ChunkStore does
    NearBlend(const StepView& step, const LevelMap::Cut& cut, const std::stop_token& stop);
    ~NearBlend();
    NearBlend(const NearBlend&) = delete;
    NearBlend& operator=(const NearBlend&) = delete;

    std::uint32_t layers() const { return StepSlab::layers(grid()); }
    /// Number of bricks that may hold active cells.
    std::size_t candidates() const { return candidates_.size(); }
    bool has_candidates(std::uint32_t layer) const { return !bricks_[layer].empty(); }
    /// Blends the planes of vertices of a layer.
    void blend(std::uint32_t layer) const;
    /// A layer's cells with their bricks, once it and those next to it have been blended. Values
    /// elsewhere have no meaning.
    StepPart part(std::uint32_t layer) const;

  private:
    using Word = std::uint64_t;
    const Grid& grid() const { return step_.grid(); }
    void mark(std::span<const std::uint8_t> all);
    bool is_empty(std::span<const Word> plane, std::uint32_t y) const;
    void add_runs(std::span<const Word> marks, std::size_t row, std::size_t end,
                  std::vector<Blend::Run>& runs) const;

    const StepView& step_;
    LoadedStep now_, next_;
    std::array<std::uint32_t, 3> counts_;           ///< bricks along each axis
    std::size_t words_;                             ///< words of marks of a row of bricks
    std::vector<Word> marks_;                       ///< candidates, a bit each, by row of bricks
    std::vector<std::vector<std::uint8_t>> bricks_; ///< by layer, as from `build_bricks`
    std::vector<std::uint32_t> candidates_;         ///< bricks, ascending
    std::uint64_t bytes_;                           ///< room for the blends
    LargeMemory blends_;
};

} // namespace isochron::index
