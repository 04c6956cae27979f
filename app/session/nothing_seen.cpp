// Watches whether the picture shows a surface.
#include "app/session/nothing_seen.h"

#include "app/config/first_placement.h"
#include "interaction/tools/clip_box.h"

#include <vector>

namespace isochron::app {
namespace {

std::vector<std::uint64_t> cells_of(const index::Extraction& cells) {
    std::vector<std::uint64_t> counts;
    for (const index::CellSet& surface : cells.surfaces)
        counts.push_back(cells.coarse() ? surface.points.size() : surface.ids.size());
    return counts;
}

} // namespace

/// Looks at the cells, unless it has done so.
void NothingSeen::know(const index::Extraction& cells, const index::Grid& grid,
                       const ExplorerState& state) {
    const std::uint32_t visible = interaction::visible(state.isosurfaces);
    auto cuts = interaction::cutting_planes(state, data_frame(arrays_.file()->info()));
    if (known_ && known_->extraction == cells.number && known_->visible == visible &&
        known_->cuts == cuts)
        return;
    const bool away = is_cut_away(cells, grid, visible, cuts);
    known_ = {cells.number, visible, std::move(cuts), corners_of(cells, grid, visible), away};
}

Sight NothingSeen::sight(const Frame& frame, const Seen& seen) const {
    if (!seen.in_window)
        return Sight::in_view;
    const auto views = outputs_.display().views_in_window(seen.audience.viewers);
    const index::Grid& grid = frame.file.info().grid;
    const auto at = [&](const BoxCorners& box) {
        return sight_of(box, frame.state.room_from_physical, views);
    };
    const Sight data = at(corners_of(grid));
    if (data != Sight::in_view)
        return data;
    return !known_->box || at(*known_->box) == Sight::in_view ? Sight::in_view
                                                              : Sight::surface_aside;
}

void NothingSeen::update(const Frame& frame, const Seen& seen) {
    const ExplorerState& state = frame.state;
    const bool alone = frame.sharing.alone(); // all processes of a cluster show the same panel
    const bool answered = seen.cells && frame.report.shown == frame.report.asked;
    const bool rests = frame.report.pace == interaction::Pace::settled && !state.playback.playing;
    surveyor_.update(arrays_.held(state), state.shown_instant().step,
                     alone && answered && rests && frame.is_live());
    // The panel in the room, whose widgets a hand presses, is the same in every replay.
    if (!frame.is_live() && state.room_panel.shown && alone && frame.report.cells == 0) {
        surveyor_.update(arrays_.held(state), state.shown_instant().step, true);
        surveyor_.finish();
    }
    why_.reset();
    if (!alone || !answered || state.playback.playing || state.slices.seen() ||
        !arrays_.further(state).empty())
        return;
    const index::IndexFile& array = arrays_.shown(state);
    PictureFacts facts{.settings = state,
                       .array = array.info().array,
                       .unit = array.info().value_unit,
                       .low = array.stats().low,
                       .high = array.stats().high,
                       .has_values = has_values(array.stats()),
                       .cells = cells_of(*seen.cells),
                       .pieces_hidden = seen.cells->pieces.all > 0 && seen.cells->pieces.kept == 0,
                       .step = surveyor_.survey(),
                       .cut_away = false,
                       .sight = Sight::in_view,
                       .other_array = {},
                       .to_other_array = {},
                       .all_in_view = seen.all_in_view};
    // What depends on the view is not said while the view changes.
    if (rests && !why_empty(facts)) {
        know(*seen.cells, frame.file.info().grid, state);
        facts.sight = sight(frame, seen);
        facts.cut_away = known_->cut_away;
    }
    why_ = why_empty(facts);
    if (!why_)
        return;
    if (const auto other = next_with_surfaces(*arrays_.file(), arrays_.number(state))) {
        facts.other_array = arrays_.names()[*other];
        facts.to_other_array = arrays_.way_to(*other, state);
        why_ = why_empty(facts);
    }
}

} // namespace isochron::app
