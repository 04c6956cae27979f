// What a look comes to: light, materials and what is behind the data.
#pragma once

#include "app/scene/axes.h"
#include "interaction/commands.h"
#include "render/cells/cell_appearance.h"
#include "render/passes/background_pass.h"

#include <optional>

namespace isochron::app {

/// Sets how surfaces shine and what is dark on them. @param configured as the configuration lights
void set_look(render::CellAppearance& appearance, const render::CellAppearance& configured,
              const interaction::Look& look);

/// Nothing where the picture's own color, that of the configuration, is behind the data.
std::optional<render::BackgroundColors> background_of(const interaction::Look& look);

/// As they are read on a light background.
void darken(Axes& axes);

} // namespace isochron::app
