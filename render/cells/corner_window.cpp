// Computes corners into memory that is used again.
#include "render/cells/corner_window.h"

#include <cassert>

namespace isochron::render {

CornerWindow::CornerWindow(const Gl& gl)
    : gl_(&gl), values_(CellBuffers::corner_values_array(gl)),
      gradients_(CellBuffers::corner_gradients_array(gl)) {}

void CornerWindow::show(const CellBuffers& cells, DrawPart part) {
    assert(part.count <= kCells);
    if (version_ == cells.version() && part.first == shown_.first && part.count <= shown_.count)
        return;
    values_.reserve(kCells, DeviceArray::Contents::dropped);
    gradients_.reserve(kCells, DeviceArray::Contents::dropped);
    // What was drawn before reads the same memory.
    gl_->MemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT | GL_TEXTURE_FETCH_BARRIER_BIT);
    cells.write_corners(part, values_, gradients_);
    version_ = cells.version();
    shown_ = part;
}

} // namespace isochron::render
