// The help page on the connected devices, and the four lines of introduction.
#pragma once

#include "app/panel/panel_model.h"
#include "app/panel/parts/places.h"

#include <span>

namespace isochron::app {

/// Lists the controls of some kinds of devices, with a heading for each kind.
void controls_of(std::span<const interaction::DeviceKind> kinds,
                 std::span<const interaction::ControlGroup> groups);

/// The help page, in the middle of the picture. @return false: the user closed it
bool help_window(const PanelModel& model);

/// The introduction for new users. It takes no input.
void first_use_window(const PanelBox& picture);

} // namespace isochron::app
