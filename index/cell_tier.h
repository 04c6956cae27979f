// The cells and deltas of a whole series: one search over the chunks of an epoch.
#pragma once

#include "index/cell_unit.h"
#include "index/chunking.h"

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <vector>

namespace isochron::index {

/// The units stay where they are, usually in a mapped file. One is checked when it is first needed,
/// which throws Error where its bytes are damaged. Any number of threads may search at once; a
/// search allocates nothing but what the results need.
///
///     index::CellTier cells(Chunking(grid), steps, cell_bytes, delta_bytes);
///     cells.search(t, cut, certain, ambiguous);
///     index::append_ids(certain, ids);
class CellTier {
  public:
    /// One for each chunk of each epoch: [epoch][chunk], epochs of TimePath::kMaxSteps steps.
    using Units = std::vector<std::span<const std::byte>>;

    /// Called before a unit is first looked at, as to compare its checksum; throws to refuse it.
    using FirstTouch = std::function<void(std::span<const std::byte> unit)>;

    /// @param deltas may be empty
    CellTier(const Chunking& chunking, std::uint32_t steps, const Units& cells, const Units& deltas,
             FirstTouch first_touch = {});

    bool has_deltas() const { return !deltas_.units.empty(); }

    /// Appends the active cells, and apart from them those that only the volume decides.
    void search(std::uint32_t step, LevelMap::Cut cut, std::vector<IdRun>& certain,
                std::vector<IdRun>& ambiguous) const;
    /// Appends what changes between neighbouring steps, either way. Needs deltas and an exact cut.
    void change(std::uint32_t from, std::uint32_t to, LevelMap::Cut cut, std::vector<IdRun>& added,
                std::vector<IdRun>& removed) const;
    /// Appends what may be active at one of two steps only: the entries of the time nodes that do
    /// not span both. A cell whose extremes have changed may be in both sets. The cut is exact.
    void difference(std::uint32_t step_a, std::uint32_t step_b, LevelMap::Cut cut,
                    std::vector<IdRun>& only_a, std::vector<IdRun>& only_b) const;
    /// Appends what is active at one of two isovalues only. Both cuts are exact.
    void level_difference(std::uint32_t step, LevelMap::Cut from, LevelMap::Cut to,
                          std::vector<IdRun>& added, std::vector<IdRun>& removed) const;

  private:
    template <class Unit>
    struct Checked {
        const char* kind;
        Units bytes;
        std::vector<Unit> units;
        std::unique_ptr<std::atomic<bool>[]> sound; ///< of every unit: found so by a first use
    };
    template <class Unit>
    Checked<Unit> unchecked(const char* kind, const Units& bytes) const;
    template <class Unit>
    const Unit& unit(const Checked<Unit>& all, std::uint32_t epoch, std::uint32_t chunk) const;
    template <class Unit, class Prefetch, class F>
    void for_each_chunk(const Checked<Unit>& all, std::uint32_t epoch, Prefetch&& prefetch,
                        F&& f) const;
    template <class F>
    void for_each_chunk(const TimePath& path, std::uint32_t epoch, F&& f) const;

    std::uint32_t epoch_steps(std::uint32_t epoch) const;

    Chunking chunking_;
    std::uint32_t steps_;
    FirstTouch first_touch_;
    Checked<CellUnit> cells_;
    Checked<DeltaUnit> deltas_;
};

} // namespace isochron::index
