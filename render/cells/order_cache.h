// Orders on the GPU, kept as long as they hold: a standing viewer sorts nothing.
#pragma once

#include "render/cells/cell_buffers.h"
#include "render/cells/traversal_order.h"

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace isochron::render {

/// A few orders by set and key, the least recently used one gives way: both eyes on every screen
/// find theirs again in the next frame, and eyes with the same key share one.
class OrderCache {
  public:
    explicit OrderCache(const Gl& gl);

    /// Slots, back to front; until the next call.
    std::span<const std::uint32_t> order(const CellBuffers& cells, const TraversalKey& key) {
        return entry(cells, key).order;
    }
    /// The same as a GL_TEXTURE_BUFFER, one R32UI texel per cell.
    GLuint texture(const CellBuffers& cells, const TraversalKey& key);

    /// How many orders were made so far.
    std::uint64_t sorts() const { return sorts_; }

  private:
    struct Entry {
        explicit Entry(const Gl& gl) : buffer(gl), texture(gl, GL_TEXTURE_BUFFER) {}
        Buffer buffer;
        Texture texture;
        std::uint64_t version = 0;
        TraversalKey key;
        std::vector<std::uint32_t> order;
        bool sent = false; ///< to the texture
        std::uint64_t last_use = 0;
    };
    Entry& entry(const CellBuffers& cells, const TraversalKey& key);

    const Gl* gl_;
    std::array<Entry, 4> entries_;
    std::uint64_t uses_ = 0, sorts_ = 0;
};

} // namespace isochron::render
