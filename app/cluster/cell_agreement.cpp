// Lets the processes of a cluster agree on the set of cells that they all show.
#include "app/cluster/cell_agreement.h"

#include <algorithm>

namespace isochron::app {

const CellOrder& CellAgreement::decide(std::span<const CellProgress> all) {
    const auto every = [&](auto claim) { return std::ranges::all_of(all, claim); };
    const auto any = [&](auto claim) { return std::ranges::any_of(all, claim); };
    if (every([&](const CellProgress& each) { return each.staged == order_.stage; }))
        order_.show = order_.stage;
    const std::uint64_t asked = order_.ask;
    const bool answered = every([&](const CellProgress& each) {
        return each.asked == asked && (each.found == asked || each.failed == asked);
    });
    if (!answered)
        return order_;
    // If one process cannot get the cells, no process shows them.
    const bool lacking = any([&](const CellProgress& each) { return each.failed == asked; });
    if (lacking || order_.stage == order_.show) {
        if (!lacking)
            order_.stage = asked;
        ++order_.ask;
    }
    return order_;
}

void SharedCells::obey(const CellOrder& order) {
    // Keep these sets here: the extractor will soon hold only newer ones.
    if (order.show != order_.show)
        showing_ = staging_;
    if (order.stage != order_.stage)
        staging_ = found_;
    order_ = order;
}

const index::SurfacesQuery& SharedCells::ask(const index::SurfacesQuery& wanted) {
    if (progress_.asked < order_.ask && (!query_ || wanted != *query_)) {
        query_ = wanted;
        progress_.asked = order_.ask;
    }
    return *query_;
}

void SharedCells::look_at(const index::Extractor& extractor) {
    if (extractor.busy() || progress_.found == progress_.asked ||
        progress_.failed == progress_.asked)
        return;
    if (extractor.failure()) {
        progress_.failed = progress_.asked;
    } else {
        progress_.found = progress_.asked;
        found_ = extractor.newest();
    }
}

index::ExtractionPtr SharedCells::to_stage() const {
    return progress_.staged == order_.stage ? nullptr : staging_;
}

} // namespace isochron::app
