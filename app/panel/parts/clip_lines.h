// The clip plane in numbers: where it lies along its normal, and the normal itself.
#pragma once

#include "app/panel/panel_model.h"
#include "interaction/commands.h"

namespace isochron::app {

/// Lines in the current window: buttons for planes across the axes, and the numbers of the plane
/// and of the box that are shown.
/// @param width of the longest line, panel pixels
void clip_lines(const PanelModel& model, float width, interaction::Commands& commands);

} // namespace isochron::app
