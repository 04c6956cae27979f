// Transfer of cell sets within a byte budget.
#include "render/cell_buffers.h"

#include <fmt/format.h>

#include <algorithm>

namespace isochron::render {

constexpr std::size_t kCellBytes = sizeof(index::CellPoint);

CellBuffers::CellBuffers(const Gl& gl) : gl_(&gl), slots_{Slot(gl), Slot(gl)} {
    GLint limit = 0;
    gl.GetIntegerv(GL_MAX_TEXTURE_BUFFER_SIZE, &limit);
    limit_ = limit;
}

void CellBuffers::begin(Slot& slot, index::CellSetPtr set) {
    if (set->points.size() > limit_)
        throw Error(fmt::format("{} cells at step {}, this GL can draw at most {}",
                                set->points.size(), set->query.step, limit_));
    // Fresh storage instead of the old bytes, which the GPU may still be drawing from.
    gl_->NamedBufferData(slot.buffer.name(),
                         std::max(set->points.size(), std::size_t{1}) * kCellBytes, nullptr,
                         GL_STREAM_DRAW);
    gl_->TextureBuffer(slot.texture.name(), GL_RGB32UI, slot.buffer.name());
    slot.set = std::move(set);
    slot.sent = 0;
}

bool CellBuffers::upload(index::CellSetPtr newest, std::size_t byte_budget) {
    std::size_t cells_left = std::max(byte_budget / kCellBytes, std::size_t{1});
    bool changed = false;
    for (;;) {
        Slot& back = slots_[1 - front_];
        if (!back.set) {
            if (!newest || newest == shown() || cells_left == 0)
                return changed;
            begin(back, newest);
        }
        const auto& points = back.set->points;
        const std::size_t cells = std::min(cells_left, points.size() - back.sent);
        if (cells > 0)
            gl_->NamedBufferSubData(back.buffer.name(), back.sent * kCellBytes, cells * kCellBytes,
                                    points.data() + back.sent);
        back.sent += cells;
        cells_left -= cells;
        if (back.sent < points.size())
            return changed;
        slots_[front_].set = nullptr;
        front_ = 1 - front_;
        ++version_;
        changed = true;
    }
}

} // namespace isochron::render
