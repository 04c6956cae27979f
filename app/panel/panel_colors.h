// The panel's sections on surfaces and on coloring.
#pragma once

#include "app/panel/panel_model.h"
#include "interaction/commands.h"

namespace isochron::app {

/// The list of isosurfaces: the user picks, colors, adds and removes them.
void surfaces_section(const PanelModel& model, interaction::Commands& commands);

/// The choice of what colors the surfaces, the color map and its range, and the box.
void coloring_section(const PanelModel& model, interaction::Commands& commands);

} // namespace isochron::app
