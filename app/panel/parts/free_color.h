// Colors for new surfaces.
#pragma once

#include "interaction/setting_values.h"

#include <glm/vec3.hpp>

#include <vector>

namespace isochron::app {

/// A color that no surface has, as long as there is one: sRGB, 0 to 1.
glm::vec3 free_color(const std::vector<interaction::Isosurface>& surfaces);

} // namespace isochron::app
