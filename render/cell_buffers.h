// The cells on the GPU: the set that is drawn, and behind it the next one while it is sent.
//
//     buffers.upload(extractor.newest(), 4 << 20);   // every frame
//     if (buffers.shown()) pass.draw(view, placement, buffers, footprint, appearance);
#pragma once

#include "index/cell_set.h"
#include "render/gl_objects.h"

#include <array>
#include <cstddef>
#include <cstdint>

namespace isochron::render {

/// Two slots: one is drawn and never written, the other is filled within a byte budget per frame
/// and takes its place once it is complete, so that no frame ever shows half a set.
class CellBuffers {
  public:
    explicit CellBuffers(const Gl& gl);

    /// Sends at most `byte_budget` bytes, at least one cell. A set whose transfer has begun is
    /// finished before a newer one is taken, so that a stream of new sets cannot keep the picture
    /// from ever changing; sets in between are skipped. Null changes nothing.
    /// @return true when another set is shown than before
    /// @throws Error when the set is larger than the driver's buffer textures
    bool upload(index::CellSetPtr newest, std::size_t byte_budget);

    /// The set that is drawn, null before the first is complete.
    const index::CellSetPtr& shown() const { return slots_[front_].set; }

    /// True while a set is on its way to the GPU.
    bool pending() const { return slots_[1 - front_].set != nullptr; }

    /// Grows with every change of the shown set.
    std::uint64_t version() const { return version_; }

    /// GL_TEXTURE_BUFFER of the shown set, one RGB32UI texel per cell: the words of a CellPoint.
    GLuint texture() const { return slots_[front_].texture.name(); }

  private:
    struct Slot {
        explicit Slot(const Gl& gl) : buffer(gl), texture(gl, GL_TEXTURE_BUFFER) {}
        Buffer buffer;
        Texture texture;
        index::CellSetPtr set;
        std::size_t sent = 0; ///< cells
    };
    void begin(Slot& slot, index::CellSetPtr set);

    const Gl* gl_;
    std::array<Slot, 2> slots_;
    std::size_t front_ = 0;
    std::uint64_t version_ = 0;
    std::size_t limit_ = 0; ///< cells that a buffer texture can hold
};

} // namespace isochron::render
