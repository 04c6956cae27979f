// A step's values, interpolated between vertices, for comparison with pictures of surfaces.
#pragma once

#include "index/volume/query.h"
#include "index/volume/step_values.h"

#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>

#include <vector>

namespace isochron::render {

/// Values and gradients of one step, in double and straight from their definitions.
class VertexField {
  public:
    VertexField(const index::StepValues& values, index::Query query);

    const index::StepValues& values() const { return values_; }
    index::Query query() const { return query_; }
    glm::ivec3 cells() const { return cells_; }

    /// Value less the isovalue.
    double value(glm::ivec3 vertex) const { return at_vertex_[index_of(vertex)]; }
    /// Where vertices of a plane lie along an axis, in even coordinates.
    double place(int axis, int vertex) const {
        return values_.grid.distance(axis, vertex) / values_.grid.spacing[axis];
    }
    /// Central differences, one-sided at the border, towards lower values, in physical space.
    glm::dvec3 gradient(glm::ivec3 vertex) const;

    /// Trilinear in the cell.
    /// @param local from 0 to 1 between the cell's vertices
    double value(glm::ivec3 cell, glm::dvec3 local) const;
    glm::dvec3 gradient(glm::ivec3 cell, glm::dvec3 local) const;

  private:
    std::size_t index_of(glm::ivec3 vertex) const {
        return (std::size_t(vertex.z) * (cells_.y + 1) + vertex.y) * (cells_.x + 1) + vertex.x;
    }
    index::StepValues values_;
    index::Query query_;
    glm::ivec3 cells_;
    glm::dmat3 physical_gradient_from_index_;
    std::vector<double> at_vertex_;
};

/// The `corner`th of a cell's vertices, x fastest.
inline glm::ivec3 corner_of_cell(int corner) {
    return {corner & 1, corner >> 1 & 1, corner >> 2};
}

} // namespace isochron::render
