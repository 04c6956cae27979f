// Which cells of a set a view draws, and in which order.
#pragma once

#include "render/cells/cell_buffers.h"
#include "render/cells/order_cache.h"
#include "render/cells/placement.h"
#include "render/culling/seen_slots.h"
#include "render/gl/buffer_texture.h"
#include "render/gl/view.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

namespace isochron::render {

/// The sequence of a view: cell n is in the slot that texel `begin + n * step` holds; without a
/// texture, in slot n.
struct CellSequence {
    std::size_t cells = 0;
    GLuint texture = 0;
    int begin = 0, step = 0;

    /// If the cells are divided into `of` equal parts: the cells of parts `first` to `end` - 1.
    CellSequence part(std::size_t first, std::size_t end, std::size_t of) const;
};

/// A view, and what sequence it wants.
struct SequenceWanted {
    const View& view;
    const Placement& placement;
    const CellBuffers& cells;
    SplatShape shape;
    float falloff;   ///< falloff of splats, see SeenSlots
    bool blended;    ///< splats, back to front; else quads, nearest first
    bool leaves_out; ///< cells that cannot be seen are culled
};

/// Finds sequences, at once or in pieces, as finding one may take longer than a frame.
class CellSequences {
  public:
    explicit CellSequences(const Gl& gl);

    CellSequence find(const SequenceWanted& wanted) { return *find(wanted, 1, 1); }
    /// Goes on until `to` of `of` equal parts of the work are done.
    /// @return the sequence once all is done, valid until the next call; before, nothing
    std::optional<CellSequence> find(const SequenceWanted& wanted, std::size_t to, std::size_t of);

    OrderCache& orders() { return orders_; }
    const OrderCache& orders() const { return orders_; }

  private:
    /// What the cells that are seen depend on, apart from what never changes.
    struct Seen {
        std::uint64_t version;
        View view;
        Placement placement;
        bool blended;
        bool complete = false; ///< and on the GPU
        std::size_t cells = 0;
        bool of(const SequenceWanted& wanted) const;
    };
    void begin(const SequenceWanted& wanted);
    void look(const SequenceWanted& wanted, std::size_t to, std::size_t of);

    OrderCache orders_;
    SeenSlots finder_;
    std::optional<Seen> seen_;
    std::vector<std::array<std::uint32_t, 3>> texels_; ///< see cell_order.glsl
    BufferTexture slots_;
};

} // namespace isochron::render
