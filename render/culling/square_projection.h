// Input and output of the projection of cells to the squares around their quads, as plain data for
// SIMD code.
#pragma once

#include <glm/mat3x3.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include <cstdint>

namespace isochron::render {

/// Where the cells of a set lie.
enum class CellKind : std::uint8_t {
    even,        ///< on a regular grid
    mixed,       ///< mixed levels of detail, on a regular grid
    uneven,      ///< on a rectilinear grid
    mixed_uneven ///< mixed levels of detail, on a rectilinear grid
};

/// The data that all cells share.
struct SquareProjection {
    glm::vec4 row_x, row_y, row_z, row_w; ///< from index to clip space, x and y in pixels
    glm::vec2 middle;                     ///< middle of the viewport, pixels
    float radius;
    glm::mat3 index_from_normal; ///< normals of planes from physical to index space
    glm::vec3 extent;            ///< extent of the volume in index space
    /// Places and sides of a rectilinear grid, as AxisPlaces has them; null for a regular one.
    const float *places[3], *sides[3];
    std::int32_t last[3]; ///< vertex along each axis
};

constexpr float kClipped =
    1.0f - 1e-6f;            ///< cells at a larger |z| may be clipped: they hide nothing
constexpr float kFar = 1e9f; ///< [pixel] beyond any view and before any depth

/// The arrays for the results.
struct SquareArrays {
    float *x, *y, *z, *inner, *outer, *inner_disc, *outer_disc;
    // Null unless planes are cut at their cells:
    float *low, *high;
    float* stripes[3][3];
};

} // namespace isochron::render
