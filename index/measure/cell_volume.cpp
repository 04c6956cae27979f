// Integrates the flow of (x, 0, 0) through the border of the part of a cell, which is its volume.
#include "index/measure/cell_volume.h"

#include "index/measure/vertex_sides.h"
#include "index/surface/mesh_cases.h"

#include <array>

namespace isochron::index {
namespace {

/// The area above on a unit square. @param bits of its corners above: bit 2 v + u
/// @param cuts share of the way along the edge at v = 0, at v = 1, at u = 0 and at u = 1
double area_above(unsigned bits, const std::array<double, 4>& cuts) {
    const auto [at_v0, at_v1, at_u0, at_u1] = cuts;
    switch (bits) {
    case 0: return 0;
    case 1: return at_v0 * at_u0 / 2;
    case 2: return (1 - at_v0) * at_u1 / 2;
    case 3: return (at_u0 + at_u1) / 2;
    case 4: return at_v1 * (1 - at_u0) / 2;
    case 5: return (at_v0 + at_v1) / 2;
    case 8: return (1 - at_v1) * (1 - at_u1) / 2;
    // Two corners across from each other are cut off separately, as in mesh_cases.
    case 6: return (1 - at_v0) * at_u1 / 2 + at_v1 * (1 - at_u0) / 2;
    case 9: return at_v0 * at_u0 / 2 + (1 - at_v1) * (1 - at_u1) / 2;
    default: break;
    }
    // The other ones are what the opposite corners leave; no two of these are across.
    return 1 - area_above(~bits & 15u, cuts);
}

} // namespace

double share_above(std::span<const MeshVertex> vertices, std::span<const std::uint32_t> corners,
                   std::uint8_t of_cell) {
    const MeshCase& known = mesh_cases()[of_cell];
    const auto cell = cell_of_mesh(vertices[corners[0]], of_cell);
    std::array<std::array<double, 3>, kCellEdges> places;
    std::array<double, kCellEdges> cuts{};
    for (std::size_t i = 0; i < corners.size(); ++i) {
        const MeshVertex& vertex = vertices[corners[i]];
        const std::size_t edge = known.edges[i];
        cuts[edge] = static_cast<double>(vertex.share) / MeshVertex::kWhole;
        places[edge] = {static_cast<double>(vertex.x - cell[0]),
                        static_cast<double>(vertex.y - cell[1]),
                        static_cast<double>(vertex.z - cell[2])};
        places[edge][vertex.axis] += cuts[edge];
    }
    const unsigned bits = (of_cell >> 1 & 1u) | (of_cell >> 3 & 1u) << 1 |
                          (of_cell >> 5 & 1u) << 2 | (of_cell >> 7 & 1u) << 3;
    // The face at x = 1, with y along u and z along v.
    double volume = area_above(bits, {cuts[5], cuts[7], cuts[9], cuts[11]});
    for (std::size_t i = 0; i < corners.size(); i += 3) {
        const auto& a = places[known.edges[i]];
        const auto& b = places[known.edges[i + 1]];
        const auto& c = places[known.edges[i + 2]];
        const double along_x = (b[1] - a[1]) * (c[2] - a[2]) - (b[2] - a[2]) * (c[1] - a[1]);
        volume += (a[0] + b[0] + c[0]) * along_x / 6;
    }
    return volume;
}

} // namespace isochron::index
