// Frames wait, for a limited time, for a GPU that is behind; a lost context is reported.
#include "render/gl/driver.h"
#include "render/gl/frames_in_flight.h"
#include "tests/support/gl_test.h"
#include "tests/support/late_fences.h"

#include <gmock/gmock.h>

#include <chrono>

namespace isochron::render {
namespace {

using std::chrono::milliseconds;
using std::chrono::steady_clock;

class FramesInFlightTest : public GlTest {
  protected:
    FramesInFlightTest() {
        late_fences = {.fence = gl_.FenceSync, .wait = gl_.ClientWaitSync};
        gl_.FenceSync = make_late_fence;
        gl_.ClientWaitSync = wait_for_late_fence;
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
    late_fences.hangs = true;
    const auto start = steady_clock::now();
    for (int frame = 0; frame < 4; ++frame)
        frames.end_frame();
    EXPECT_GE(steady_clock::now() - start, milliseconds(2 * 250));
    late_fences.hangs = false;
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
