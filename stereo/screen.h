// Off-axis views through screens, and checks of a screen's geometry.
//
//     const render::View view =
//         view_of(screen, head, Eye::left, 0.063f, 0.05f, 50.0f, {960, 1080});
#pragma once

#include "interaction/pose.h"
#include "render/gl/view.h"
#include "stereo/installation.h"
#include "stereo/stereo_mode.h"

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <array>
#include <string>
#include <vector>

namespace isochron::stereo {

/// An eye nearer to a screen's plane than this, or behind it, is drawn as if it stood this far in
/// front of it [m]: the projection stays finite while a head walks through a wall.
constexpr float kNearestEye = 0.01f;

/// A corner may differ from 90 degrees by this [degrees].
constexpr double kSquareCorner = 1.0;

/// Where an eye is in the room: half the separation along the head's right axis.
/// @param eye_separation [m], 0 puts both eyes at the head's position
glm::vec3 eye_position(const interaction::Pose& head, Eye eye, float eye_separation);

/// Generalized perspective projection (R. Kooima, "Generalized Perspective Projection", 2009): the
/// screen's corners fall on the corners of clip space, wherever the eye stands in front of it.
/// The view's axes are the screen's, so both eyes of a screen look in the same direction.
/// @param near_plane, far_plane distances along the screen's normal [m], 0 < near < far
/// @param pixels of the picture; its aspect is what `fit_aspect` screens take on
render::View view_of(const Screen& screen, const interaction::Pose& head, Eye eye,
                     float eye_separation, float near_plane, float far_plane, glm::ivec2 pixels);

/// How far in front of a screen the eye of a parallel projection stands [m]: over a volume of 1.5 m
/// sizes differ by less than 0.4 %.
constexpr float kFarEye = 500.0f;

/// The parallel projection of what is within `far_plane` [m] of the screen's plane, along its normal.
/// @param distance from the head [m] at which things are as large as in perspective
render::View parallel_view_of(const Screen& screen, const interaction::Pose& head, float distance,
                              float far_plane, glm::ivec2 pixels);

/// The corners in the room, as `view_of` has them: carried along with the head, and fitted to the
/// picture's aspect where the screen asks for it. Lower left, upper left, upper right, lower right.
std::array<glm::vec3, 4> corners_in_room(const Screen& screen, const interaction::Pose& head,
                                         glm::ivec2 pixels);

/// The ray of an eye through a place of its picture: a pose that starts at the eye and looks along -Z.
/// @param at fractions of the picture from the lower left
/// @param pixels of the picture, as `view_of` takes them
interaction::Pose ray_through(const Screen& screen, const interaction::Pose& head, Eye eye,
                              float eye_separation, glm::ivec2 pixels, glm::vec2 at);

/// The same of a parallel projection; it starts as far from the screen as the head is.
interaction::Pose parallel_ray_through(const Screen& screen, const interaction::Pose& head,
                                       float distance, glm::ivec2 pixels, glm::vec2 at);

/// Width and height [m].
glm::vec2 size_of(const Screen& screen);

/// At `upper_left` [degrees]; 90 for a rectangle, not a number where corners coincide.
double corner_angle(const Screen& screen);

/// Whether a point sees the screen from its front, from where left is left.
/// @param viewer in the frame that the screen is given in
bool faces(const Screen& screen, glm::vec3 viewer);

/// From the head to the screen's plane [m].
float distance_to(const Screen& screen, const interaction::Pose& head);

/// The angle [rad] under which a head straight before the screen's middle, as far from its plane as
/// this one, sees its height.
float vertical_field_of_view(const Screen& screen, const interaction::Pose& head);

/// What is wrong with the geometry, one line each; empty when nothing is.
/// @param viewer a point that is meant to see the screen, room frame; a screen carried by the head
/// is judged from the head instead
std::vector<std::string> problems(const Screen& screen, glm::vec3 viewer = {0.0f, 1.6f, 0.0f});

} // namespace isochron::stereo
