// Merges sorted ids and assigns slots.
#include "render/cells/slot_assignment.h"

#include <algorithm>

namespace isochron::render {

SlotAssignment::SlotAssignment(const index::Grid& grid, const index::Extraction* from,
                               const Slots& slots, const index::Extraction& to)
    : grid_(grid), from_(from), slots_(&slots), to_(&to), cells_(to.cells()), walk_(grid) {
    next_.slot_of_rank.resize(cells_);
    next_.places.resize(cells_);
}

std::span<const index::CellId> SlotAssignment::ids_of(const index::Extraction* set) const {
    if (!set || surface_ >= set->surfaces.size())
        return {};
    return set->surfaces[surface_].ids;
}

void SlotAssignment::next_surface() {
    ++surface_;
    old_at_ = new_at_ = removed_at_ = added_at_ = 0;
    walk_ = index::CellWalk(grid_);
}

std::uint16_t SlotAssignment::style_of(std::size_t rank) const {
    return cell_style(surface_, to_->colors.empty() ? 0 : to_->colors[rank]);
}

/// What is known of the current surface; null: both sets are compared.
const index::SurfaceChange* SlotAssignment::known_change() const {
    const bool known = from_ && from_->number != 0 && to_->change.from == from_->number &&
                       from_->surfaces.size() == to_->surfaces.size();
    return known ? &to_->change.surfaces[surface_] : nullptr;
}

/// Takes over the slots of the current surface's cells, run by run, by its known change.
/// @param cells that may still be handled; counted down @return true when all are
bool SlotAssignment::follow(std::size_t& cells) {
    const index::SurfaceChange& change = *known_change();
    const std::size_t old_end = ids_of(from_).size(), new_end = ids_of(to_).size();
    while (old_at_ < old_end || new_at_ < new_end) {
        if (cells == 0)
            return false;
        const std::size_t removed =
            removed_at_ < change.removed.size() ? change.removed[removed_at_] : old_end;
        const std::size_t added =
            added_at_ < change.added.size() ? change.added[added_at_] : new_end;
        if (old_at_ == removed && old_at_ < old_end) {
            free_.push_back(slots_->slot_of(old_rank_++));
            ++old_at_, ++removed_at_, --cells;
        } else if (new_at_ == added && new_at_ < new_end) {
            next_.slot_of_rank[new_rank_++] = kNoSlot;
            ++new_at_, ++added_at_, --cells;
        } else {
            const std::size_t run = std::min({removed - old_at_, added - new_at_, cells});
            for (std::size_t i = 0; i < run; ++i)
                next_.slot_of_rank[new_rank_ + i] = slots_->slot_of(old_rank_ + i);
            old_at_ += run, new_at_ += run, old_rank_ += run, new_rank_ += run, cells -= run;
        }
    }
    return true;
}

bool SlotAssignment::merge(std::size_t cells) {
    const std::size_t surfaces =
        std::max(to_->surfaces.size(), from_ ? from_->surfaces.size() : std::size_t{0});
    for (; surface_ < surfaces; next_surface()) {
        if (known_change()) {
            if (!follow(cells))
                return false;
            continue;
        }
        const auto before = ids_of(from_), after = ids_of(to_);
        while (old_at_ < before.size() || new_at_ < after.size()) {
            if (cells-- == 0)
                return false;
            const bool goes = new_at_ == after.size() ||
                              (old_at_ < before.size() && before[old_at_] < after[new_at_]);
            const bool comes =
                !goes && (old_at_ == before.size() || after[new_at_] < before[old_at_]);
            if (goes)
                free_.push_back(slots_->slot_of(old_rank_));
            else
                next_.slot_of_rank[new_rank_++] = comes ? kNoSlot : slots_->slot_of(old_rank_);
            new_at_ += !goes;
            old_at_ += !comes;
            old_rank_ += !comes;
        }
    }
    find_free_slots();
    surface_ = old_at_ = new_at_ = old_rank_ = new_rank_ = 0;
    return true;
}

void SlotAssignment::find_free_slots() {
    const auto now = static_cast<std::uint32_t>(slots_->places.size());
    const auto then = static_cast<std::uint32_t>(cells_);
    std::erase_if(free_, [&](std::uint32_t slot) { return slot >= then; });
    for (std::uint32_t slot = now; slot < then; ++slot)
        free_.push_back(slot);
    changes_ = free_.size();
}

std::size_t SlotAssignment::message(std::span<std::uint32_t> out, std::size_t& cells) {
    const auto slots = static_cast<std::uint32_t>(cells_);
    const std::size_t words_each = whole() ? 1 : 2;
    std::size_t written = 0;
    for (; surface_ < to_->surfaces.size(); next_surface())
        for (const auto ids = ids_of(to_); new_at_ < ids.size(); ++new_at_, ++new_rank_) {
            std::uint32_t& slot = next_.slot_of_rank[new_rank_];
            const bool sent = whole() || slot >= slots; // kNoSlot, or beyond the new end
            if (cells == 0 || (sent && out.size() - written < words_each))
                return written;
            --cells;
            if (whole()) {
                slot = static_cast<std::uint32_t>(new_rank_);
            } else if (sent) {
                slot = free_[free_at_++];
                out[written++] = slot | static_cast<std::uint32_t>(surface_) << kSurfaceShift;
            }
            if (sent)
                out[written++] = ids[new_at_];
            walk_.to(ids[new_at_]);
            next_.places[slot] = {static_cast<std::uint16_t>(walk_.x()),
                                  static_cast<std::uint16_t>(walk_.y()),
                                  static_cast<std::uint16_t>(walk_.z()), style_of(new_rank_)};
        }
    return written;
}

} // namespace isochron::render
