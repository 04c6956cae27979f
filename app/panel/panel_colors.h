// The panel's sections on surfaces and on what their colours mean.
#pragma once

#include "app/panel/panel_model.h"
#include "interaction/commands.h"

namespace isochron::app {

/// The list of isosurfaces: picks, colours, adds and removes them.
void surfaces_section(const PanelModel& model, interaction::Commands& commands);

/// What surfaces are coloured by, the map and its range, and the box.
void colouring_section(const PanelModel& model, interaction::Commands& commands);

} // namespace isochron::app
