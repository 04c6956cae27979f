// The clip plane in numbers: where it lies along its normal, and the normal itself.
#pragma once

#include "app/panel/panel_model.h"
#include "interaction/commands.h"

namespace isochron::app {

/// Two lines in the current window: buttons for planes across the axes, and the numbers of the
/// plane that is shown; more where they have no room. @param width of the room, screen pixels
void clip_lines(const PanelModel& model, float width, interaction::Commands& commands);

} // namespace isochron::app
