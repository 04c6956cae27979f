// Darkens an eye's picture: while tracking is lost, and around its middle while the viewer flies.
#pragma once

#include "render/gl/gl_objects.h"
#include "render/gl/shader.h"
#include "render/gl/view.h"

namespace isochron::render {

/// Darkness from 0 (none) to 1 (black).
struct Veil {
    float whole = 0.0f; ///< over the whole picture
    float rim = 0.0f;   ///< towards its corners
    bool operator==(const Veil&) const = default;
};

class VeilPass {
  public:
    /// @throws Error when a shader does not compile
    explicit VeilPass(const Gl& gl);

    /// Draws over the view's viewport of the bound framebuffer, at any depth; does nothing if the
    /// veil is zero. Leaves the depth test on and blending off.
    void draw(const View& view, const Veil& veil) const;
    /// Links its program, which would else be linked when it is first used.
    void link() const { program_.name(); }

  private:
    const Gl* gl_;
    LazyProgram program_;
    VertexArray no_attributes_;
};

} // namespace isochron::render
