// The menu of a place in the picture, which the right button opens.
#pragma once

#include "app/frame/desktop_wish.h"
#include "app/panel/panel_model.h"
#include "interaction/commands.h"
#include "interaction/pointed.h"

#include <optional>

namespace isochron::app {

/// Opens the menu at the mouse.
void open_place_menu();
/// Lays it out, if it is open.
/// @param place on a surface; empty: there is no surface
/// @param wish with the words of the place, if the user wants to copy them
/// @return whether the user wants to see all of the data
bool place_menu(const PanelModel& model, const std::optional<interaction::Pointed>& place,
                interaction::Commands& commands, DesktopWish& wish);

} // namespace isochron::app
