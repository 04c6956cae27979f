// Finite differences and trilinear interpolation of a step's values.
#include "tests/render/cells/vertex_field.h"

#include "tests/support/test_field.h"

#include <glm/matrix.hpp>

#include <algorithm>

namespace isochron::render {

VertexField::VertexField(const index::StepValues& values, index::Query query)
    : values_(values), query_(query),
      cells_(values.grid.cells()[0], values.grid.cells()[1], values.grid.cells()[2]),
      physical_gradient_from_index_(
          glm::transpose(glm::inverse(glm::dmat3(values.grid.physical_from_index())))) {
    for (std::size_t vertex = 0; vertex < values.grid.vertex_count(); ++vertex)
        at_vertex_.push_back(index::scaled_value(values, query.instant.step, vertex) -
                             query.isovalue);
}

glm::dvec3 VertexField::gradient(glm::ivec3 vertex) const {
    glm::dvec3 slope;
    for (int axis = 0; axis < 3; ++axis) {
        glm::ivec3 below = vertex, above = vertex;
        below[axis] = std::max(vertex[axis] - 1, 0);
        above[axis] = std::min(vertex[axis] + 1, cells_[axis]);
        const double to_below = place(axis, vertex[axis]) - place(axis, below[axis]);
        const double to_above = place(axis, above[axis]) - place(axis, vertex[axis]);
        const double fall = to_below > 0 ? (value(vertex) - value(below)) / to_below : 0;
        const double rise = to_above > 0 ? (value(above) - value(vertex)) / to_above : 0;
        // The slope of the parabola through the three; at the border there are two.
        slope[axis] = to_below > 0 && to_above > 0
                          ? (to_above * fall + to_below * rise) / (to_below + to_above)
                          : fall + rise;
    }
    return -(physical_gradient_from_index_ * slope);
}

namespace {

template <class Function>
auto trilinear(glm::dvec3 local, const Function& at_corner) {
    decltype(at_corner(0)) sum{};
    for (int corner = 0; corner < 8; ++corner) {
        const glm::dvec3 on(corner_of_cell(corner));
        const glm::dvec3 share = on * local + (1.0 - on) * (1.0 - local);
        sum += share.x * share.y * share.z * at_corner(corner);
    }
    return sum;
}

} // namespace

double VertexField::value(glm::ivec3 cell, glm::dvec3 local) const {
    return trilinear(local, [&](int corner) { return value(cell + corner_of_cell(corner)); });
}

glm::dvec3 VertexField::gradient(glm::ivec3 cell, glm::dvec3 local) const {
    return trilinear(local, [&](int corner) { return gradient(cell + corner_of_cell(corner)); });
}

} // namespace isochron::render
