// The help page on the connected devices.
#pragma once

#include "app/panel/panel_model.h"

#include <span>

namespace isochron::app {

/// Lists the controls of some kinds of devices, with a heading for each kind.
void controls_of(std::span<const interaction::DeviceKind> kinds,
                 std::span<const interaction::ControlGroup> groups);

struct HelpAnswer {
    bool stays = true; ///< the user has not closed it
    bool tour = false; ///< the user wants the tour
};
/// The help page, in the middle of the picture.
HelpAnswer help_window(const PanelModel& model);

} // namespace isochron::app
