// Geometry of the regular grid.
#include "index/volume/grid.h"

namespace isochron::index {

glm::dmat4 Grid::physical_from_index() const {
    glm::dmat4 m(1.0);
    for (int axis = 0; axis < 3; ++axis)
        m[axis] = glm::dvec4(direction[axis] * spacing[axis], 0.0);
    m[3] = glm::dvec4(origin, 1.0);
    return m;
}

} // namespace isochron::index
