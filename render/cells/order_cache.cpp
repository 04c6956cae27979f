// Looks up and replaces orders.
#include "render/cells/order_cache.h"

#include <algorithm>

namespace isochron::render {

OrderCache::OrderCache(const Gl& gl)
    : gl_(&gl), entries_{Entry(gl), Entry(gl), Entry(gl), Entry(gl)} {}

OrderCache::Entry* OrderCache::find(const CellBuffers& cells, const TraversalKey& key) {
    const auto found = std::ranges::find_if(entries_, [&](const Entry& entry) {
        return entry.version == cells.version() && entry.key == key;
    });
    return found == entries_.end() ? nullptr : &*found;
}

/// The sort of this order, begun or further.
BackToFrontSort& OrderCache::ahead(const CellBuffers& cells, const TraversalKey& key) {
    if (!ahead_ || ahead_->version != cells.version() || ahead_->key != key)
        ahead_.emplace(cells.version(), key, BackToFrontSort(cells.slots(), key));
    return ahead_->sort;
}

std::size_t OrderCache::work(const CellBuffers& cells, const TraversalKey& key) {
    return find(cells, key) ? 0 : ahead(cells, key).work();
}

void OrderCache::advance(const CellBuffers& cells, const TraversalKey& key, std::size_t to) {
    if (!find(cells, key))
        ahead(cells, key).advance(cells.slots(), to);
}

OrderCache::Entry& OrderCache::entry(const CellBuffers& cells, const TraversalKey& key) {
    ++uses_;
    Entry* wanted = find(cells, key);
    if (!wanted) {
        wanted = &*std::ranges::min_element(entries_, {}, &Entry::last_use);
        BackToFrontSort& sort = ahead(cells, key);
        sort.advance(cells.slots(), sort.work());
        wanted->order = sort.take();
        ahead_.reset();
        wanted->version = cells.version();
        wanted->key = key;
        wanted->sent = false;
        ++sorts_;
    }
    wanted->last_use = uses_;
    return *wanted;
}

GLuint OrderCache::texture(const CellBuffers& cells, const TraversalKey& key) {
    Entry& wanted = entry(cells, key);
    if (!wanted.sent) {
        wanted.texels.set(GL_R32UI, sizeof(wanted.order[0]),
                          std::as_bytes(std::span(wanted.order)));
        wanted.sent = true;
    }
    return wanted.texels.texture();
}

} // namespace isochron::render
