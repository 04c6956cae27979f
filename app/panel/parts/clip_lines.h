// The clip plane in numbers: where it lies along its normal, and the normal itself.
#pragma once

#include "app/panel/panel_model.h"
#include "interaction/commands.h"

namespace isochron::app {

/// Two lines in the current window: buttons for planes across the axes, and the numbers of the
/// plane that is shown.
void clip_lines(const PanelModel& model, interaction::Commands& commands);

} // namespace isochron::app
