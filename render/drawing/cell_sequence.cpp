// Sorts the cells of a view, and leaves out those that it cannot see.
#include "render/drawing/cell_sequence.h"

#include "render/cells/frame_block.h"

#include <algorithm>

namespace isochron::render {
namespace {

/// Where hidden cells are left out after sorting: sorting is two of five equal parts of the work.
constexpr std::size_t kSorting = 2, kAllParts = 5;

} // namespace

CellSequence CellSequence::part(std::size_t first, std::size_t end, std::size_t of) const {
    const std::size_t from = cells * first / of, to = cells * end / of;
    return {to - from, texture, begin + static_cast<int>(from) * step, step};
}

CellSequences::CellSequences(const Gl& gl) : orders_(gl), slots_(gl) {}

bool CellSequences::Seen::of(const SequenceWanted& wanted) const {
    return version == wanted.cells.version() && blended == wanted.blended && view == wanted.view &&
           placement == wanted.placement;
}

std::optional<CellSequence> CellSequences::find(const SequenceWanted& wanted, std::size_t to,
                                                std::size_t of) {
    const auto& cells = wanted.cells;
    if (wanted.leaves_out && seen_ && seen_->complete && seen_->of(wanted))
        return CellSequence{seen_->cells, slots_.texture(), 0, 1};
    const TraversalKey key = key_of(wanted.view, wanted.placement);
    const std::size_t sorting = wanted.leaves_out ? kSorting : kAllParts;
    const std::size_t sorted = std::min(kAllParts * to, sorting * of);
    if (sorted < sorting * of) {
        const std::size_t all = orders_.work(cells, key);
        orders_.advance(cells, key, all * sorted / (sorting * of));
        return std::nullopt;
    }
    if (wanted.leaves_out) {
        look(wanted, kAllParts * to - sorted, kAllParts * of - sorted);
        return seen_->complete ? std::optional(CellSequence{seen_->cells, slots_.texture(), 0, 1})
                               : std::nullopt;
    }
    if (to < of)
        return std::nullopt;
    const GLuint texture = orders_.texture(cells, key);
    return wanted.blended
               ? CellSequence{cells.size(), texture, 0, 1}
               : CellSequence{cells.size(), texture, static_cast<int>(cells.size()) - 1, -1};
}

void CellSequences::begin(const SequenceWanted& wanted) {
    seen_.emplace(wanted.cells.version(), wanted.view, wanted.placement, wanted.blended);
    finder_.begin(wanted.view, wanted.placement, wanted.shape, wanted.cells.slots(),
                  wanted.blended ? std::optional(wanted.falloff) : std::nullopt);
}

/// Finds the cells that are seen, up to `to` of `of` parts of that work.
void CellSequences::look(const SequenceWanted& wanted, std::size_t to, std::size_t of) {
    if (!seen_ || !seen_->of(wanted))
        begin(wanted);
    const std::span<const std::uint32_t> order =
        orders_.order(wanted.cells, key_of(wanted.view, wanted.placement));
    const std::span<const std::uint32_t> seen =
        finder_.advance(finder_.work() * to / of, wanted.cells.slots(), order);
    if (to < of)
        return;
    const std::span<const PixelSquare> parts = finder_.parts();
    if (parts.empty()) {
        slots_.set(GL_R32UI, sizeof(seen[0]), std::as_bytes(seen));
    } else {
        texels_.clear();
        for (std::size_t i = 0; i < seen.size(); ++i)
            texels_.push_back({seen[i], parts[i].corner, parts[i].size});
        slots_.set(GL_RGB32UI, sizeof(texels_[0]), std::as_bytes(std::span(texels_)));
    }
    seen_->cells = seen.size();
    seen_->complete = true;
}

} // namespace isochron::render
