// The test pattern, with which a lab checks its eyes, walls and trackers.
#pragma once

#include "interaction/input/tracked_input.h"
#include "render/gl/view.h"
#include "render/passes/line_pass.h"
#include "render/passes/text_pass.h"
#include "stereo/installation.h"
#include "stereo/stereo_mode.h"

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <array>
#include <span>
#include <string>

namespace isochron::app {

/// One wall in a frame.
struct PatternWall {
    std::string name;
    std::array<glm::vec3, 4> corners; ///< room: lower left, upper left, upper right, lower right
    std::string head_device;          ///< device of the viewer who sees it
    interaction::Pose head;
    stereo::Eyes eyes;        ///< in the head's frame
    float cross_depth = 0.5f; ///< [m] distance of the cross in front of the wall
};

/// The wall that a viewport shows.
/// @param pixels size of one eye's picture
PatternWall pattern_wall(const stereo::Window& window, std::size_t viewport,
                         const stereo::Viewer& viewer, const interaction::Pose& head,
                         const stereo::Eyes& eyes, glm::ivec2 pixels);

/// Place of the cross in the room: in front of the middle of the wall.
glm::vec3 cross_of(const PatternWall& wall);

/// Distance between a point's images for both eyes on the wall [m]: positive if the right eye's
/// image is to the left of the left eye's, as for points in front of the wall.
float disparity_on(const PatternWall& wall, const glm::vec3& point);

/// Place of the middle of an eye's letter on the wall, fractions from the lower left. L and R are
/// in different places, so that an eye that sees both pictures sees two letters.
glm::vec2 letter_place(stereo::Eye eye);

/// On the wall, at zero parallax: its frame, a grid around its middle, its name and sizes, and each
/// eye's letter in that eye's picture: L, R, or C for the center. In front of it: a cross at a
/// known depth, labeled with the disparity that both eyes must see. In the room: the floor, and the
/// axes of every device with a pose (x red, y green, z blue); the axes of the wall's own viewer are
/// drawn ahead of the head, where they can be seen.
class TestPattern {
  public:
    /// @throws render::Error when a shader does not compile
    explicit TestPattern(const render::Gl& gl);

    /// Draws into the views' viewports of the bound framebuffer.
    /// @param eyes of the views, in their order
    void draw(std::span<const render::View> views, std::span<const stereo::Eye> eyes,
              const PatternWall& wall, const interaction::InputState& input);

  private:
    render::LinePass lines_;
    render::TextPass text_;
};

} // namespace isochron::app
