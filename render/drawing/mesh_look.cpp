// Finds how large triangles are in a picture: by the size of their voxels.
#include "render/drawing/mesh_look.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include <algorithm>

namespace isochron::render {
namespace {

struct VoxelInView {
    float pixels; ///< along it
    float angle;  ///< its length as a part of its distance
};

/// The largest voxel that can be in a view.
VoxelInView largest_voxel(const View& view, const Placement& placement, const AxisTable& axes) {
    const glm::vec3 spacing = placement.spacing() * axes.largest();
    const float voxel = std::max({spacing.x, spacing.y, spacing.z});
    const glm::vec2 scale = 0.5f * glm::vec2(view.size) *
                            glm::vec2(glm::length(glm::vec3(view.clip_from_eye[0])),
                                      glm::length(glm::vec3(view.clip_from_eye[1])));
    const float at_one_meter = voxel * std::max(scale.x, scale.y);
    if (view.is_parallel())
        return {at_one_meter, 0.0f};
    const glm::vec3 eye(glm::inverse(placement.room_from_index) *
                        glm::vec4(view.eye_in_room(), 1.0f));
    const glm::vec3 beside = eye - glm::clamp(eye, glm::vec3(0.0f), placement.extent);
    const float distance = glm::length(glm::mat3(placement.room_from_index) * beside);
    return {at_one_meter / distance, voxel / distance}; // infinite from within
}

} // namespace

MeshLook mesh_look(const View& view, const Placement& placement, const AxisTable& axes,
                   const CellAppearance& appearance) {
    CellAppearance opaque = appearance;
    for (SurfaceAppearance& surface : opaque.surfaces)
        surface.opacity = 1.0f;
    const VoxelInView largest = largest_voxel(view, placement, axes);
    constexpr float kFewPixels = 8.0f; // so that light within a triangle is seen to be straight
    // Highlights are off by at most 2 % if the directions from a triangle to the eye are
    // interpolated between the directions at its vertices.
    constexpr float kEven = 0.05f, kLeastShininess = 4.0f; // see mesh.frag
    const bool even = largest.angle * largest.angle * appearance.shininess <= kEven &&
                      appearance.shininess >= kLeastShininess;
    const bool small = largest.pixels <= kFewPixels;
    MeshLook look;
    look.level = appearance.mesh_level;
    look.colored = appearance.values.has_value();
    look.near = !hides_what_is_behind(opaque, placement) || (!small && !even);
    look.small = small;
    return look;
}

} // namespace isochron::render
