// The uniform block for drawing cells: see frame.glsl.
#pragma once

#include "render/cells/cell_appearance.h"
#include "render/cells/footprints.h"
#include "render/cells/placement.h"
#include "render/cells/surroundings.h"
#include "render/cells/traversal_order.h"
#include "render/gl/limits.h"
#include "render/gl/view.h"

#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <glm/vec4.hpp>

#include <array>
#include <cstdint>

namespace isochron::render {

/// `Eye` of frame.glsl, in std140 layout.
struct EyeBlock {
    glm::mat4 rows;
    glm::vec4 ray_right, ray_up, ray_ahead;
    glm::mat4 eye_from_index;
    glm::mat4 eye_from_physical;
    glm::vec4 eye_in_index;
    glm::vec4 clip_per_pixel;
    glm::vec4 viewport;
    glm::vec4 depth_cue;
    glm::vec4 key_light;
    glm::vec4 up;
    glm::vec4 between_eyes;
    std::array<glm::vec4, kMostCuts> cuts;
};
/// The uniform block `Frame` of frame.glsl, in std140 layout.
struct FrameBlock {
    std::array<EyeBlock, 2> eyes;
    std::array<glm::vec4, index::kMostSurfaces> surfaces;
    glm::vec4 no_value;
    glm::vec4 light;
    glm::vec4 material;
    glm::vec4 near_fade;
    glm::vec2 color_range;
    std::int32_t colored;
    std::int32_t linear_light;
    float radius;
    std::int32_t order_begin;
    std::int32_t order_step;
    std::int32_t blended;
    std::int32_t drawn_surfaces;
    std::int32_t soft_near_eye;
    float color_ratio;
    std::int32_t mixed_levels;
    std::int32_t color_bands;
    std::int32_t corners_by_slot;
    std::int32_t cut_count;
    std::int32_t padding;
    std::array<glm::vec4, 3> index_from_normal; ///< rows
    glm::vec4 surroundings;                     ///< see frame.glsl
    glm::vec4 surroundings_size;
    glm::vec4 extent;
};
static_assert(sizeof(FrameBlock) == 2 * (3 * 64 + 17 * 16) + (index::kMostSurfaces + 14) * 16);
static_assert(sizeof(FrameBlock) <= kUniformBlockBytes);

EyeBlock eye_block(const View& view, const Placement& placement, const CellAppearance& appearance);

/// The part of the block that is the same for every eye.
/// @param surfaces one bit for each drawn surface
/// @param mixed_levels the cells are of several levels of detail
FrameBlock frame_of(const CellAppearance& look, const FootprintShapes& shapes, Footprint footprint,
                    std::int32_t surfaces, bool blended, const Placement& placement,
                    const Surroundings& around, bool mixed_levels);

/// Key of the back-to-front order of this view.
TraversalKey key_of(const View& view, const Placement& placement);

/// Whether all cells are drawn opaque and whole, so that they hide those behind them.
bool hides_what_is_behind(const CellAppearance& look, const Placement& placement);

} // namespace isochron::render
