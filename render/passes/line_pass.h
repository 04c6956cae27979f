// Draws lines in space: the volume's box, the wand's ray, a floor to stand on.
#pragma once

#include "render/gl/gl_objects.h"
#include "render/gl/quad_indices.h"
#include "render/gl/shader.h"
#include "render/gl/texel_buffer.h"
#include "render/gl/view.h"

#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include <span>
#include <vector>

namespace isochron::render {

struct Line {
    glm::vec3 from, to;
    glm::vec4 color{1.0f}; ///< sRGB, not pre-multiplied; a: opacity
};

/// The twelve edges of the box [0, extent], by where they are.
struct BoxLines {
    std::vector<Line> front; ///< between two faces towards the eye: before what is inside
    /// Between a face towards the eye and one that is turned away: nothing inside hides them, and they
    /// hide nothing inside.
    std::vector<Line> outline;
    std::vector<Line> back; ///< behind what is inside; all, for an eye in the box
};
/// @param eye in the box's coordinates
BoxLines box_lines(const glm::vec3& extent, const glm::vec4& color, const glm::vec3& eye);

class LinePass {
  public:
    /// @throws Error when a shader does not compile
    explicit LinePass(const Gl& gl);

    /// Draws into the view's viewport of the bound framebuffer, `width` pixels wide at any
    /// distance, with soft edges; tests depth, and writes depth for the lines' core. Soft edges
    /// blend with what was drawn before, so draw lines after the things behind them. But draw lines
    /// that splats may hide before the splats, as these write no depth. Leaves depth test and depth
    /// writes on, blending and culling off.
    void draw(const View& view, const glm::mat4& room_from_model, std::span<const Line> lines,
              float width = 1.5f);

  private:
    const Gl* gl_;
    LazyProgram program_;
    QuadIndices quads_;
    TexelBuffer segments_;
    Buffer frame_;
};

} // namespace isochron::render
