// Where a ray first meets the surfaces that are shown, from what is in memory already.
//
//     if (const auto hit = index::first_hit(*shown, grid, {wand, ahead}))
//         mark(hit->at);
#pragma once

#include "index/extraction/extraction.h"

#include <glm/vec3.hpp>

#include <cstdint>
#include <optional>

namespace isochron::index {

/// In physical space; of any length, which is the unit of `RayHit::along`.
struct Ray {
    glm::dvec3 origin{0.0}, direction{0.0, 0.0, -1.0};
};

struct RayHit {
    std::size_t surface = 0; ///< place of its isovalue in the query
    double along = 0;        ///< 0 at the ray's origin
    glm::dvec3 at{0.0};      ///< physical space
};

/// The nearest place at which the ray passes through one of the surfaces, which are trilinear in
/// each active cell. Walks along the ray from cell to cell (J. Amanatides and A. Woo, "A Fast Voxel
/// Traversal Algorithm for Ray Tracing", Eurographics 1987), through at most as many as the grid
/// has along its three axes together: microseconds, so that it may be asked by the thread that
/// draws. It reads the extraction alone, no file.
/// @param grid of the extraction's series
/// @param surfaces bit i: surface i counts
/// @return nothing where there is none, or the ray is not finite or of no length
std::optional<RayHit> first_hit(const Extraction& shown, const Grid& grid, const Ray& ray,
                                std::uint32_t surfaces = ~std::uint32_t{0});

/// Where the ray enters the grid, or starts in it; physical space. Nothing where it passes by.
std::optional<glm::dvec3> entry_into(const Grid& grid, const Ray& ray);

} // namespace isochron::index
