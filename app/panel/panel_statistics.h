// The panel's lines about its own work: measurements, messages and errors.
#pragma once

#include "app/panel/panel_model.h"

#include <string>

namespace isochron::app {

/// How many cells there are, and how many are drawn where these are of other levels of detail.
std::string words_for_cells(const FrameReport& frame);
/// Figures of the shown cells, of reading and of the last frames.
void measurements(const PanelModel& model);
/// The newest message, which also lay over the picture when it came.
void newest_note(const PanelModel& model);
/// What fails at present.
void complaints(const PanelModel& model);

} // namespace isochron::app
