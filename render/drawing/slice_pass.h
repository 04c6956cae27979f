// Draws slices: planes through the data with the values as colors.
#pragma once

#include "index/extraction/slice_values.h"
#include "index/volume/grid.h"
#include "render/cells/axis_table.h"
#include "render/cells/cell_appearance.h"
#include "render/gl/buffer_texture.h"
#include "render/gl/gl_objects.h"
#include "render/gl/shader.h"
#include "render/gl/view.h"

#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>

#include <span>
#include <vector>

namespace isochron::render {

/// A line on a slice, where the values are those of a surface.
struct Isoline {
    float share = 0;       ///< place in the array's range, 0 to 1
    glm::vec3 color{1.0f}; ///< sRGB, 0 to 1
};

class SlicePass {
  public:
    /// @param grid of all slices @throws Error when a shader does not compile
    SlicePass(const Gl& gl, const index::Grid& grid);

    /// Sends values to the GPU unless they are there. @param slices all that are drawn from now on
    void hold(std::span<const index::SliceValuesPtr> slices);
    /// Draws a slice that is held into the view's viewport of the bound framebuffer, opaque and not
    /// lit: its colors are those of the map. Tests and writes depth. Leaves depth test and depth
    /// writes on, blending and culling off.
    /// @param room_from_even from the grid's even coordinates @param width of the lines, pixels
    void draw(const View& view, const glm::mat4& room_from_even, const index::SliceValues& slice,
              const ValueColors& colors, std::span<const Isoline> lines, float width);

  private:
    struct Held {
        index::SliceValuesPtr values;
        BufferTexture columns, shares;
    };

    const Gl& gl_;
    const index::Grid grid_;
    LazyProgram program_;
    VertexArray no_attributes_;
    AxisTable axes_;
    std::vector<Held> held_;
};

} // namespace isochron::render
