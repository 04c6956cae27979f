// The corners of a grid.
#pragma once

#include "index/volume/grid.h"

#include <glm/vec3.hpp>

#include <array>

namespace isochron::index {

/// The eight corner vertices in physical space: x fastest, then y, then z.
inline std::array<glm::dvec3, 8> corners_of(const Grid& grid) {
    const auto [x, y, z] = grid.cells();
    std::array<glm::dvec3, 8> corners;
    for (unsigned corner = 0; corner < 8; ++corner)
        corners[corner] = grid.physical(glm::dvec3(corner & 1, corner >> 1 & 1, corner >> 2) *
                                        glm::dvec3(x, y, z));
    return corners;
}

} // namespace isochron::index
