// Takes triangles from a mesh by joining the ends of edges, and keeps how its parts hang together.
#pragma once

#include "index/export/mesh_distance.h"

#include <functional>
#include <span>

namespace isochron::index {

/// Removes points one by one, each into a neighbor, those with the least quadric error first (M. Garland
/// and P. Heckbert 1997, doi:10.1145/258734.258849). Points that stay keep their places. None is removed
/// where an edge or a border would change what it connects (the link condition: T. Dey et al. 1999), a
/// triangle would turn over, or a point that was removed, or the middle of an edge, would lie farther from
/// the triangles that take its place than it may. So what is closed stays closed, an edge of two triangles
/// keeps two, also where points lie in one place, and no part of the mesh goes altogether. How far other
/// points of the triangles lie apart is not measured.
/// @param mesh no triangle has one point twice; points that no triangle uses stay
/// @param most distance for each point; a middle has the smaller one of both ends
/// @param look called now and then; may be empty
void collapse_edges(PlainMesh& mesh, std::span<const double> most,
                    const std::function<void()>& look = {});

} // namespace isochron::index
