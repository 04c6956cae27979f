// What is behind the data, where it is more than the color that a picture begins with.
#pragma once

#include "render/gl/gl_objects.h"
#include "render/gl/view.h"

#include <glm/vec3.hpp>

namespace isochron::render {

/// Colors at infinity: where one looks down into the room, and up; sRGB, 0 to 1.
struct BackgroundColors {
    glm::vec3 low{0.0f}, high{0.0f};
    bool operator==(const BackgroundColors&) const = default;
};

/// Goes by the direction of every pixel's ray in the room, so that all eyes and walls see one sky.
class BackgroundPass {
  public:
    /// @throws Error when a shader does not compile
    explicit BackgroundPass(const Gl& gl);
    /// Covers the view's viewport of the bound framebuffer; before all else.
    void draw(const View& view, const BackgroundColors& colors) const;

  private:
    const Gl* gl_;
    Program program_;
    VertexArray no_attributes_;
};

} // namespace isochron::render
