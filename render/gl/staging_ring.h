// Sends bytes to the GPU through a ring of mapped memory, without waiting.
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

/// The caller writes bytes into the ring, and the GPU copies them to their buffers. Their room is
/// reused when a fence says that the GPU has copied them. Without fences the GL takes the bytes at
/// once, which may block the caller.
class StagingRing {
  public:
    /// @param bytes size of the ring, a multiple of kUnit
    StagingRing(const Gl& gl, std::size_t bytes, Fences fences = Fences::pass);
    ~StagingRing();
    StagingRing(StagingRing&& other) noexcept;
    StagingRing& operator=(StagingRing&&) = delete;

    Fences fences() const { return own_.empty() ? Fences::pass : Fences::never; }

    /// Used room is rounded up to a multiple of this [byte].
    static constexpr std::size_t kUnit = 16;

    /// Contiguous room to write to: at most `bytes`, rounded up to whole units; less, or none, if
    /// the GPU has not yet copied earlier bytes.
    std::span<std::byte> room(std::size_t bytes);
    /// Tells the GPU to copy the first `bytes` of the last `room` to `buffer`.
    /// @param offset in the buffer [byte]
    void copy(std::size_t bytes, GLuint buffer, std::size_t offset);

    /// Does both for existing bytes: sends the first of them, at most `most`.
    /// @param most at least kUnit
    /// @return bytes sent; may be fewer than there is room for
    std::size_t send(std::span<const std::byte> bytes, std::size_t most, GLuint buffer,
                     std::size_t offset);

    /// Sets a fence behind all copies since the last call.
    void end_frame();

  private:
    struct Flight {
        GLsync fence;
        std::uint64_t end; ///< position after its last byte
    };
    void land();

    const Gl* gl_;
    Buffer buffer_;
    std::size_t size_;
    std::vector<std::byte> own_; ///< replaces mapped memory without fences
    std::byte* mapped_;
    /// Total bytes written, behind a fence, and free again; positions in the ring are modulo
    /// `size_`.
    std::uint64_t written_ = 0, fenced_ = 0, landed_ = 0;
    std::deque<Flight> flights_;
};

} // namespace isochron::render
