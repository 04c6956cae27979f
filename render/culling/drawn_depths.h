// How deep a picture is already covered.
#pragma once

#include "render/culling/box_projection.h"
#include "render/gl/gl.h"
#include "render/gl/view.h"

#include <vector>

namespace isochron::render {

/// The largest depth of each tile of a few pixels, like a hierarchical z-buffer (Greene, Kass and
/// Miller 1993, doi:10.1145/166117.166147).
class DrawnDepths {
  public:
    /// Begins with an empty picture: nothing is drawn yet in this view of the framebuffer that is
    /// bound for drawing.
    void clear(const Gl& gl, const View& view);
    /// Reads the depths of that framebuffer in the same view; with several samples a pixel, goes on
    /// as before.
    void read(const Gl& gl, const View& view);
    /// Whether nothing in these bounds can pass the depth test any more.
    bool hide(const BoxBounds& bounds) const;

  private:
    static constexpr int kBits = 1; ///< bits of a tile's pixels along each side

    glm::ivec2 size_{0}; ///< size of the viewport
    bool one_sample_ = true;
    int columns_ = 0, rows_ = 0;
    std::vector<float> largest_; ///< row by row; empty: nothing is drawn
    std::vector<float> depths_;  ///< window depths of all pixels
};

} // namespace isochron::render
