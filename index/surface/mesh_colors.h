// Color coordinates of a mesh's vertices.
#pragma once

#include "index/surface/cell_mesh.h"

#include <cstdint>
#include <span>
#include <vector>

namespace isochron::index {

/// Fine coordinates (cell_colors.h) of values.
std::vector<std::uint16_t> colors_of(std::span<const float> values, double low, double high);
/// Turns the mesh's values into fine coordinates, and drops the values. Between the ends of an edge
/// the values are interpolated, as anywhere on the surface.
void color_by_values(CellMesh& mesh, double low, double high);
/// Gives each vertex the color of the first cell that has it. @param colors of the cells
void color_by_cells(CellMesh& mesh, std::span<const std::uint16_t> colors);

} // namespace isochron::index
