// Draws a panel that stands in the room, and the dot on it where somebody points.
#pragma once

#include "render/gl/gl_objects.h"
#include "render/gl/view.h"

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <array>
#include <optional>

namespace isochron::render {

struct PanelQuad {
    std::array<glm::vec3, 4>
        corners{};                ///< in the room: lower left, upper left, upper right, lower right
    GLuint texture = 0;           ///< a PanelPicture's
    std::optional<glm::vec2> dot; ///< fractions of width and height from the top left
    bool operator==(const PanelQuad&) const = default;
};

/// Whether the panel lies between an eye and a point.
bool hides(const PanelQuad& panel, const glm::vec3& eye, const glm::vec3& point);

class PanelPass {
  public:
    /// @throws Error when a shader does not compile
    explicit PanelPass(const Gl& gl);

    /// Draws into the view's viewport of the bound framebuffer, as light; tests depth and writes
    /// that of what is opaque: draw panels before splats, which do not write any. Leaves depth test
    /// and depth writes on, blending and culling off.
    void draw(const View& view, const PanelQuad& panel) const;

  private:
    Program program_;
    VertexArray no_attributes_;
};

} // namespace isochron::render
