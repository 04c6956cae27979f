// Off-axis views through screens, and checks of a screen's geometry.
//
//     const render::View view = view_of(screen, head, Eye::left, 0.063f, 0.05f, 50.0f, {960,
//     1080});
#pragma once

#include "interaction/pose.h"
#include "render/view.h"
#include "stereo/installation.h"
#include "stereo/stereo_mode.h"

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <string>
#include <vector>

namespace isochron::stereo {

/// An eye nearer to a screen's plane than this, or behind it, is drawn as if it stood this far in
/// front of it [m]: the projection stays finite while a head walks through a wall.
constexpr float kNearestEye = 0.01f;

/// Where an eye is in the room: half the separation along the head's right axis.
/// @param eye_separation [m], 0 puts both eyes at the head's position
glm::vec3 eye_position(const interaction::Pose& head, Eye eye, float eye_separation);

/// Generalised perspective projection (R. Kooima, "Generalized Perspective Projection", 2009): the
/// screen's corners fall on the corners of clip space, wherever the eye stands in front of it.
/// The view's axes are the screen's, so both eyes of a screen look in the same direction.
/// @param near_plane, far_plane distances along the screen's normal [m], 0 < near < far
/// @param pixels of the picture; its aspect is what `fit_aspect` screens take on
render::View view_of(const Screen& screen, const interaction::Pose& head, Eye eye,
                     float eye_separation, float near_plane, float far_plane, glm::ivec2 pixels);

/// Width and height [m].
glm::vec2 size_of(const Screen& screen);

/// What is wrong with the geometry, one line each; empty when nothing is.
/// @param viewer a point that is meant to see the screen, room frame; a screen carried by the head
/// is judged from the head instead
std::vector<std::string> problems(const Screen& screen, glm::vec3 viewer = {0.0f, 1.6f, 0.0f});

} // namespace isochron::stereo
