// A cube in the picture's corner that shows how the data lie; a click on it turns them.
#pragma once

#include "app/panel/panel_model.h"
#include "app/panel/parts/places.h"
#include "interaction/commands.h"

namespace isochron::app {

/// Lays it out at the upper right of the picture. A face that is clicked looks at the viewer then;
/// the corner that is nearest to the viewer leads to the isometric view.
void view_cube(const PanelModel& model, const PanelBox& picture, interaction::Commands& commands);

} // namespace isochron::app
