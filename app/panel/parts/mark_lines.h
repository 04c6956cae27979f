// The mark, and the list of marks that were kept.
#pragma once

#include "app/panel/panel_model.h"
#include "interaction/commands.h"

namespace isochron::app {

/// Whether there is a mark, or one was kept.
bool has_marks(const PanelModel& model);

/// A line in the current window: the mark, as much of it as there is room for, and what can be done
/// with it. @param width of the line, panel pixels
void mark_lines(const PanelModel& model, float width, interaction::Commands& commands);

} // namespace isochron::app
