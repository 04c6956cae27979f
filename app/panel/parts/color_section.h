// The panel's section on color: what colors the surfaces, and the color map.
#pragma once

#include "app/panel/panel_model.h"
#include "interaction/commands.h"

namespace isochron::app {

void color_section(const PanelModel& model, interaction::Commands& commands);

} // namespace isochron::app
