// Two eyes' pictures in one, for red-cyan glasses.
#pragma once

#include "render/gl_objects.h"
#include "render/render_target.h"

#include <glm/vec2.hpp>

namespace isochron::stereo {

/// Red from the left eye, green and blue from the right one; no channel is mixed, so that each
/// filter sees exactly one eye's picture.
class Anaglyph {
  public:
    explicit Anaglyph(const render::Gl& gl);
    /// Draws over the current viewport. @param corner of the viewport in the bound target, pixels;
    /// both pictures have the viewport's size
    void draw(const render::RenderTarget& left, const render::RenderTarget& right,
              glm::ivec2 corner) const;

  private:
    render::Program program_;
    render::VertexArray no_attributes_;
};

} // namespace isochron::stereo
