// Where a sphere and a box must appear in a picture, from nothing but the geometry of the room.
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

/// An eye before a screen that stands in the room. Pixels count from the picture's top left corner,
/// so that the middle of the first one is (0.5, 0.5).
class PinholeEye {
  public:
    PinholeEye(const stereo::Screen& screen, const interaction::Pose& head, stereo::Eye eye,
               double eye_separation, glm::ivec2 picture);

    /// Whether the line of sight through a pixel meets the sphere.
    bool sees(glm::dvec2 pixel, glm::dvec3 center, double radius) const;
    /// Where a point appears; nothing for what is not at least 0.1 m in front of the eye or outside
    /// the picture.
    std::optional<glm::dvec2> pixel_of(glm::dvec3 point) const;
    glm::ivec2 picture() const { return picture_; }

  private:
    glm::dvec3 eye_, upper_left_, across_, down_; ///< the latter two along one pixel
    glm::ivec2 picture_;
};

/// What a convex thing covers: what is drawn over parts of it, such as thin lines, is counted in.
struct Coverage {
    double pixels = 0;
    glm::dvec2 center{0.0};
};
/// @param covered asked for the column and row of each pixel
Coverage coverage(glm::ivec2 picture, const std::function<bool(int, int)>& covered);
Coverage expected_coverage(const PinholeEye& eye, glm::dvec3 center, double radius);

/// Points on the edges of the box [0, extent]^3, evenly spaced, corners included.
std::vector<glm::dvec3> points_on_edges(double extent, int per_edge);

} // namespace isochron::test_support
