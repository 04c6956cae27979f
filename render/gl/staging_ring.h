// The way of bytes to the GPU: a ring of mapped memory that nobody ever waits for.
#pragma once

#include "render/gl/gl_objects.h"

#include <cstddef>
#include <cstdint>
#include <deque>
#include <span>
#include <vector>

namespace isochron::render {

/// Whether the driver passes fences, see `passes_fences`.
enum class Fences : bool { never, pass };

/// Bytes are written into the ring, copied from there by the GPU to where they belong, and their
/// room is used again once a fence says that the GPU has copied them. Without fences the GL takes
/// the bytes at once, which may keep the caller waiting.
class StagingRing {
  public:
    /// @param bytes of room, a multiple of kUnit
    StagingRing(const Gl& gl, std::size_t bytes, Fences fences = Fences::pass);
    ~StagingRing();
    StagingRing(StagingRing&& other) noexcept;
    StagingRing& operator=(StagingRing&&) = delete;

    Fences fences() const { return own_.empty() ? Fences::pass : Fences::never; }

    /// What is claimed is rounded up to this.
    static constexpr std::size_t kUnit = 16;

    /// Room to write to, in one piece: at most `bytes` rounded up to whole units; less, or none,
    /// where the GPU has not yet copied what is there.
    std::span<std::byte> room(std::size_t bytes);
    /// Has the first `bytes` of the room that was given last copied to `buffer`.
    void copy(std::size_t bytes, GLuint buffer, std::size_t offset);

    /// Both for bytes that lie ready: copies the first of them, at most `most` of which there must
    /// be a unit. @return how many; not always all for which there is room
    std::size_t send(std::span<const std::byte> bytes, std::size_t most, GLuint buffer,
                     std::size_t offset);

    /// Marks what was copied since the last call with a fence.
    void end_frame();

  private:
    struct Flight {
        GLsync fence;
        std::uint64_t end; ///< of its bytes
    };
    void land();

    const Gl* gl_;
    Buffer buffer_;
    std::size_t size_;
    std::vector<std::byte> own_; ///< in place of mapped memory, without fences
    std::byte* mapped_;
    /// Bytes ever written, covered by fences, and free again; positions are modulo `size_`.
    std::uint64_t written_ = 0, fenced_ = 0, landed_ = 0;
    std::deque<Flight> flights_;
};

} // namespace isochron::render
