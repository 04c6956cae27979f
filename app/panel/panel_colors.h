// The panel's sections on surfaces and on what their colors mean.
#pragma once

#include "app/panel/panel_model.h"
#include "interaction/commands.h"

namespace isochron::app {

/// The list of isosurfaces: picks, colors, adds and removes them.
void surfaces_section(const PanelModel& model, interaction::Commands& commands);

/// What surfaces are colored by, the map and its range, and the box.
void coloring_section(const PanelModel& model, interaction::Commands& commands);

} // namespace isochron::app
