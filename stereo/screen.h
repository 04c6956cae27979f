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

/// An eye nearer to a screen's plane than this [m], or behind it, is treated as this far in front
/// of it: the projection stays finite while a head moves through a wall.
constexpr float kNearestEye = 0.01f;

/// Largest difference of a corner from 90 degrees [degrees].
constexpr double kSquareCorner = 1.0;

/// Where an eye is in the room: half the separation away from the head, along its right axis.
/// @param eyes 0: both at the head's position
glm::vec3 eye_position(const interaction::Pose& head, Eye eye, const Eyes& eyes);

/// Generalized perspective projection (R. Kooima, "Generalized Perspective Projection", 2009): the
/// screen's corners are projected to the corners of clip space, wherever the eye is in front of it.
/// The view has the screen's axes, so both eyes of a screen look in the same direction.
/// @param near_plane, far_plane distances along the screen's normal [m], 0 < near < far
/// @param pixels size of the picture; `fit_aspect` screens take its aspect
render::View view_of(const Screen& screen, const interaction::Pose& head, Eye eye, const Eyes& eyes,
                     float near_plane, float far_plane, glm::ivec2 pixels);

/// Distance of the eye of a parallel projection from its screen [m]: within a volume of 1.5 m sizes
/// differ by less than 0.4 %.
constexpr float kFarEye = 500.0f;

/// The parallel projection of everything within `far_plane` [m] of the screen's plane, along its
/// normal.
/// @param distance from the head [m] at which things are as large as in perspective
render::View parallel_view_of(const Screen& screen, const interaction::Pose& head, float distance,
                              float far_plane, glm::ivec2 pixels);

/// The corners in the room that `view_of` uses: moved with the head and fitted to the picture's
/// aspect if the screen asks for that. Lower left, upper left, upper right, lower right.
std::array<glm::vec3, 4> corners_in_room(const Screen& screen, const interaction::Pose& head,
                                         glm::ivec2 pixels);

/// The ray of an eye through a place in its picture: a pose at the eye that looks along -Z.
/// @param at fractions of the picture from the lower left
/// @param pixels size of the picture, as for `view_of`
interaction::Pose ray_through(const Screen& screen, const interaction::Pose& head, Eye eye,
                              const Eyes& eyes, glm::ivec2 pixels, glm::vec2 at);

/// The ray for a parallel projection; it starts at the head's distance from the screen.
interaction::Pose parallel_ray_through(const Screen& screen, const interaction::Pose& head,
                                       float distance, glm::ivec2 pixels, glm::vec2 at);

/// Width and height [m].
glm::vec2 size_of(const Screen& screen);

/// Angle at `upper_left` [degrees]: 90 for a rectangle, NaN if corners coincide.
double corner_angle(const Screen& screen);

/// Whether a point is in front of the screen, where its left side is on the left.
/// @param viewer in the frame that the screen is given in
bool faces(const Screen& screen, glm::vec3 viewer);

/// Distance from the head to the screen's plane [m].
float distance_to(const Screen& screen, const interaction::Pose& head);

/// The angle [rad] of the screen's height, seen from straight in front of its middle at the head's
/// distance.
float vertical_field_of_view(const Screen& screen, const interaction::Pose& head);

/// Problems of the geometry, one line each; empty if there are none.
/// @param viewer a point that should see the screen, in the room; for a screen carried by the head,
/// the head is used instead
std::vector<std::string> problems(const Screen& screen, glm::vec3 viewer = {0.0f, 1.6f, 0.0f});

} // namespace isochron::stereo
