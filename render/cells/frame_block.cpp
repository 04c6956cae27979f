// The uniform block for drawing cells.
#include "render/cells/frame_block.h"

#include "render/cells/splat_opacity.h"
#include "render/gl/srgb.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include <algorithm>
#include <cmath>

namespace isochron::render {
namespace {

/// The depth cue runs from the near to the far end of the volume's bounding sphere.
glm::vec4 depth_cue(const glm::mat4& eye_from_index, const glm::vec3& extent, float strength) {
    const glm::vec3 center(eye_from_index * glm::vec4(0.5f * extent, 1.0f));
    float radius = 0.0f;
    for (int corner = 0; corner < 8; ++corner) {
        const glm::vec3 unit(corner & 1, corner >> 1 & 1, corner >> 2);
        const glm::vec3 at(eye_from_index * glm::vec4(extent * unit, 1.0f));
        radius = std::max(radius, glm::length(at - center));
    }
    const float near = std::max(glm::length(center) - radius, 0.0f);
    const float far = glm::length(center) + radius;
    return {near, 1.0f / std::max(far - near, 1e-6f), strength, 0.0f};
}

/// The eye's position (w = 1), or in a parallel view the direction towards the eye (w = 0).
glm::vec4 eye_in_index(const View& view, const Placement& placement) {
    return glm::inverse(view.eye_from_room * placement.room_from_index) *
           (view.is_parallel() ? glm::vec4(0, 0, 1, 0) : glm::vec4(0, 0, 0, 1));
}

/// @param spacing of the voxels in the room [m]
glm::vec4 near_fade_of(const NearFade& fade, const glm::vec3& spacing) {
    constexpr float kGrain = 0.0012f; // [m], a third of a degree at 0.2 m
    const float voxel = std::cbrt(spacing.x * spacing.y * spacing.z);
    return {fade.gone, 1.0f / std::max(fade.whole - fade.gone, 1e-4f),
            std::clamp(voxel / kGrain, 1.0f, 1024.0f), 0.0f};
}

} // namespace

TraversalKey key_of(const View& view, const Placement& placement) {
    glm::vec4 eye = eye_in_index(view, placement);
    if (eye.w != 0.0f)
        eye = glm::vec4(placement.index_at(glm::vec3(eye)), eye.w);
    return traversal_key(eye, glm::ivec3(glm::round(placement.extent)), placement.spacing());
}

EyeBlock eye_block(const View& view, const Placement& placement, const CellAppearance& appearance) {
    const glm::mat3 eye_from_room(view.eye_from_room);
    const glm::mat4 eye_from_index = view.eye_from_room * placement.room_from_index;
    const bool parallel = view.is_parallel();
    const glm::vec2 half_size = 0.5f * glm::vec2(view.size);
    glm::mat4 pixel_from_clip(1.0f);
    pixel_from_clip[0][0] = half_size.x;
    pixel_from_clip[1][1] = half_size.y;
    const glm::mat4 pixel_from_index = pixel_from_clip * view.clip_from_eye * eye_from_index;
    const glm::dmat4 index_from_pixel = glm::inverse(glm::dmat4(pixel_from_index));
    // The ray of pixel (x, y) is all points (x w, y w, z, w), where z is linear in w.
    const glm::dmat4 clip(view.clip_from_eye);
    const double ahead_z = parallel ? 1.0 : clip[2][2] / clip[2][3];
    const glm::dvec4 ahead = index_from_pixel * glm::dvec4(0, 0, ahead_z, parallel ? 0.0 : 1.0);
    std::array<glm::vec4, kMostCuts> cuts{};
    for (std::size_t i = 0; i < appearance.cuts.size(); ++i)
        cuts[i] = appearance.cuts[i] * glm::inverse(view.eye_from_room);
    return {
        .rows = glm::transpose(pixel_from_index),
        .ray_right = glm::vec4(index_from_pixel[0]),
        .ray_up = glm::vec4(index_from_pixel[1]),
        .ray_ahead = glm::vec4(glm::dvec4(glm::dvec3(ahead), ahead_z)),
        .eye_from_index = eye_from_index,
        .eye_from_physical =
            glm::mat4(glm::mat3(view.eye_from_room) * placement.room_from_normal()),
        .eye_in_index = eye_in_index(view, placement),
        .clip_per_pixel = glm::vec4(1.0f / half_size, 0.0f, 0.0f),
        .viewport = glm::vec4(view.corner, view.size),
        .depth_cue = depth_cue(eye_from_index, placement.extent, appearance.depth_cue),
        .key_light = glm::vec4(glm::normalize(eye_from_room * appearance.key_direction), 0.0f),
        .up = glm::vec4(eye_from_room * glm::vec3(0, 1, 0), 0.0f),
        .between_eyes =
            appearance.near_fade
                ? view.eye_from_room * glm::vec4(appearance.near_fade->between_eyes, 1.0f)
                : glm::vec4(0.0f),
        .cuts = cuts,
    };
}

bool hides_what_is_behind(const CellAppearance& look, const Placement& placement) {
    if (!look.cuts.empty() || std::ranges::any_of(look.surfaces, is_translucent))
        return false;
    if (!look.near_fade)
        return true;
    const glm::vec3 eyes(glm::inverse(placement.room_from_index) *
                         glm::vec4(look.near_fade->between_eyes, 1.0f));
    const glm::vec3 beside = eyes - glm::clamp(eyes, glm::vec3(0.0f), placement.extent);
    return glm::length(glm::mat3(placement.room_from_index) * beside) > look.near_fade->whole;
}

FrameBlock frame_of(const CellAppearance& look, const FootprintShapes& shapes, Footprint footprint,
                    std::int32_t surfaces, bool blended, const Placement& placement,
                    const Surroundings& around, bool mixed_levels) {
    const bool gaussian = footprint == Footprint::gaussian;
    FrameBlock frame{
        .eyes = {},
        .surfaces = {},
        .no_value = {},
        .light = {look.ambient, look.head_light, look.key_light, 0.0f},
        .material = {look.reflectance, look.shininess, look.ground, look.outline},
        .near_fade = {-1.0f, 1.0f, 0.0f, 0.0f}, // no fading at any distance
        .color_range = {},
        .colored = look.values.has_value(),
        .linear_light = blended && look.linear_light,
        .radius = shapes.radius_of(footprint),
        .order_begin = 0,
        .order_step = 0,
        .blended = blended,
        .drawn_surfaces = surfaces,
        .soft_near_eye = gaussian,
        .color_ratio = look.values ? look.values->ratio : 0.0f,
        .mixed_levels = mixed_levels,
        .color_bands = look.values && look.values->bands,
        .corners_by_slot = true,
        .cut_count = static_cast<std::int32_t>(look.cuts.size()),
        .padding = {},
        .index_from_normal = {},
        .surroundings = glm::vec4(glm::vec3(around.per_voxel()),
                                  around.size() == glm::ivec3(0) ? 0.0f : look.occlusion),
        .surroundings_size = glm::vec4(glm::max(around.size(), 1), 0),
        .extent = glm::vec4(placement.extent, 0.0f),
    };
    const glm::mat3 rows = glm::transpose(placement.index_from_normal());
    for (int i = 0; i < 3; ++i)
        frame.index_from_normal[static_cast<std::size_t>(i)] = glm::vec4(rows[i], 0.0f);
    for (std::size_t i = 0; i < index::kMostSurfaces; ++i) {
        const auto& [color, opacity] = look.surfaces[i];
        frame.surfaces[i] = glm::vec4(linear_from_srgb(color),
                                      gaussian ? splat_opacity(opacity, shapes.sigma()) : opacity);
    }
    if (look.values) {
        const float width = std::max(look.values->high - look.values->low, 1e-6f);
        frame.no_value = glm::vec4(linear_from_srgb(look.values->no_value), 1.0f);
        frame.color_range = {1.0f / width, -look.values->low / width};
    }
    if (look.near_fade)
        frame.near_fade = near_fade_of(*look.near_fade, placement.spacing());
    return frame;
}

} // namespace isochron::render
