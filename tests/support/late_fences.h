// A driver that passes fences late, like a GPU that is behind.
#pragma once

#include "render/gl/gl.h"

#include <algorithm>
#include <chrono>
#include <map>
#include <thread>

namespace isochron::render {

/// The state of the functions below; global, because GL's functions take no user data.
struct LateFences {
    static constexpr std::chrono::milliseconds kLate{50};
    PFNGLFENCESYNCPROC fence = nullptr; ///< the driver's own
    PFNGLCLIENTWAITSYNCPROC wait = nullptr;
    std::map<GLsync, std::chrono::steady_clock::time_point> made = {};
    bool hangs = false; ///< true: no fence is ever passed
};
inline LateFences late_fences;

inline GLsync APIENTRY make_late_fence(GLenum condition, GLbitfield flags) {
    const GLsync sync = late_fences.fence(condition, flags);
    late_fences.made[sync] = std::chrono::steady_clock::now();
    return sync;
}
inline GLenum APIENTRY wait_for_late_fence(GLsync sync, GLbitfield flags, GLuint64 timeout) {
    using std::chrono::steady_clock;
    const auto left = late_fences.made[sync] + LateFences::kLate - steady_clock::now();
    const auto most = std::chrono::nanoseconds(timeout);
    std::this_thread::sleep_for(late_fences.hangs ? most
                                                  : std::min<steady_clock::duration>(left, most));
    if (late_fences.hangs || left > most)
        return GL_TIMEOUT_EXPIRED;
    return late_fences.wait(sync, flags, timeout);
}

} // namespace isochron::render
