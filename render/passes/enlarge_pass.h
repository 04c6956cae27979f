// Draws a view in few pixels and makes the picture as large as the view: for what moves.
#pragma once

#include "render/gl/gl_objects.h"
#include "render/gl/shader.h"
#include "render/gl/view.h"

#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>

#include <optional>
#include <span>
#include <vector>

namespace isochron::render {

/// What is drawn between `begin` and `end` must write an opacity of 1.
class EnlargePass {
  public:
    /// @param gl outlives the pass @throws Error when a shader does not compile
    explicit EnlargePass(const Gl& gl);

    /// Binds a target of its own, with nothing in it.
    /// @param views of the bound framebuffer @param share of their width and height that is drawn
    /// @param linear what is drawn writes linear light; else display values
    /// @throws Error when the driver cannot make the target
    void begin(std::span<const View> views, float share, bool linear);
    /// The views to draw in between: the same, with fewer pixels.
    std::span<const View> few() const { return few_; }
    /// Binds the framebuffer that was bound before, and draws into its views, with depth, what has
    /// been drawn since `begin`, within a box. Leaves depth test, depth writes and GL_FRAMEBUFFER_SRGB on,
    /// blending off, and the viewports set.
    /// @param room_from_box the box is that of 0 to 1 along each axis
    /// @param layers what has been drawn lets light through: it is blended over the views, without depth
    void end(std::span<const View> views, const glm::mat4& room_from_box, bool layers) const;

  private:
    struct Target {
        Target(const Gl& gl, glm::ivec2 pixels, bool linear);
        glm::ivec2 size;
        bool linear;
        Texture color, depth;
        Framebuffer framebuffer;
    };

    const Gl* gl_;
    LazyProgram program_;
    VertexArray no_attributes_;
    std::optional<Target> target_;
    std::vector<View> few_;
    GLuint bound_ = 0;
};

} // namespace isochron::render
