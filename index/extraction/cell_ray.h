// Finds where a ray first hits the surfaces that are shown, from data in memory only.
//
//     if (const auto hit = index::first_hit(*shown, grid, {wand, ahead}))
//         mark(hit->at);
#pragma once

#include "index/extraction/extraction.h"
#include "index/extraction/instant_surfaces.h"

#include <glm/vec3.hpp>

#include <cstdint>
#include <optional>

namespace isochron::index {

/// In physical space. The direction may have any length, which is the unit of `RayHit::along`.
struct Ray {
    glm::dvec3 origin{0.0}, direction{0.0, 0.0, -1.0};
};

struct RayHit {
    std::size_t surface = 0; ///< place of its isovalue in the query
    double along = 0;        ///< 0 at the ray's origin
    glm::dvec3 at{0.0};      ///< physical space
};

/// The nearest point at which the ray passes through one of the surfaces, which are trilinear in
/// each active cell. Walks along the ray from cell to cell (J. Amanatides and A. Woo, "A Fast Voxel
/// Traversal Algorithm for Ray Tracing", Eurographics 1987), through at most nx + ny + nz cells.
/// That takes microseconds, so the render thread may call it. It reads the extraction only, no
/// file. In a set of mixed levels it finds the nearest plane of a cell instead, as planes are what
/// is drawn; it tests all cells, in some nanoseconds each.
/// @param grid of the extraction's series
/// @param surfaces bit i: surface i counts
/// @return nothing if the ray hits none, is not finite or has length 0
std::optional<RayHit> first_hit(const Extraction& shown, const Grid& grid, const Ray& ray,
                                std::uint32_t surfaces = ~std::uint32_t{0});

/// The nearest triangle that the ray passes through, from either side. Runs of triangles whose box it
/// misses are passed over, so that 100,000 triangles take some ten microseconds.
std::optional<RayHit> first_hit(const InstantSurfaces& shown, const Grid& grid, const Ray& ray,
                                std::uint32_t surfaces = ~std::uint32_t{0});

/// The point, in physical space, where the ray enters the grid, or its origin if that is inside.
/// Nothing if the ray misses the grid.
std::optional<glm::dvec3> entry_into(const Grid& grid, const Ray& ray);

} // namespace isochron::index
