// Projects and visits cells in pieces.
#include "render/culling/seen_slots.h"

#include <algorithm>
#include <limits>

namespace isochron::render {

void SeenSlots::begin(const View& view, const Placement& placement, const SplatShape& shape,
                      const Slots& slots, std::optional<float> falloff) {
    kind_ = falloff ? Kind::splats : shape.is_cut() ? Kind::cuts : Kind::squares;
    falloff_ = falloff.value_or(0.0f);
    view_ = view;
    squares_.begin(view, placement, shape, slots);
    projected_ = visited_ = count_ = 0;
    seen_.resize(squares_.size());
    parts_.resize(kind_ == Kind::cuts ? squares_.size() : 0);
}

std::span<const std::uint32_t> SeenSlots::advance(std::size_t to, const Slots& slots,
                                                  std::span<const std::uint32_t> back_to_front) {
    const std::size_t cells = squares_.size();
    if (projected_ < cells) {
        projected_ = std::min(to, cells);
        squares_.project_to(projected_, slots, back_to_front);
        if (projected_ == cells)
            lay_out_tiles();
    }
    if (to > cells && visited_ < cells) {
        constexpr std::size_t kBlock = CellSquares::kBlock;
        const std::size_t wanted = (to - cells + kVisit - 1) / kVisit;
        const std::size_t end = std::min((wanted + kBlock - 1) / kBlock * kBlock, cells);
        if (end > visited_)
            count_ += visit({visited_, end});
        visited_ = std::max(visited_, end);
        if (visited_ == cells) {
            seen_.resize(count_);
            for (std::uint32_t& cell : seen_)
                cell = back_to_front[cells - 1 - cell];
            if (kind_ == Kind::splats)
                std::ranges::reverse(seen_);
        }
    }
    return seen_;
}

/// Chooses the size of tiles: most squares cover some tiles. Cuts and splats cover many, because
/// only a part of a cut is drawn, and a splat lets light through at its rim.
void SeenSlots::lay_out_tiles() {
    constexpr float kFarthestDepth = std::numeric_limits<float>::max(), kAllLight = 1.0f;
    struct Layout {
        const float* half; ///< half the side of the cells' squares [pixel]
        float tiles;       ///< in this
        int most_bits;     ///< bits of a tile's side
        float empty;       ///< what a tile has at first
    };
    const auto [half, across, most_bits, empty] =
        kind_ == Kind::squares ? Layout{squares_.inner(), 1.5f, 4, kFarthestDepth}
        : kind_ == Kind::cuts  ? Layout{squares_.inner_disc(), 3.0f, 4, kFarthestDepth}
                               : Layout{squares_.inner_disc(), 8.0f, 3, kAllLight};
    tiles_.lay_out(view_, {half, squares_.size()}, across, most_bits, empty);
}

/// @return how many of the cells are visible
std::size_t SeenSlots::visit(CellRange range) {
    std::uint32_t* const seen = seen_.data() + count_;
    switch (kind_) {
    case Kind::squares: return find_squares(squares_, tiles_.numbers(), range, seen);
    case Kind::cuts:
        return find_cuts(squares_, tiles_.numbers(), range, seen, parts_.data() + count_);
    case Kind::splats: break;
    }
    return find_splats(squares_, falloff_, tiles_.numbers(), range, seen);
}

} // namespace isochron::render
