// The packed formats of cells and mesh vertices on their way to a GPU.
#pragma once

#include <cstdint>

namespace isochron::index {

/// One cell in the GPU's format: 12 bytes, no padding.
struct CellPoint {
    std::uint16_t x, y, z; ///< cell coordinates; the center is at +0.5 in vertex index coordinates
    /// Bits 0 to 2: number of the surface, 0 to kMostSurfaces - 1; bits 3 to 15: its color
    /// coordinate, 0 to 8191 (cell_colors.h). Both 0 in a set of one query.
    std::uint16_t style;
    /// The plane of the surface in the cell: see `pack` in cell_plane.h. All zero if the gradient
    /// is zero or not finite.
    std::uint32_t plane;
};
static_assert(sizeof(CellPoint) == 12);

/// A row: the cells with the same y and z. Rows let a renderer order cells in linear time.
struct CellRow {
    std::uint16_t y, z;
    std::uint32_t begin; ///< into ids and points; ends where the next row begins
};

/// The point where the surface cuts an edge of the grid, in the GPU's format: 16 bytes, no padding.
struct MeshVertex {
    std::uint16_t x, y, z; ///< the lower end of the edge, vertex index coordinates
    std::uint16_t axis;    ///< axis of the edge, 0 to 2
    std::uint32_t share;   ///< fraction of the way to the edge's upper end, 0 to kWhole
    /// Normal towards lower values, in physical space, as coordinates on the octahedron (see
    /// cell_plane.h): signed 16 bits each from -32767 to 32767, x in the lower half. kNoNormal if
    /// the gradient is zero or not finite.
    std::uint32_t normal;

    static constexpr std::uint32_t kWhole = 1u << 31, kNoNormal = 0x80008000u;
    static constexpr int kOne = 32767; ///< the number for 1 in the normal's coordinates
    bool operator==(const MeshVertex&) const = default;
};
static_assert(sizeof(MeshVertex) == 16);

} // namespace isochron::index
