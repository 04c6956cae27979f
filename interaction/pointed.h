// A place on one of the surfaces that are shown.
#pragma once

#include "interaction/commands.h"

#include <cstddef>
#include <functional>
#include <optional>

namespace isochron::interaction {

struct Pointed {
    MarkedPoint point;
    std::size_t surface = 0; ///< of the isosurfaces that are shown, from 0
    bool operator==(const Pointed&) const = default;
};

/// The first surface that a ray meets, which starts at the pose and goes along its -Z.
using SurfaceFinder = std::function<std::optional<Pointed>(const Pose& ray)>;

} // namespace isochron::interaction
