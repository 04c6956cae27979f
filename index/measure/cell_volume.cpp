// Integrates a flow through the border of the part of a cell, which is the part's volume.
#include "index/measure/cell_volume.h"

#include "index/measure/vertex_sides.h"
#include "index/surface/mesh_cases.h"

#include <array>
#include <cmath>
#include <vector>

namespace isochron::index {
namespace {

using Place = std::array<double, 3>;

/// The cut edges of a cell whose sides are 1 long.
struct CutEdges {
    std::array<double, kCellEdges> shares{}; ///< parts of the way along the edge
    std::array<Place, kCellEdges> places{};

    CutEdges() = default;
    CutEdges(std::span<const MeshVertex> vertices, std::span<const std::uint32_t> corners,
             std::uint8_t of_cell) {
        const MeshCase& known = mesh_cases()[of_cell];
        const auto cell = cell_of_mesh(vertices[corners[0]], of_cell);
        for (std::size_t i = 0; i < corners.size(); ++i) {
            const MeshVertex& vertex = vertices[corners[i]];
            const std::size_t edge = known.edges[i];
            shares[edge] = static_cast<double>(vertex.share) / MeshVertex::kWhole;
            places[edge] = {static_cast<double>(vertex.x - cell[0]),
                            static_cast<double>(vertex.y - cell[1]),
                            static_cast<double>(vertex.z - cell[2])};
            places[edge][vertex.axis] += shares[edge];
        }
    }
};

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

/// The parts of a face that are above, counter-clockwise as seen from higher places along its axis.
/// @param axis that it lies across @param at 0 or 1 along it
std::vector<std::vector<Place>> parts_of_face(std::uint8_t of_cell, const CutEdges& cuts,
                                              std::size_t axis, unsigned at) {
    // u and v follow the axis in turn, so that u, v and the axis are right-handed.
    const std::size_t u = (axis + 1) % 3, v = (axis + 2) % 3;
    const auto offsets = [&](unsigned in_u, unsigned in_v) {
        std::array<unsigned, 3> at_corner{};
        at_corner[axis] = at;
        at_corner[u] = in_u;
        at_corner[v] = in_v;
        return at_corner;
    };
    const auto edge = [](std::size_t along, const std::array<unsigned, 3>& from) {
        return 4 * along + from[along == 0 ? 1 : 0] + 2 * from[along == 2 ? 1 : 2];
    };
    struct Side {
        std::array<unsigned, 3> corner; ///< at which it begins
        std::size_t edge;
    };
    const std::array<Side, 4> around{{{offsets(0, 0), edge(u, offsets(0, 0))},
                                      {offsets(1, 0), edge(v, offsets(1, 0))},
                                      {offsets(1, 1), edge(u, offsets(0, 1))},
                                      {offsets(0, 1), edge(v, offsets(0, 0))}}};
    const auto above = [&](const Side& side) {
        return (of_cell >> (side.corner[0] + 2 * side.corner[1] + 4 * side.corner[2]) & 1) != 0;
    };
    const auto place = [](const Side& side) {
        return Place{static_cast<double>(side.corner[0]), static_cast<double>(side.corner[1]),
                     static_cast<double>(side.corner[2])};
    };
    // Two corners across from each other are cut off separately, as in mesh_cases.
    if (above(around[0]) == above(around[2]) && above(around[1]) == above(around[3]) &&
        above(around[0]) != above(around[1])) {
        const std::size_t first = above(around[0]) ? 0 : 1;
        std::vector<std::vector<Place>> both;
        for (const std::size_t k : {first, first + 2})
            both.push_back({cuts.places[around[(k + 3) % 4].edge], place(around[k]),
                            cuts.places[around[k].edge]});
        return both;
    }
    std::vector<Place> one;
    for (std::size_t k = 0; k < 4; ++k) {
        if (above(around[k]))
            one.push_back(place(around[k]));
        if (above(around[k]) != above(around[(k + 1) % 4]))
            one.push_back(cuts.places[around[k].edge]);
    }
    return {one};
}

} // namespace

double share_above(std::span<const MeshVertex> vertices, std::span<const std::uint32_t> corners,
                   std::uint8_t of_cell) {
    const MeshCase& known = mesh_cases()[of_cell];
    const CutEdges cuts(vertices, corners, of_cell);
    const unsigned bits = (of_cell >> 1 & 1u) | (of_cell >> 3 & 1u) << 1 |
                          (of_cell >> 5 & 1u) << 2 | (of_cell >> 7 & 1u) << 3;
    // The face at x = 1, with y along u and z along v.
    double volume =
        area_above(bits, {cuts.shares[5], cuts.shares[7], cuts.shares[9], cuts.shares[11]});
    for (std::size_t i = 0; i < corners.size(); i += 3) {
        const Place &a = cuts.places[known.edges[i]], &b = cuts.places[known.edges[i + 1]],
                    &c = cuts.places[known.edges[i + 2]];
        const double along_x = (b[1] - a[1]) * (c[2] - a[2]) - (b[2] - a[2]) * (c[1] - a[1]);
        volume += (a[0] + b[0] + c[0]) * along_x / 6;
    }
    return volume;
}

double share_above(std::span<const MeshVertex> vertices, std::span<const std::uint32_t> corners,
                   std::uint8_t of_cell, const CellCut& plane) {
    const MeshCase& known = mesh_cases()[of_cell];
    const CutEdges cuts = corners.empty() ? CutEdges() : CutEdges(vertices, corners, of_cell);
    std::size_t axis = 0; // the one that the plane lies most across
    for (const std::size_t other : {1u, 2u})
        if (std::abs(plane.along[other]) > std::abs(plane.along[axis]))
            axis = other;
    double volume = 0;
    for (const unsigned at : {0u, 1u})
        for (const std::vector<Place>& part : parts_of_face(of_cell, cuts, axis, at))
            volume += (at == 0 ? -1 : 1) * flow_through(part, plane, axis);
    for (std::size_t i = 0; i < corners.size(); i += 3) {
        const std::array<Place, 3> triangle{cuts.places[known.edges[i]],
                                            cuts.places[known.edges[i + 1]],
                                            cuts.places[known.edges[i + 2]]};
        volume += flow_through(triangle, plane, axis);
    }
    return volume;
}

} // namespace isochron::index
