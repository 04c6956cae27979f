// The track of all steps: the range that plays, bookmarks as flags, and steps at hand.
#pragma once

#include "app/panel/panel_model.h"
#include "interaction/commands.h"

#include <cstdint>
#include <string>

namespace isochron::app {

/// Height of the lane above the track, where flags and the ends of the range are, and of the track
/// itself, panel pixels.
inline constexpr float kLaneHeight = 12.0f, kTrackHeight = 16.0f;

/// Lays lane and track out across the rest of the current window, with times below them. A press on
/// the track shows a step; the ends of the range are dragged in the lane; a flag leads to its
/// bookmark; the right button opens a menu of what can be done with a step. Where steps are blended,
/// the track has a tick at each of them. It is open at gaps.
void time_track(const PanelModel& model, interaction::Commands& commands);

/// Commands that show a moment.
void show(index::Instant at, interaction::Commands& commands);
/// The number of the last step that the session knows.
std::uint32_t last_step(const PanelModel& model);
/// The time of a step, in words.
std::string time_of(const PanelModel& model, index::Instant at);
/// `between steps 12 and 13`, or, where the step before a gap is shown, `held: a gap between steps 12
/// and 13`; at any other step, and where steps are held, empty.
std::string held_text(const PanelModel& model);

/// `2: after steps 2, 7`: the steps behind which the series has gaps. Empty: it has none.
std::string gaps_words(const PanelModel& model);
/// Why there are gaps, and what is shown there.
std::string gaps_in_words(const PanelModel& model);

} // namespace isochron::app
