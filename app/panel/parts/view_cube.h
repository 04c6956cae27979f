// A cube in the picture's corner that shows how the data lie; a click on it turns them.
#pragma once

#include "app/panel/panel_model.h"
#include "app/panel/parts/panel_layout.h"
#include "interaction/commands.h"

#include <imgui.h>

namespace isochron::app {

/// Lays it out at the upper right of the picture. A face that is clicked looks at the viewer then;
/// the corner that is nearest to the viewer leads to the isometric view.
/// @return the left end of the cube; of a picture without room for it the right end
float view_cube(const PanelModel& model, const PanelBox& picture, interaction::Commands& commands);

/// A small picture of how the data lie at a viewpoint: a cube whose faces across x, y and z are red,
/// green and blue. @param half_edge of the cube, panel pixels
void small_cube(const PanelModel& model, const interaction::Similarity& placed,
                const ImVec2& middle, float half_edge);

} // namespace isochron::app
