// Lines that help viewers with their position in the room: a grid on the floor, and the target of a
// teleport.
#pragma once

#include "render/passes/line_pass.h"

#include <optional>
#include <vector>

namespace isochron::app {

struct Guides {
    bool floor = false;
    std::optional<glm::dvec3> target; ///< on the floor, room space
    bool operator==(const Guides&) const = default;
};

/// Lines in the room frame: a grid with a line every meter on 10 m x 10 m of floor around the
/// origin, and a ring with a cross at the target.
std::vector<render::Line> lines_of(const Guides& guides);

} // namespace isochron::app
