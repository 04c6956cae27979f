// The slices in numbers and buttons: which planes there are, and where the picked one lies.
#pragma once

#include "app/panel/panel_model.h"
#include "interaction/commands.h"

namespace isochron::app {

/// Two lines in the current window, and one more while there are slices.
void slice_lines(const PanelModel& model, interaction::Commands& commands);

} // namespace isochron::app
