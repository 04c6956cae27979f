// What the panel tells of itself and of its work.
#pragma once

#include "app/panel/panel_model.h"

namespace isochron::app {

/// Of the shown cells, of reading and of the last frames.
void measurements(const PanelModel& model);
/// It stood in the picture when it came.
void newest_note(const PanelModel& model);
/// What failed, as long as it does.
void complaints(const PanelModel& model);

} // namespace isochron::app
