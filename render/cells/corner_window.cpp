// Computes corners into memory that is used again.
#include "render/cells/corner_window.h"

#include <algorithm>
#include <cassert>

namespace isochron::render {

CornerWindow::CornerWindow(const Gl& gl)
    : gl_(&gl), values_(CellBuffers::corner_values_array(gl)),
      gradients_(CellBuffers::corner_gradients_array(gl)),
      most_(std::min({kCells, values_.limit(), gradients_.limit()})) {}

void CornerWindow::show(const CellBuffers& cells, DrawPart part) {
    if (version_ == cells.version() && part.first == shown_.first && part.count <= shown_.count)
        return;
    write(cells, part, part.first, 0);
    version_ = cells.version();
    shown_ = part;
}

void CornerWindow::show(const CellBuffers& cells, GLuint list, std::size_t count) {
    write(cells, {0, count}, 0, list);
    version_ = 0;
}

void CornerWindow::write(const CellBuffers& cells, DrawPart part, std::size_t first, GLuint list) {
    assert(part.count <= most_);
    values_.reserve(most_, DeviceArray::Contents::dropped);
    gradients_.reserve(most_, DeviceArray::Contents::dropped);
    // What was drawn before reads the same memory.
    gl_->MemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT | GL_TEXTURE_FETCH_BARRIER_BIT);
    cells.write_corners(part, {values_, gradients_, first, list});
}

} // namespace isochron::render
