// The slices in numbers and buttons: which planes there are, and where the picked one lies.
#pragma once

#include "app/panel/panel_model.h"
#include "interaction/commands.h"

namespace isochron::app {

/// Shows the picked one of these slices flat: alone, from straight ahead, in parallel projection.
interaction::Commands flat_view(const PanelModel& model, interaction::Slices slices);

/// Two lines in the current window, and one more while there are slices; more where they have no
/// room. @param width of the room, screen pixels
void slice_lines(const PanelModel& model, float width, interaction::Commands& commands);

} // namespace isochron::app
