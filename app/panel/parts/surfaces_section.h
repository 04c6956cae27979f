// The panel's section on surfaces: their values, colors and opacities.
#pragma once

#include "app/panel/panel_model.h"
#include "interaction/commands.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace isochron::app {

/// The histogram with a line for each surface, and a row for each: the user moves, colors, hides,
/// adds and removes them.
void surfaces_section(const PanelModel& model, PanelPages& pages, interaction::Commands& commands);

/// Lets a new surface be seen, and the surfaces inside it. Surfaces of lower isovalues lie around
/// surfaces of higher isovalues. So the surfaces around the new one become translucent, and the new
/// surface becomes translucent where it lies around others.
/// @param added its place among the surfaces
void let_see(std::vector<interaction::Isosurface>& surfaces, std::size_t added);

inline constexpr float kSeenThrough = 0.45f; ///< opacity of a surface that shows what is behind it

/// Commands that add a surface, which becomes the picked one. There is room for it.
interaction::Commands with_another(const PanelModel& model);
/// As `with_another`, of another array than the shown one, translucent. @param array its number
interaction::Commands with_surface_of(const PanelModel& model, std::size_t array);
/// Commands that remove one of several surfaces.
interaction::Commands without_surface(const PanelModel& model, std::uint32_t removed);

} // namespace isochron::app
