// Combines two eyes' pictures pixel by pixel: by color, or by rows, columns or squares.
#pragma once

#include "render/gl/gl_objects.h"
#include "render/gl/render_target.h"
#include "render/gl/shader.h"
#include "stereo/stereo_mode.h"

#include <glm/vec2.hpp>

#include <string>

namespace isochron::stereo {

/// One eye's picture: a part of a target.
struct EyePicture {
    const render::RenderTarget* target;
    glm::ivec2 corner, size; ///< in the target, pixels from its lower left
};

/// Red-cyan anaglyphs do not mix channels: each filter passes exactly one eye's picture. Dubois'
/// anaglyph is the least-squares projection of both pictures, in linear light, on the colors that
/// the glasses pass: E. Dubois, "A projection method to generate anaglyph stereo images", ICASSP
/// 2001, doi 10.1109/ICASSP.2001.941256, with the matrices of his "Conversion of a stereo pair to
/// anaglyph with the least-squares projection method", 2009. The sum is clamped to the range of the
/// display.
class Multiplex {
  public:
    explicit Multiplex(const render::Gl& gl);

    /// Definitions for multiplex.frag: the number of each mode under its name.
    static std::string shader_prelude();

    /// Whether the two eyes share the pixels in this mode, so that `draw` must compose them.
    static bool shows(StereoMode mode);

    /// Draws over the current viewport.
    /// @param left, right pictures to show in the left and the right eye's place; they have the
    /// viewport's size
    /// @param corner of the viewport in the bound target, pixels from its lower left
    /// @param window_height of the bound target, as rows are counted from its top
    /// @param upside_down the pictures are turned by 180 degrees, each in its place
    void draw(const EyePicture& left, const EyePicture& right, StereoMode mode, glm::ivec2 corner,
              int window_height, bool upside_down = false) const;

  private:
    render::LazyProgram program_;
    render::VertexArray no_attributes_;
};

} // namespace isochron::stereo
