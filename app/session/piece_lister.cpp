// Measures the pieces of the picked surface.
#include "app/session/piece_lister.h"

#include "app/end_in_time.h"
#include "index/error.h"
#include "index/measure/kept_pieces.h"
#include "index/measure/measures.h"

namespace isochron::app {
PieceLister::PieceLister()
    : listing_(list, [](const Wanted& wanted, const std::string& why, bool) {
          return Listed{wanted, nullptr, why};
      }) {}

PieceLister::Listed PieceLister::list(const Wanted& wanted, const Asking& asking) {
    index::SurfaceMeasures measures(wanted.array);
    index::MeasureWishes wishes{.pieces = true, .kept = wanted.kept};
    wishes.only = {0}; // which takes no time
    auto found = measures.measure(wanted.query, wishes, asking.stop);
    if (!found)
        throw index::Error("canceled");
    PieceList made = piece_list(std::move(found->pieces), wanted.order);
    made.surface = wanted.surface;
    made.query = wanted.query;
    return {wanted, std::make_shared<const PieceList>(std::move(made)), {}};
}

void PieceLister::take() {
    for (Listed& listed : listing_.take()) {
        lists_ = false;
        last_ = std::move(listed);
    }
}

void PieceLister::update(const Frame& frame, const ShownArrays& arrays) {
    take();
    const auto order = std::exchange(looked_at_, {});
    if (!order)
        return;
    const std::uint32_t surface = frame.state.picked;
    const index::Query query{frame.report.asked.instant, frame.state.isosurfaces[surface].isovalue};
    const Wanted wanted{arrays.held(frame.state, surface), query,
                        index::of_surface(filter_of(frame.state.pieces), surface), surface, *order};
    if (last_.wanted == wanted || lists_)
        return;
    lists_ = true;
    listing_.ask(wanted);
    if (!frame.is_live()) {
        const DrawsOnly waits;
        listing_.finish();
        take();
    }
}

PanelPieces PieceLister::in_panel(const FrameReport& report, const index::ExtractionPtr& shown) {
    PanelPieces pieces;
    pieces.come = !shown || shown->query.of_cells() != report.asked;
    if (shown)
        pieces.told = shown->pieces;
    pieces.list = last_.list;
    pieces.failure = last_.failure;
    pieces.want = [this](const PieceOrder& order) { looked_at_ = order; };
    return pieces;
}

} // namespace isochron::app
