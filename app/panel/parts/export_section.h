// The panel's menu for exports: what is exported as files, and how far an export is.
#pragma once

#include "app/panel/panel_model.h"
#include "interaction/commands.h"

namespace isochron::app {

/// A button that opens a menu: steps, format and folder, and a button that begins an export; while
/// one goes on, how far it is, and a button that cancels it.
void export_button(const PanelModel& model, interaction::Commands& commands);

} // namespace isochron::app
