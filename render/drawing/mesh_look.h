// How triangles are drawn for the size that they have in a picture.
#pragma once

#include "render/cells/axis_table.h"
#include "render/cells/cell_appearance.h"
#include "render/cells/placement.h"
#include "render/gl/view.h"

#include <glm/vec4.hpp>

#include <cstddef>
#include <cstdint>
#include <span>

namespace isochron::render {

/// How triangles are drawn, apart from their order.
struct MeshLook {
    std::int32_t surfaces = 0;         ///< one bit for each drawn surface
    std::span<const glm::vec4> colors; ///< color of each surface, linear light
    std::size_t level = 0;             ///< which of the set's meshes is drawn: CellBuffers::mesh
    bool colored = false;              ///< by the vertices' coordinates
    bool near = false;  ///< so near that some may be cut away or fade, or large in the view
    bool small = false; ///< triangles are of few pixels: lit at their vertices
};

/// The look of the largest triangles that can be in a view. @param axes of the grid of the cells
MeshLook mesh_look(const View& view, const Placement& placement, const AxisTable& axes,
                   const CellAppearance& appearance);

} // namespace isochron::render
