// Cache of back-to-front orders on the GPU: while a viewer stands still, nothing is sorted.
#pragma once

#include "render/cells/cell_buffers.h"
#include "render/cells/traversal_order.h"
#include "render/gl/buffer_texture.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace isochron::render {

/// Holds a few orders by set and key, and replaces the least recently used one. So each eye on each
/// screen finds its order again in the next frame; eyes with the same key share one.
class OrderCache {
  public:
    explicit OrderCache(const Gl& gl);

    /// Slots, back to front; valid until the next call.
    std::span<const std::uint32_t> order(const CellBuffers& cells, const TraversalKey& key) {
        return entry(cells, key).order;
    }
    /// The order as a GL_TEXTURE_BUFFER, one R32UI texel per cell.
    GLuint texture(const CellBuffers& cells, const TraversalKey& key);

    /// Work of sorting an order ahead of its first use; 0 if it is there.
    std::size_t work(const CellBuffers& cells, const TraversalKey& key);
    /// Goes on sorting an order until `to` of its work is done. Only one order at a time is sorted
    /// in this way.
    void advance(const CellBuffers& cells, const TraversalKey& key, std::size_t to);

    /// Number of orders sorted so far.
    std::uint64_t sorts() const { return sorts_; }

  private:
    struct Entry {
        explicit Entry(const Gl& gl) : texels(gl) {}
        BufferTexture texels; ///< the order
        std::uint64_t version = 0;
        TraversalKey key;
        std::vector<std::uint32_t> order;
        bool sent = false; ///< to the texture
        std::uint64_t last_use = 0;
    };
    /// An order that is sorted ahead.
    struct Ahead {
        std::uint64_t version;
        TraversalKey key;
        BackToFrontSort sort;
    };
    Entry* find(const CellBuffers& cells, const TraversalKey& key);
    Entry& entry(const CellBuffers& cells, const TraversalKey& key);
    BackToFrontSort& ahead(const CellBuffers& cells, const TraversalKey& key);

    const Gl* gl_;
    std::optional<Ahead> ahead_;
    std::array<Entry, 4> entries_;
    std::uint64_t uses_ = 0, sorts_ = 0;
};

} // namespace isochron::render
