// Geometry of the regular grid, and of the rectilinear one.
#include "index/volume/grid.h"

#include <glm/matrix.hpp>

#include <algorithm>
#include <utility>

namespace isochron::index {

glm::dmat4 Grid::physical_from_index() const {
    glm::dmat4 m(1.0);
    for (int axis = 0; axis < 3; ++axis)
        m[axis] = glm::dvec4(direction[axis] * spacing[axis], 0.0);
    m[3] = glm::dvec4(origin, 1.0);
    return m;
}

double Grid::even_place(int axis, std::uint32_t vertex) const {
    const std::vector<double>& at = positions[static_cast<std::size_t>(axis)].distances();
    return at.empty() ? vertex : at[vertex] / spacing[axis];
}

glm::dvec3 Grid::even_size(const std::array<std::uint32_t, 3>& cell) const {
    glm::dvec3 size(1.0);
    for (std::size_t a = 0; a < 3; ++a)
        if (const std::vector<double>& at = positions[a].distances(); !at.empty())
            size[static_cast<int>(a)] =
                (at[cell[a] + 1] - at[cell[a]]) / spacing[static_cast<int>(a)];
    return size;
}

Grid Grid::planes(std::uint32_t first, std::uint32_t end) const {
    return part({0, 0, first}, {vertices[0], vertices[1], end});
}

Grid Grid::part(const std::array<std::uint32_t, 3>& first,
                const std::array<std::uint32_t, 3>& end) const {
    Grid part = *this;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        part.vertices[axis] = end[axis] - first[axis];
        const std::vector<double>& at = positions[axis].distances();
        if (at.empty() || part.vertices[axis] == vertices[axis])
            continue;
        std::vector<double> distances(at.begin() + first[axis], at.begin() + end[axis]);
        for (double& distance : distances)
            distance -= at[first[axis]];
        part.positions[axis] = AxisPositions(std::move(distances));
    }
    return part;
}

Grid::SlopeWeights Grid::slope_weights(int axis, std::uint32_t vertex) const {
    const double here = even_place(axis, vertex);
    const bool first = vertex == 0, last = vertex + 1 == vertices[static_cast<std::size_t>(axis)];
    const double before = first ? 0 : here - even_place(axis, vertex - 1);
    const double behind = last ? 0 : even_place(axis, vertex + 1) - here;
    if (first || last)
        return {last ? 1 / before : 0, first ? 1 / behind : 0};
    return {behind / (before * (before + behind)), before / (behind * (before + behind))};
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
    if (!rectilinear())
        return glm::dvec3(glm::inverse(physical_from_index()) * glm::dvec4(physical, 1.0));
    const glm::dvec3 distances = glm::inverse(direction) * (physical - origin);
    return {index_at(0, distances.x), index_at(1, distances.y), index_at(2, distances.z)};
}

} // namespace isochron::index
