// Draws a background that is not just one color.
#pragma once

#include "render/gl/gl_objects.h"
#include "render/gl/shader.h"
#include "render/gl/view.h"

#include <glm/vec3.hpp>

namespace isochron::render {

/// Colors at infinity: where one looks down into the room, and up; sRGB, 0 to 1.
struct BackgroundColors {
    glm::vec3 low{0.0f}, high{0.0f};
    bool operator==(const BackgroundColors&) const = default;
};

/// Colors each pixel by the direction of its ray in the room, so that all eyes see the same sky.
class BackgroundPass {
  public:
    /// @throws Error when a shader does not compile
    explicit BackgroundPass(const Gl& gl);
    /// Covers the view's viewport of the bound framebuffer; before all else.
    void draw(const View& view, const BackgroundColors& colors) const;
    /// Links its program, which would else be linked when it is first used.
    void link() const { program_.name(); }

  private:
    const Gl* gl_;
    LazyProgram program_;
    VertexArray no_attributes_;
};

} // namespace isochron::render
