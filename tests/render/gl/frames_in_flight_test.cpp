// Frames are held back by a GPU that is behind, for a while, and a lost context is told.
#include "render/gl/driver.h"
#include "render/gl/frames_in_flight.h"
#include "tests/support/gl_test.h"

#include <gmock/gmock.h>

#include <chrono>
#include <map>
#include <thread>

namespace isochron::render {
namespace {

using std::chrono::milliseconds;
using std::chrono::steady_clock;

/// A driver whose fences are passed 50 ms late, and not at all while it hangs.
struct LateFences {
    static constexpr milliseconds kLate{50};
    PFNGLFENCESYNCPROC fence = nullptr;
    PFNGLCLIENTWAITSYNCPROC wait = nullptr;
    std::map<GLsync, steady_clock::time_point> made;
    bool hangs = false;
} late;

GLsync APIENTRY make_fence(GLenum condition, GLbitfield flags) {
    const GLsync sync = late.fence(condition, flags);
    late.made[sync] = steady_clock::now();
    return sync;
}
GLenum APIENTRY wait_late(GLsync sync, GLbitfield flags, GLuint64 timeout) {
    const auto left = late.made[sync] + LateFences::kLate - steady_clock::now();
    const auto most = std::chrono::nanoseconds(timeout);
    std::this_thread::sleep_for(late.hangs ? most : std::min<steady_clock::duration>(left, most));
    if (late.hangs || left > most)
        return GL_TIMEOUT_EXPIRED;
    return late.wait(sync, flags, timeout);
}

class FramesInFlightTest : public GlTest {
  protected:
    FramesInFlightTest() {
        late = {.fence = gl_.FenceSync, .wait = gl_.ClientWaitSync, .made = {}};
        gl_.FenceSync = make_fence;
        gl_.ClientWaitSync = wait_late;
    }
};

TEST_P(FramesInFlightTest, GoOnAsFastAsAGpuThatIsLateDraws) {
    FramesInFlight frames(gl_);
    const auto start = steady_clock::now();
    for (int frame = 0; frame < 10; ++frame)
        frames.end_frame();
    // All but the last two have been drawn by now: the first of them no earlier than this.
    EXPECT_GE(steady_clock::now() - start, LateFences::kLate);
}

TEST_P(FramesInFlightTest, AreNotHeldBackForGoodByAGpuThatHangs) {
    FramesInFlight frames(gl_);
    late.hangs = true;
    const auto start = steady_clock::now();
    for (int frame = 0; frame < 4; ++frame)
        frames.end_frame();
    EXPECT_GE(steady_clock::now() - start, milliseconds(2 * 250));
    late.hangs = false;
    frames.end_frame();
}

TEST_P(FramesInFlightTest, ALostContextIsAnErrorThatSaysWhy) {
    EXPECT_NO_THROW(expect_context(gl_));
    gl_.GetGraphicsResetStatus = []() -> GLenum { return GL_INNOCENT_CONTEXT_RESET; };
    try {
        expect_context(gl_);
        FAIL() << "no error";
    } catch (const Error& error) {
        EXPECT_THAT(error.what(), testing::HasSubstr("another program"));
    }
}

INSTANTIATE_TEST_SUITE_P(, FramesInFlightTest, both_contexts(), context_name);

} // namespace
} // namespace isochron::render
