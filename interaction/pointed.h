// A place on a surface or slice that is shown, and how to find one.
#pragma once

#include "interaction/commands.h"

#include <cstddef>
#include <functional>
#include <optional>

namespace isochron::interaction {

struct Pointed {
    MarkedPoint point;
    std::size_t surface = 0; ///< number of the isosurface, from 0
    bool on_slice = false;   ///< on a slice, and on no isosurface
    bool operator==(const Pointed&) const = default;
};

/// Finds the first surface or slice that a ray meets. The ray starts at the pose and goes along its -Z.
using SurfaceFinder = std::function<std::optional<Pointed>(const Pose& ray)>;

} // namespace isochron::interaction
