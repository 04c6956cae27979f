// What helps a viewer to stand in the room: a grid on the floor, the place that a teleport aims at.
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

/// Lines in the room frame: every meter of 10 m x 10 m of floor about the origin, and a ring with a
/// cross around the target.
std::vector<render::Line> lines_of(const Guides& guides);

} // namespace isochron::app
