// Looks up and replaces orders.
#include "render/cells/order_cache.h"

#include <algorithm>

namespace isochron::render {

OrderCache::OrderCache(const Gl& gl)
    : gl_(&gl), entries_{Entry(gl), Entry(gl), Entry(gl), Entry(gl)} {}

OrderCache::Entry& OrderCache::entry(const CellBuffers& cells, const TraversalKey& key) {
    ++uses_;
    for (Entry& entry : entries_)
        if (entry.version == cells.version() && entry.key == key) {
            entry.last_use = uses_;
            return entry;
        }
    Entry& oldest =
        *std::min_element(entries_.begin(), entries_.end(),
                          [](const Entry& a, const Entry& b) { return a.last_use < b.last_use; });
    order_back_to_front(cells.slots(), key, oldest.order);
    oldest.version = cells.version();
    oldest.key = key;
    oldest.sent = false;
    oldest.last_use = uses_;
    ++sorts_;
    return oldest;
}

GLuint OrderCache::texture(const CellBuffers& cells, const TraversalKey& key) {
    Entry& wanted = entry(cells, key);
    if (!wanted.sent) {
        // Use fresh storage: the GPU may still draw with the replaced order.
        gl_->NamedBufferData(wanted.buffer.name(), wanted.order.size() * sizeof(wanted.order[0]),
                             wanted.order.data(), GL_STREAM_DRAW);
        gl_->TextureBuffer(wanted.texture.name(), GL_R32UI, wanted.buffer.name());
        wanted.sent = true;
    }
    return wanted.texture.name();
}

} // namespace isochron::render
