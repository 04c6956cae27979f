// Geometry of the regular grid, and of the rectilinear one.
#include "index/volume/grid.h"

#include <glm/matrix.hpp>

#include <algorithm>

namespace isochron::index {

glm::dmat4 Grid::physical_from_index() const {
    glm::dmat4 m(1.0);
    for (int axis = 0; axis < 3; ++axis)
        m[axis] = glm::dvec4(direction[axis] * spacing[axis], 0.0);
    m[3] = glm::dvec4(origin, 1.0);
    return m;
}

glm::dmat4 Grid::physical_from_index_in(const std::array<std::uint32_t, 3>& cell) const {
    glm::dmat4 m = physical_from_index();
    for (int axis = 0; axis < 3; ++axis) {
        const auto a = static_cast<std::size_t>(axis);
        const std::vector<double>& at = positions[a].distances();
        if (at.empty())
            continue;
        const std::uint32_t i = cell[a];
        const double step = at[i + 1] - at[i];
        m[axis] = glm::dvec4(direction[axis] * step, 0.0);
        m[3] += glm::dvec4(direction[axis] * (at[i] - step * i), 0.0);
    }
    return m;
}

double Grid::distance(int axis, double index) const {
    const std::vector<double>& at = positions[static_cast<std::size_t>(axis)].distances();
    if (at.empty())
        return spacing[axis] * index;
    const double last = static_cast<double>(at.size() - 2);
    const auto i = static_cast<std::size_t>(std::clamp(index, 0.0, last));
    return at[i] + (index - static_cast<double>(i)) * (at[i + 1] - at[i]);
}

double Grid::index_at(int axis, double distance) const {
    const std::vector<double>& at = positions[static_cast<std::size_t>(axis)].distances();
    if (at.empty())
        return distance / spacing[axis];
    const auto above = std::upper_bound(at.begin() + 1, at.end() - 1, distance);
    const auto i = static_cast<std::size_t>(above - at.begin()) - 1;
    return static_cast<double>(i) + (distance - at[i]) / (at[i + 1] - at[i]);
}

glm::dvec3 Grid::physical(const glm::dvec3& index) const {
    glm::dvec3 at = origin;
    for (int axis = 0; axis < 3; ++axis)
        at += direction[axis] * distance(axis, index[axis]);
    return at;
}

glm::dvec3 Grid::index_of(const glm::dvec3& physical) const {
    const glm::dvec3 distances = glm::inverse(direction) * (physical - origin);
    return {index_at(0, distances.x), index_at(1, distances.y), index_at(2, distances.z)};
}

} // namespace isochron::index
