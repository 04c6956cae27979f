// The panel's section on all that stands in the picture.
#pragma once

#include "app/panel/panel_model.h"
#include "interaction/commands.h"

namespace isochron::app {

/// A line for each thing of the table (app/panel/item_table.h): an eye, a swatch of its color or its
/// kind's icon, its words, and a menu.
void objects_section(const PanelModel& model, interaction::Commands& commands);

} // namespace isochron::app
