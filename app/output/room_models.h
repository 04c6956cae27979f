// Models for the picture of an emulated room: heads with noses, wands, the floor.
#pragma once

#include "render/passes/line_pass.h"
#include "render/passes/solid_pass.h"

#include <vector>

namespace isochron::app {

/// A head in its own frame: origin between the eyes, -Z ahead, meters.
std::vector<render::Triangle> head_model(glm::vec3 color);

/// A wand in its own frame, pointing along -Z.
std::vector<render::Triangle> wand_model();

/// Lines every half meter on the floor, between two corners of a rectangle.
std::vector<render::Line> floor_grid(glm::vec2 low, glm::vec2 high);

} // namespace isochron::app
