// A driver that passes fences late, like a GPU that is behind.
#pragma once

#include "render/gl/gl.h"

#include <algorithm>
#include <chrono>
#include <map>

namespace isochron::render {

using namespace std::chrono_literals;

/// The state of the functions below; global, because GL's functions take no user data. Time passes
/// only while somebody waits, and a little whenever somebody asks.
struct LateFences {
    static constexpr std::chrono::nanoseconds kLate = std::chrono::milliseconds(50);
    static constexpr std::chrono::nanoseconds kAsked = std::chrono::milliseconds(1);
    PFNGLFENCESYNCPROC fence = nullptr; ///< the driver's own
    PFNGLCLIENTWAITSYNCPROC wait = nullptr;
    std::chrono::nanoseconds now{0};
    std::map<GLsync, std::chrono::nanoseconds> made = {}; ///< when
    bool hangs = false;                                   ///< true: no fence is ever passed
};
inline LateFences late_fences;

inline GLsync APIENTRY make_late_fence(GLenum condition, GLbitfield flags) {
    const GLsync sync = late_fences.fence(condition, flags);
    late_fences.made[sync] = late_fences.now;
    return sync;
}
inline GLenum APIENTRY wait_for_late_fence(GLsync sync, GLbitfield flags, GLuint64 timeout) {
    late_fences.now += LateFences::kAsked;
    const auto left = late_fences.made[sync] + LateFences::kLate - late_fences.now;
    const auto most = std::chrono::nanoseconds(timeout);
    late_fences.now += late_fences.hangs ? most : std::clamp(left, 0ns, most);
    if (late_fences.hangs || left > most)
        return GL_TIMEOUT_EXPIRED;
    return late_fences.wait(sync, flags, timeout);
}

} // namespace isochron::render
