// Which cell has which slot, and how the slots of one set become those of the next.
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
/// A style is the number of the surface and, from bit kColorShift on, the color coordinate (0
/// where the set has no colors).
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
    /// By *rank*: surface after surface, in each in the order of its ids.
    std::vector<std::uint32_t> slot_of_rank;
    std::vector<CellPlace> places; ///< by slot
    /// By slot, the third word of an index::CellPoint; empty where only the GPU knows it.
    std::vector<std::uint32_t> planes;
};

/// Finds what changes from one set to the next, in portions that never take long: cells in both
/// keep their slots, new ones take those of cells that go, and the last ones move into holes, so
/// that the slots stay dense. First `merge` until it is done, then `message`.
class SlotPlan {
  public:
    /// @param from null where nothing is shown
    /// @param slots of `from`; both must live as long as the plan
    SlotPlan(const index::Grid& grid, const index::Extraction* from, const Slots& slots,
             const index::Extraction& to);

    /// Compares at most `cells` cells. @return true when all are compared
    bool merge(std::size_t cells);

    /// After merging: whether fewer words are sent as the whole set.
    bool whole() const { return 2 * changes_ >= cells_; }
    /// Words of the message: ids by rank, which are also their slots; or, where the set is not sent
    /// whole, two for each change: the slot, with the surface from bit kSurfaceShift on, and the
    /// id.
    std::size_t words() const { return whole() ? cells_ : 2 * changes_; }
    /// Ids in the message.
    std::size_t ids() const { return whole() ? cells_ : changes_; }
    static constexpr unsigned kSurfaceShift = 29;
    static constexpr std::size_t kMostSlots = std::size_t{1} << kSurfaceShift;

    /// Writes the next words as far as there is room.
    /// @param cells that may still be looked at; counted down
    /// @return words written
    std::size_t message(std::span<std::uint32_t> out, std::size_t& cells);
    /// Whether every cell has its slot and every word is written.
    bool done() const { return surface_ == to_->surfaces.size(); }

    /// Once done: what `take` gives.
    const Slots& slots() const { return next_; }
    /// Once done: the slots of the new set.
    Slots take() { return std::move(next_); }

  private:
    static constexpr std::uint32_t kNoSlot = ~0u;

    std::span<const index::CellId> ids_of(const index::Extraction* set) const;
    /// Of a cell of the surface where the walk is.
    std::uint16_t style_of(std::size_t rank) const;
    void find_free_slots();
    void next_surface();

    index::Grid grid_;
    const index::Extraction* from_;
    const Slots* slots_;
    const index::Extraction* to_;
    std::size_t cells_; ///< of the new set
    // Where the walk is: a surface, and in it the next cell of the old set and of the new one.
    std::size_t surface_ = 0, old_at_ = 0, new_at_ = 0;
    std::size_t old_rank_ = 0, new_rank_ = 0;
    index::CellWalk walk_;
    std::vector<std::uint32_t>
        free_; ///< slots of cells that go; once merged, all that are to be filled
    std::size_t free_at_ = 0, changes_ = 0;
    Slots next_;
};

} // namespace isochron::render
