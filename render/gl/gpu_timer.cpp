// Timestamp queries in a ring.
#include "render/gl/gpu_timer.h"

namespace isochron::render {
namespace {

constexpr int kMostImpossible = 8;

GLuint64 stamp_of(const Gl& gl, const Query& query) {
    GLuint64 stamp = 0;
    gl.GetQueryObjectui64v(query.name(), GL_QUERY_RESULT, &stamp);
    return stamp;
}

} // namespace

GpuTimer::GpuTimer(const Gl& gl)
    : gl_(&gl), slots_{Slot(gl), Slot(gl), Slot(gl), Slot(gl), Slot(gl), Slot(gl)} {
    GLint bits = 0;
    gl.GetQueryiv(GL_TIMESTAMP, GL_QUERY_COUNTER_BITS, &bits);
    works_ = bits > 0;
}

bool GpuTimer::begin(std::uint64_t tag, Clock::time_point now) {
    if (!works_ || open_ || waiting_ == kSlots)
        return false;
    Slot& slot = slots_[next_];
    slot.tag = tag;
    slot.begun = now;
    gl_->QueryCounter(slot.start.name(), GL_TIMESTAMP);
    open_ = true;
    return true;
}

void GpuTimer::end() {
    if (!open_)
        return;
    gl_->QueryCounter(slots_[next_].end.name(), GL_TIMESTAMP);
    next_ = (next_ + 1) % kSlots;
    ++waiting_;
    open_ = false;
}

std::optional<GpuTimer::Span> GpuTimer::take(Clock::time_point now) {
    if (waiting_ == 0)
        return std::nullopt;
    const Slot& oldest = slots_[(next_ + kSlots - waiting_) % kSlots];
    GLint there = GL_FALSE;
    gl_->GetQueryObjectiv(oldest.end.name(), GL_QUERY_RESULT_AVAILABLE, &there);
    if (!there)
        return std::nullopt;
    --waiting_;
    const Span span{oldest.tag, read(oldest, now)};
    impossible_ = span.time ? 0 : impossible_ + 1;
    works_ = works_ && impossible_ < kMostImpossible;
    return span;
}

std::optional<std::chrono::nanoseconds> GpuTimer::read(const Slot& slot,
                                                       Clock::time_point now) const {
    const GLuint64 start = stamp_of(*gl_, slot.start), end = stamp_of(*gl_, slot.end);
    if (start == 0 || end < start)
        return std::nullopt;
    // The clocks of the GPU and the processor may run slightly differently.
    const auto passed = now - slot.begun;
    const auto most = std::chrono::duration_cast<std::chrono::nanoseconds>(passed) + passed / 10 +
                      std::chrono::milliseconds(1);
    if (end - start > static_cast<GLuint64>(most.count()))
        return std::nullopt;
    return std::chrono::nanoseconds(end - start);
}

} // namespace isochron::render
