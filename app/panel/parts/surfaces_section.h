// The panel's section on surfaces: their values, colors and opacities.
#pragma once

#include "app/panel/panel_model.h"
#include "interaction/commands.h"

#include <cstddef>
#include <vector>

namespace isochron::app {

/// The histogram with a line for each surface, and a row for each: the user moves, colors, hides,
/// adds and removes them.
void surfaces_section(const PanelModel& model, interaction::Commands& commands);

/// Lets a new surface be seen, and the surfaces inside it. Surfaces of lower isovalues lie around
/// surfaces of higher isovalues. So the surfaces around the new one become translucent, and the new
/// surface becomes translucent where it lies around others.
/// @param added its place among the surfaces
void let_see(std::vector<interaction::Isosurface>& surfaces, std::size_t added);

} // namespace isochron::app
