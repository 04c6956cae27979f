// Look-up and replacement of orders.
#include "render/order_cache.h"

#include <algorithm>

namespace isochron::render {

OrderCache::OrderCache(const Gl& gl)
    : gl_(&gl), entries_{Entry(gl), Entry(gl), Entry(gl), Entry(gl)} {}

GLuint OrderCache::texture(const CellBuffers& cells, const TraversalKey& key) {
    ++uses_;
    for (Entry& entry : entries_)
        if (entry.cells == &cells && entry.version == cells.version() && entry.key == key) {
            entry.last_use = uses_;
            return entry.texture.name();
        }
    Entry& oldest =
        *std::min_element(entries_.begin(), entries_.end(),
                          [](const Entry& a, const Entry& b) { return a.last_use < b.last_use; });
    order_back_to_front(cells.slots(), key, order_);
    // Fresh storage: the GPU may still be drawing in the order that gives way.
    gl_->NamedBufferData(oldest.buffer.name(), order_.size() * sizeof(order_[0]), order_.data(),
                         GL_STREAM_DRAW);
    gl_->TextureBuffer(oldest.texture.name(), GL_R32UI, oldest.buffer.name());
    oldest.cells = &cells;
    oldest.version = cells.version();
    oldest.key = key;
    oldest.last_use = uses_;
    ++sorts_;
    return oldest.texture.name();
}

} // namespace isochron::render
