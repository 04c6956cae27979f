// Assigns slots to the cells of a set, with few changes from one set to the next.
#pragma once

#include "index/extraction/extraction.h"
#include "index/volume/cell_walk.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace isochron::render {

constexpr unsigned kColorShift = 3;

/// The first two words of an index::CellPoint.
/// A style is the number of the surface and, from bit kColorShift on, the color coordinate (0 if
/// the set has no colors).
struct CellPlace {
    std::uint16_t x = 0, y = 0, z = 0, style = 0;
    bool operator==(const CellPlace&) const = default;
};
static_assert(sizeof(CellPlace) == 8);

constexpr std::uint16_t cell_style(std::size_t surface, unsigned color) {
    return static_cast<std::uint16_t>(surface | color << kColorShift);
}

/// The cells of all surfaces in slots 0 to n - 1.
struct Slots {
    /// By *rank*: surface by surface, and within a surface in the order of its ids. Empty: the slots
    /// are the ranks.
    std::vector<std::uint32_t> slot_of_rank;
    std::uint32_t slot_of(std::size_t rank) const {
        return slot_of_rank.empty() ? static_cast<std::uint32_t>(rank) : slot_of_rank[rank];
    }
    std::vector<CellPlace> places; ///< by slot
    /// By slot, the third word of an index::CellPoint; empty if only the GPU has them.
    std::vector<std::uint32_t> planes;
    /// Size of the largest cell [voxels] if the cells are of mixed levels of detail
    /// (index/detail/detail_regions.h); else 0.
    std::uint32_t largest = 0;
};

/// Finds the changes from one set to the next, in short portions. Cells in both sets keep their
/// slots, new cells take slots of removed ones, and cells with the last slots move into holes, so
/// that slots stay dense. Call `merge` until it is done, then `message`.
class SlotAssignment {
  public:
    /// @param from null if nothing is shown
    /// @param slots of `from`; both sets and these must live as long as the assignment
    SlotAssignment(const index::Grid& grid, const index::Extraction* from, const Slots& slots,
                   const index::Extraction& to);

    /// Compares at most `cells` cells. Where the new set knows what came and went since `from`, only
    /// that is looked at. @return true when all are compared
    bool merge(std::size_t cells);

    /// After merging: whether the whole set is sent, as that takes no more words than the changes.
    bool whole() const { return 2 * changes_ >= cells_; }
    /// Number of words in the message. A whole set has one word per cell: the id, by rank, which is
    /// also its slot. Else there are two words for each change: the slot, with the surface from bit
    /// kSurfaceShift on, and the id.
    std::size_t words() const { return whole() ? cells_ : 2 * changes_; }
    /// Number of ids in the message.
    std::size_t ids() const { return whole() ? cells_ : changes_; }
    static constexpr unsigned kSurfaceShift = 29;
    static constexpr std::size_t kMostSlots = std::size_t{1} << kSurfaceShift;

    /// Writes the next words of the message, as far as there is room.
    /// @param cells number that may still be handled; counted down
    /// @return words written
    std::size_t message(std::span<std::uint32_t> out, std::size_t& cells);
    /// Whether every cell has a slot and every word is written.
    bool done() const { return surface_ == to_->surfaces.size(); }

    /// Once done: the slots of the new set.
    const Slots& slots() const { return next_; }
    /// Once done: moves the slots of the new set out.
    Slots take() { return std::move(next_); }

  private:
    static constexpr std::uint32_t kNoSlot = ~0u;

    std::span<const index::CellId> ids_of(const index::Extraction* set) const;
    /// Style of a cell of the current surface.
    std::uint16_t style_of(std::size_t rank) const;
    void find_free_slots();
    void next_surface();
    bool follow(std::size_t& cells);
    const index::SurfaceChange* known_change() const;

    index::Grid grid_;
    const index::Extraction* from_;
    const Slots* slots_;
    const index::Extraction* to_;
    std::size_t cells_; ///< number of cells in the new set
    // Position of the walk: a surface, and in it the next cell of the old set and of the new one.
    std::size_t surface_ = 0, old_at_ = 0, new_at_ = 0;
    std::size_t old_rank_ = 0, new_rank_ = 0;
    std::size_t removed_at_ = 0, added_at_ = 0; ///< in the known change of the surface
    index::CellWalk walk_;
    std::vector<std::uint32_t> free_; ///< slots of removed cells; after merging, all slots to fill
    std::size_t free_at_ = 0, changes_ = 0;
    Slots next_;
};

} // namespace isochron::render
