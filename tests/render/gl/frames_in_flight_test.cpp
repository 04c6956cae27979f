// Frames wait, for a limited time, for a GPU that is behind; a lost context is reported.
#include "render/gl/driver.h"
#include "render/gl/frames_in_flight.h"
#include "tests/support/drawing/gl_test.h"
#include "tests/support/drawing/late_fences.h"

#include <gmock/gmock.h>

#include <chrono>

namespace isochron::render {
namespace {

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
    for (int frame = 0; frame < 10; ++frame)
        frames.end_frame();
    // All but the last two have been drawn by now: the first of them no earlier than this.
    EXPECT_GE(late_fences.now, LateFences::kLate);
}

TEST_P(FramesInFlightTest, AreNotHeldBackForGoodByAGpuThatHangs) {
    FramesInFlight frames(gl_);
    late_fences.hangs = true;
    for (int frame = 0; frame < 4; ++frame)
        frames.end_frame();
    EXPECT_GE(late_fences.now, 2 * 250ms);
    EXPECT_LT(late_fences.now, 4 * 300ms);
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
