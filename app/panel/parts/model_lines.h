// The models in the panel: a line for each file of triangles.
#pragma once

#include "app/panel/panel_model.h"
#include "interaction/commands.h"

namespace isochron::app {

/// A row that opens further ones, where the window can open files, and a line for each model.
void model_lines(const PanelModel& model, PanelPages& pages, interaction::Commands& commands);

} // namespace isochron::app
