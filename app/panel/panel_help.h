// What the devices at hand do, on a page of its own, and the first four lines that anybody needs.
#pragma once

#include "app/panel/panel_model.h"

#include <span>

namespace isochron::app {

/// The lines of some kinds of devices, a heading before each kind's.
void controls_of(std::span<const interaction::DeviceKind> kinds,
                 std::span<const interaction::ControlGroup> groups);

/// All of them at hand, in the middle of the picture. @return false: the user closed it
bool help_window(const PanelModel& model);

/// What somebody needs who sees the program for the first time. It takes no input.
/// @param left pixels of the picture that the panel covers
void first_use_window(float left);

} // namespace isochron::app
