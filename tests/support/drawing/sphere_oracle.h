// Where a sphere and a box must appear in a picture, computed only from the geometry of the room.
#pragma once

#include "interaction/pose.h"
#include "render/gl/image.h"
#include "stereo/installation.h"

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <functional>
#include <optional>
#include <vector>

namespace isochron::test_support {

/// An eye in front of a screen in the room. Pixel coordinates count from the picture's top left
/// corner, so the middle of the first pixel is (0.5, 0.5).
class PinholeEye {
  public:
    PinholeEye(const stereo::Screen& screen, const interaction::Pose& head, stereo::Eye eye,
               double eye_separation, glm::ivec2 picture);

    /// Whether the line of sight through a pixel meets the sphere.
    bool sees(glm::dvec2 pixel, glm::dvec3 center, double radius) const;
    /// Where a point appears; empty if it is outside the picture, or less than 0.1 m in front of
    /// the eye.
    std::optional<glm::dvec2> pixel_of(glm::dvec3 point) const;
    glm::ivec2 picture() const { return picture_; }

  private:
    glm::dvec3 eye_, upper_left_, across_, down_; ///< the latter two along one pixel
    glm::ivec2 picture_;
};

/// The pixels that a convex thing covers, including those where something is drawn over it, such as
/// thin lines.
struct Coverage {
    double pixels = 0;
    glm::dvec2 center{0.0};
};
/// @param covered called with the column and row of each pixel
Coverage coverage(glm::ivec2 picture, const std::function<bool(int, int)>& covered);
Coverage expected_coverage(const PinholeEye& eye, glm::dvec3 center, double radius);

/// Points on the edges of the box [0, extent]^3, evenly spaced, corners included.
std::vector<glm::dvec3> points_on_edges(double extent, int per_edge);

} // namespace isochron::test_support
