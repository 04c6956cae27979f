// Values and gradients at the vertices of some cells, which are about to be drawn.
#pragma once

#include "render/cells/cell_buffers.h"
#include "render/cells/draw_part.h"
#include "render/gl/device_array.h"

#include <cstddef>
#include <cstdint>

namespace isochron::render {

/// What `CellBuffers::compute_corners` computes, for some cells at a time in the same memory: memory
/// for all cells of a large set takes longer to get than a frame may.
class CornerWindow {
  public:
    static constexpr std::size_t kCells = 1 << 16; ///< most cells at a time: 6 MiB

    explicit CornerWindow(const Gl& gl);

    /// Most cells at a time: `kCells`, or fewer where the GL cannot hold as many.
    std::size_t most() const { return most_; }

    /// Computes the data of these slots, unless they are there.
    /// @param part at most `most()`, all of them in use; the cells' volume is on the GPU
    void show(const CellBuffers& cells, DrawPart part);

    /// Computes the data of the slots in a list.
    /// @param list buffer of their numbers @param count of them, at most `most()`
    void show(const CellBuffers& cells, GLuint list, std::size_t count);

    /// As `CellBuffers` has them, counted from the first slot of the range, or by number in the
    /// list.
    GLuint values_texture() const { return values_.texture(); }
    GLuint gradients_texture() const { return gradients_.texture(); }

  private:
    void write(const CellBuffers& cells, DrawPart part, std::size_t first, GLuint list);

    const Gl* gl_;
    DeviceArray values_, gradients_;
    std::size_t most_;
    std::uint64_t version_ = 0; ///< version of the cells; 0 for cells in a list
    DrawPart shown_{0, 0};
};

} // namespace isochron::render
