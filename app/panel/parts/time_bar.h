// The bar of the time: buttons that play, and the track of all steps.
#pragma once

#include "app/panel/panel_model.h"
#include "interaction/commands.h"

namespace isochron::app {

/// Lays it out in the current window.
/// @param two_rows the buttons stand above the track
void time_bar(const PanelModel& model, bool two_rows, interaction::Commands& commands);

} // namespace isochron::app
