// The bar at the top: data, undo, tools, what is written, and help.
#pragma once

#include "app/panel/panel_model.h"
#include "interaction/commands.h"

namespace isochron::app {

/// Lays it out in the current window.
void top_bar(const PanelModel& model, PanelPages& pages, interaction::Commands& commands);

/// What can be done with the chosen tool, and with what tools have made: a line for each in the
/// current window. @param width that it may take, panel pixels
void tool_strip(const PanelModel& model, float width, interaction::Commands& commands);
/// Whether there is anything in it.
bool has_tool_strip(const PanelModel& model);

} // namespace isochron::app
