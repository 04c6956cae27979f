// The panel's sections on surfaces and on coloring.
#pragma once

#include "app/panel/panel_model.h"
#include "interaction/commands.h"

#include <cstddef>
#include <vector>

namespace isochron::app {

/// The choice of the array, if the index has several.
void array_section(const PanelModel& model, interaction::Commands& commands);

/// The list of isosurfaces: the user picks, colors, adds and removes them.
void surfaces_section(const PanelModel& model, interaction::Commands& commands);

/// Lets a new surface be seen, and the surfaces inside it. Surfaces of lower isovalues lie around
/// surfaces of higher isovalues. So the surfaces around the new one become translucent, and the new
/// surface becomes translucent where it lies around others.
/// @param added its place among the surfaces
void let_see(std::vector<interaction::Isosurface>& surfaces, std::size_t added);

/// The choice of what colors the surfaces, the color map and its range, and the box.
void coloring_section(const PanelModel& model, interaction::Commands& commands);

} // namespace isochron::app
