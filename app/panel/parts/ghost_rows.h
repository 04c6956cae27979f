// The ghosts in numbers: how many surfaces of earlier and later steps are shown, and how.
#pragma once

#include "app/panel/panel_model.h"

namespace isochron::app {

/// One row, and two more while ghosts are shown; none for data of one step.
void ghost_rows(const PanelModel& model, interaction::Commands& commands);

} // namespace isochron::app
