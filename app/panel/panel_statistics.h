// The panel's lines about its own work: measurements, messages and errors.
#pragma once

#include "app/panel/panel_model.h"

#include <string>

namespace isochron::app {

/// The number of active cells, and of those drawn instead if these are of coarser levels.
std::string words_for_cells(const FrameReport& frame);
/// Figures of the shown cells, of reading and of the last frames.
void measurements(const PanelModel& model);
/// What fails at present.
void complaints(const PanelModel& model);

} // namespace isochron::app
