// The cells and deltas of a whole series, and the search in them.
#pragma once

#include "index/cells/cell_unit.h"
#include "index/system/lazy_part.h"
#include "index/volume/stretches.h"

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <shared_mutex>
#include <span>
#include <vector>

namespace isochron::index {

/// Refers to the bytes of the units. A table is read and checked when it is first needed, not
/// before; that throws Error if its bytes are damaged or cannot be read. Any number of threads may
/// search at once; a search allocates memory for its results only.
///
///     index::CellTier cells(Stretches(grid), steps, cell_bytes, delta_bytes);
///     const auto held = cells.hold();
///     cells.search(t, cut, certain, ambiguous);
///     index::assign_ids(certain, ids);
class CellTier {
  public:
    /// One unit for each stretch of each epoch: [epoch][stretch], epochs of TimePath::kMaxSteps steps.
    using Units = std::vector<std::span<const std::byte>>;

    /// The memory of each epoch's units, if they are read from a file when they are needed.
    using Pages = std::vector<std::unique_ptr<LazyPart>>;

    /// @param deltas may be empty
    /// @param pages one for each epoch, or none at all; outlives this
    /// @param budget bytes of the pages to keep
    CellTier(const Stretches& stretches, std::uint32_t steps, const Units& cells,
             const Units& deltas, const Pages* pages = nullptr, std::uint64_t budget = 0);

    /// Number of the series' first steps that it holds.
    std::uint32_t steps() const { return steps_; }

    /// While a lock is held, the results of searches stay valid. If more has been read than the
    /// budget allows and nobody else holds the tier, this first drops everything that was read.
    std::shared_lock<std::shared_mutex> hold() const;

    /// Bytes of its pages that are in memory.
    std::uint64_t held_bytes() const;

    bool has_deltas() const { return !deltas_.empty(); }

    /// Appends the active cells to `certain`, and the cells that only the volume decides to
    /// `ambiguous`.
    void search(std::uint32_t step, LevelMap::Cut cut, std::vector<IdRun>& certain,
                std::vector<IdRun>& ambiguous) const;
    /// Appends the cells that become active, and that cease to be active, between two neighboring
    /// steps, in either direction. Needs deltas and an exact cut.
    void change(std::uint32_t from, std::uint32_t to, LevelMap::Cut cut, std::vector<IdRun>& added,
                std::vector<IdRun>& removed) const;
    /// Appends the cells that may be active at only one of two steps: the active entries of time
    /// nodes that do not span both. A cell whose extremes changed may be in both sets. The cut must
    /// be exact.
    void difference(std::uint32_t step_a, std::uint32_t step_b, LevelMap::Cut cut,
                    std::vector<IdRun>& only_a, std::vector<IdRun>& only_b) const;
    /// Appends the cells that are active at only one of two isovalues. Both cuts must be exact.
    void level_difference(std::uint32_t step, LevelMap::Cut from, LevelMap::Cut to,
                          std::vector<IdRun>& added, std::vector<IdRun>& removed) const;

    /// About how many bytes `search` would read of the file, from a few stretches: reads their heads.
    /// 0 if it would read none, or if one of these is damaged. Call it while a lock is held.
    std::uint64_t missing_bytes(std::uint32_t step) const;
    /// Whether something of the step's epoch is in memory.
    bool holds_some(std::uint32_t step) const {
        return !pages_ || (*pages_)[step / TimePath::kMaxSteps]->held() > 0;
    }

    /// Entries of every time node of every epoch, over all stretches, in depth-first order.
    std::vector<TimeNodeCells> nodes() const;
    /// Checks everything, even what no search has needed yet. @throws Error when damaged
    void verify() const;
    /// Checks one unit, which must have been read as a whole.
    /// @param unit by epoch and stretch, stretches faster @throws Error when damaged
    void verify_unit(std::size_t unit) const;

  private:
    /// An array of bits that any thread may set.
    class Marks {
      public:
        explicit Marks(std::size_t count)
            : count_((count + 63) / 64),
              words_(std::make_unique<std::atomic<std::uint64_t>[]>(count_)) {}
        bool operator[](std::size_t i) const {
            return words_[i / 64].load(std::memory_order_acquire) >> i % 64 & 1;
        }
        void set(std::size_t i) {
            words_[i / 64].fetch_or(std::uint64_t{1} << i % 64, std::memory_order_release);
        }
        void clear() {
            for (std::size_t word = 0; word < count_; ++word)
                words_[word] = 0;
        }

      private:
        std::size_t count_; ///< number of words
        std::unique_ptr<std::atomic<std::uint64_t>[]> words_;
    };

    template <class F>
    void for_each_cells(std::uint32_t step, F&& f) const;
    void expect_cells(std::uint32_t step) const;
    void check_cells(std::uint32_t epoch, std::uint32_t stretch, std::uint32_t step) const;
    void check_deltas(std::uint32_t epoch, std::uint32_t stretch, std::uint32_t step) const;
    void need(std::uint32_t epoch, std::span<const std::byte> bytes) const {
        if (pages_)
            (*pages_)[epoch]->need(bytes);
    }

    std::uint32_t epoch_steps(std::uint32_t epoch) const;
    TimePath path_to(std::uint32_t step) const;

    Stretches stretches_;
    std::uint32_t steps_;
    std::vector<CellUnit> cells_;
    std::vector<DeltaUnit> deltas_;
    /// What has been checked: everything that a search needs at a step of a unit; a unit's head and
    /// tables; transitions of deltas.
    mutable Marks sound_steps_, sound_tables_, sound_transitions_;
    const Pages* pages_;
    std::uint64_t budget_;
    mutable std::shared_mutex held_;
};

} // namespace isochron::index
