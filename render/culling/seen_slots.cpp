// Projects and visits cells in pieces.
#include "render/culling/seen_slots.h"

#include <algorithm>

namespace isochron::render {

void SeenSlots::begin(const View& view, const Placement& placement, const SplatShape& shape,
                      const Slots& slots) {
    view_ = view;
    squares_.begin(view, placement, shape, slots);
    projected_ = visited_ = count_ = 0;
    seen_.resize(squares_.size());
    parts_.resize(finds_parts() ? squares_.size() : 0);
}

std::span<const std::uint32_t> SeenSlots::advance(std::size_t to, const Slots& slots,
                                                  std::span<const std::uint32_t> back_to_front) {
    const std::size_t cells = squares_.size();
    if (projected_ < cells) {
        projected_ = std::min(to, cells);
        squares_.project_to(projected_, slots, back_to_front);
        if (projected_ == cells)
            lay_out(view_, squares_, tiles_);
    }
    if (to > cells && visited_ < cells) {
        constexpr std::size_t kBlock = CellSquares::kBlock;
        const std::size_t wanted = (to - cells + kVisit - 1) / kVisit;
        const std::size_t end = std::min((wanted + kBlock - 1) / kBlock * kBlock, cells);
        if (end > visited_)
            count_ += visit(squares_, tiles_.numbers(), visited_, end, seen_.data() + count_,
                            finds_parts() ? parts_.data() + count_ : nullptr);
        visited_ = std::max(visited_, end);
        if (visited_ == cells) {
            seen_.resize(count_);
            for (std::uint32_t& cell : seen_)
                cell = back_to_front[cells - 1 - cell];
            if (!nearest_first())
                std::ranges::reverse(seen_);
        }
    }
    return seen_;
}

} // namespace isochron::render
