// Manages room, copies and fences of the staging ring.
#include "render/gl/staging_ring.h"

#include <algorithm>
#include <cassert>
#include <cstring>
#include <utility>

namespace isochron::render {

StagingRing::StagingRing(const Gl& gl, std::size_t bytes, Fences fences)
    : gl_(&gl), buffer_(gl), size_(bytes) {
    assert(bytes > 0 && bytes % kUnit == 0);
    if (fences == Fences::never) {
        own_.resize(bytes);
        mapped_ = own_.data();
        return;
    }
    constexpr GLbitfield kAccess = GL_MAP_WRITE_BIT | GL_MAP_PERSISTENT_BIT | GL_MAP_COHERENT_BIT;
    const auto size = static_cast<GLsizeiptr>(bytes);
    gl.NamedBufferStorage(buffer_.name(), size, nullptr, kAccess);
    mapped_ = static_cast<std::byte*>(gl.MapNamedBufferRange(buffer_.name(), 0, size, kAccess));
    if (!mapped_)
        throw Error("staging memory: the GL cannot map it");
}

StagingRing::StagingRing(StagingRing&& other) noexcept
    : gl_(other.gl_), buffer_(std::move(other.buffer_)), size_(other.size_),
      own_(std::move(other.own_)), mapped_(other.mapped_), written_(other.written_),
      fenced_(other.fenced_), landed_(other.landed_), flights_(std::exchange(other.flights_, {})) {}

StagingRing::~StagingRing() {
    for (const Flight& flight : flights_)
        gl_->DeleteSync(flight.fence);
}

void StagingRing::land() {
    while (!flights_.empty()) {
        const Flight& flight = flights_.front();
        // Flush, so that the GPU gets the fence even if nothing else is drawn.
        const GLenum state = gl_->ClientWaitSync(flight.fence, GL_SYNC_FLUSH_COMMANDS_BIT, 0);
        if (state != GL_ALREADY_SIGNALED && state != GL_CONDITION_SATISFIED)
            return;
        landed_ = flight.end;
        gl_->DeleteSync(flight.fence);
        flights_.pop_front();
    }
}

std::span<std::byte> StagingRing::room(std::size_t bytes) {
    const std::size_t at = written_ % size_;
    const auto free = [&] {
        return std::min<std::size_t>(size_ - (written_ - landed_), size_ - at);
    };
    const std::size_t wanted = (bytes + kUnit - 1) / kUnit * kUnit;
    if (free() < wanted)
        land();
    return {mapped_ + at, std::min(wanted, free())};
}

std::size_t StagingRing::send(std::span<const std::byte> bytes, std::size_t most, GLuint buffer,
                              std::size_t offset) {
    std::size_t count = std::min(bytes.size(), most);
    const std::span<std::byte> place = room(count);
    count = std::min(count, place.size());
    if (count < bytes.size())
        count = count / kUnit * kUnit; // so that the next part also starts at a unit
    if (count > 0) {
        std::memcpy(place.data(), bytes.data(), count);
        copy(count, buffer, offset);
    }
    return count;
}

void StagingRing::copy(std::size_t bytes, GLuint buffer, std::size_t offset) {
    const std::size_t at = written_ % size_;
    written_ += (bytes + kUnit - 1) / kUnit * kUnit;
    if (fences() == Fences::never) {
        gl_->NamedBufferSubData(buffer, static_cast<GLintptr>(offset),
                                static_cast<GLsizeiptr>(bytes), mapped_ + at);
        landed_ = fenced_ = written_;
        return;
    }
    gl_->CopyNamedBufferSubData(buffer_.name(), buffer, static_cast<GLintptr>(at),
                                static_cast<GLintptr>(offset), static_cast<GLsizeiptr>(bytes));
}

void StagingRing::end_frame() {
    if (written_ == fenced_)
        return;
    fenced_ = written_;
    if (const GLsync fence = gl_->FenceSync(GL_SYNC_GPU_COMMANDS_COMPLETE, 0)) {
        flights_.push_back({fence, written_});
    } else { // rather a frame that waits than a transfer that never ends
        gl_->Finish();
        land();
        landed_ = written_;
    }
}

} // namespace isochron::render
