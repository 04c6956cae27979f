// Applies the user's look to a picture: materials, background and labels that suit it.
#pragma once

#include "app/scene/axes.h"
#include "app/scene/overlay_colors.h"
#include "interaction/commands.h"
#include "render/cells/cell_appearance.h"
#include "render/passes/background_pass.h"

#include <array>
#include <optional>

namespace isochron::app {

/// The direction towards the key light in the room, of length 1, from `Look::light`; and back.
glm::vec3 light_way(const std::array<double, 2>& angles);
std::array<double, 2> light_angles(const glm::vec3& way);

/// Sets shine, light and ambient occlusion of surfaces. @param configured appearance as configured
void set_look(render::CellAppearance& appearance, const render::CellAppearance& configured,
              const interaction::Look& look);

/// Empty if the background is the one color of the configuration.
std::optional<render::BackgroundColors> background_of(const interaction::Look& look);

/// Gives ticks, numbers and titles the colors of words on their background.
void set_colors(Axes& axes, const OverlayColors& overlay);

} // namespace isochron::app
