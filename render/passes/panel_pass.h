// Draws a panel in the room, and a dot where the user points at it.
#pragma once

#include "render/gl/gl_objects.h"
#include "render/gl/shader.h"
#include "render/gl/view.h"

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <array>
#include <optional>

namespace isochron::render {

struct PanelQuad {
    std::array<glm::vec3, 4>
        corners{};                ///< in the room: lower left, upper left, upper right, lower right
    GLuint texture = 0;           ///< texture of a PanelPicture
    std::optional<glm::vec2> dot; ///< fractions of width and height from the top left
    bool operator==(const PanelQuad&) const = default;
};

/// Whether the panel lies between an eye and a point.
bool hides(const PanelQuad& panel, const glm::vec3& eye, const glm::vec3& point);

class PanelPass {
  public:
    /// @throws Error when a shader does not compile
    explicit PanelPass(const Gl& gl);

    /// Draws into the view's viewport of the bound framebuffer, in linear light; tests depth, and
    /// writes depth for opaque parts. Draw panels before splats, which write no depth. Leaves depth
    /// test and depth writes on, blending and culling off.
    void draw(const View& view, const PanelQuad& panel) const;
    /// Links its program, which would else be linked when it is first used.
    void link() const { program_.name(); }

  private:
    LazyProgram program_;
    VertexArray no_attributes_;
};

} // namespace isochron::render
