// The ghosts in numbers: how many surfaces of earlier and later steps are shown, and how.
#pragma once

#include "app/panel/panel_model.h"

namespace isochron::app {

inline constexpr const char* kGhostIcon = "O 5 16 2.6 O 11 13 4 D 18 9 5"; ///< as IconPath has it

/// On the line of a button before it: shows ghosts, or none. Nothing for data of one step.
void ghost_button(const PanelModel& model, interaction::Commands& commands);
/// Three rows while there are ghosts.
void ghost_rows(const PanelModel& model, interaction::Commands& commands);

} // namespace isochron::app
