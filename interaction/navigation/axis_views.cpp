// Views of the data along their axes.
#include "interaction/navigation/axis_views.h"

#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>

#include <cmath>

namespace isochron::interaction {
namespace {

/// The view's axes as columns: to the right, up, towards the eye.
glm::dmat3 frame_of(const AxisView& view) {
    const glm::dvec3 back = glm::normalize(view.towards_eye);
    const glm::dvec3 right = glm::normalize(glm::cross(view.up, back));
    return {right, glm::cross(back, right), back};
}

glm::dquat rotation_to(const AxisView& view, const Pose& viewer) {
    const glm::dquat eye = glm::normalize(glm::dquat(viewer.orientation));
    return glm::normalize(eye * glm::conjugate(glm::quat_cast(frame_of(view))));
}

} // namespace

const std::array<AxisView, kAxisViews>& axis_views() {
    static const std::array<AxisView, kAxisViews> kViews{{{"+x", {1, 0, 0}, {0, 0, 1}},
                                                          {"-x", {-1, 0, 0}, {0, 0, 1}},
                                                          {"+y", {0, 1, 0}, {0, 0, 1}},
                                                          {"-y", {0, -1, 0}, {0, 0, 1}},
                                                          {"+z", {0, 0, 1}, {0, 1, 0}},
                                                          {"-z", {0, 0, -1}, {0, 1, 0}},
                                                          {"isometric", {1, -1, 1}, {0, 0, 1}}}};
    return kViews;
}

Similarity seen_from(const AxisView& view, const Similarity& from, const glm::dvec3& center,
                     const Pose& viewer) {
    const glm::dvec3 eye(viewer.position);
    const glm::dvec3 ahead = glm::normalize(glm::dquat(viewer.orientation)) * glm::dvec3(0, 0, -1);
    const double away = glm::length(transform(from, center) - eye);
    Similarity seen = from;
    seen.rotation = rotation_to(view, viewer);
    seen.translation = glm::dvec3(0.0);
    seen.translation = eye + away * ahead - transform(seen, center);
    return seen;
}

std::size_t axis_view_after(const Similarity& from, const Pose& viewer) {
    constexpr double kSame = 1e-6; ///< tolerance of the cosine of half the angle between rotations
    for (std::size_t i = 0; i < kIsometric; ++i) {
        const double cosine = glm::dot(rotation_to(axis_views()[i], viewer), from.rotation);
        if (std::abs(cosine) > 1 - kSame)
            return (i + 1) % kIsometric;
    }
    return 0;
}

} // namespace isochron::interaction
