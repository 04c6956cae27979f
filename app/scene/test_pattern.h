// What a lab shows to see whether eyes, walls and trackers are what they should be.
#pragma once

#include "interaction/tracked_input.h"
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
#include <vector>

namespace isochron::app {

/// One wall as it stands in a frame.
struct PatternWall {
    std::string name;
    std::array<glm::vec3, 4> corners; ///< room: lower left, upper left, upper right, lower right
    std::string head_device;          ///< of the viewer who sees it
    interaction::Pose head;
    float eye_separation = 0.0f; ///< [m]
    float cross_depth = 0.5f;    ///< [m] of the cross before the wall
};

/// The wall that a viewport shows.
/// @param pixels of the picture of an eye
PatternWall pattern_wall(const stereo::Window& window, std::size_t viewport,
                         const stereo::Viewer& viewer, const interaction::Pose& head,
                         float eye_separation, glm::ivec2 pixels);

/// Where the cross hangs: before the middle of the wall, room.
glm::vec3 cross_of(const PatternWall& wall);

/// How far apart on the wall both eyes see a point [m]: positive where the right eye's image lies
/// to the left of the left one's, as it does before the wall.
float disparity_on(const PatternWall& wall, const glm::vec3& point);

/// Where the middle of an eye's letter is on its wall, fractions from the lower left. L and R stand
/// in different places, so that whoever sees both sees two letters.
glm::vec2 letter_place(stereo::Eye eye);

/// On the wall, at zero parallax: its frame, a grid about its middle, its name and sizes, and in
/// each eye's picture that eye's letter: L, R, or C midway. Before it a cross at a known depth,
/// labeled with what both eyes must see of it. In the room the floor and the axes of every device
/// that has a pose: x red, y green, z blue; those of the wall's own viewer are carried ahead of the
/// head.
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
