// Behind a slow driver: fences passed 50 ms late, times that come ten frames late. Frames go on, every
// set lands once and whole.
#include "tests/support/context_in_between.h"
#include "tests/support/session_fixture.h"

#include <algorithm>
#include <chrono>
#include <map>
#include <thread>

namespace isochron::app {
namespace {

using std::chrono::milliseconds;
using std::chrono::steady_clock;

/// GL's functions have no room for state.
struct SlowDriver {
    static constexpr milliseconds kFenceLate{50};
    static constexpr int kTimesLate = 10; ///< frames
    PFNGLFENCESYNCPROC fence = nullptr;
    PFNGLCLIENTWAITSYNCPROC wait = nullptr;
    PFNGLGETQUERYOBJECTIVPROC query = nullptr;
    std::map<GLsync, steady_clock::time_point> made;
    std::map<GLuint, int>
        asked; ///< how often for a query's result, which is to be asked once a frame
} slow;

GLsync APIENTRY make_slow_fence(GLenum condition, GLbitfield flags) {
    const GLsync sync = slow.fence(condition, flags);
    slow.made[sync] = steady_clock::now();
    return sync;
}
GLenum APIENTRY wait_for_slow_fence(GLsync sync, GLbitfield flags, GLuint64 timeout) {
    const auto left = slow.made[sync] + SlowDriver::kFenceLate - steady_clock::now();
    const auto most = std::chrono::nanoseconds(timeout);
    std::this_thread::sleep_for(std::min<steady_clock::duration>(left, most));
    return left > most ? GLenum{GL_TIMEOUT_EXPIRED} : slow.wait(sync, flags, timeout);
}
void APIENTRY ask_late(GLuint query, GLenum name, GLint* value) {
    slow.query(query, name, value);
    if (name == GL_QUERY_RESULT_AVAILABLE && ++slow.asked[query] < SlowDriver::kTimesLate)
        *value = GL_FALSE;
    else
        slow.asked[query] = 0;
}

class SlowGpu : public SessionTest {
  protected:
    int frame_ = 0;

    stereo::ContextInBetween context_of_slow_driver() const {
        slow = {};
        return {GetParam(), {160, 90}, [](std::string_view wanted, void* found) {
                    if (wanted == "glFenceSync")
                        return stereo::before(found, slow.fence, &make_slow_fence);
                    if (wanted == "glClientWaitSync")
                        return stereo::before(found, slow.wait, &wait_for_slow_fence);
                    if (wanted == "glGetQueryObjectiv")
                        return stereo::before(found, slow.query, &ask_late);
                    return found;
                }};
    }
};

TEST_P(SlowGpu, HoldsUpNoFrameForGoodAndEverySetLandsOnce) {
    for (const auto drawn_by : {render::DrawnBy::gpu, render::DrawnBy::processor}) {
        stereo::ContextInBetween context = context_of_slow_driver();
        Config config = small_config();
        config.drawn_by = drawn_by;
        config.upload_kilobytes_per_frame = 16; // several frames for each
        Session session(config, file_, context);
        const auto steps = static_cast<std::uint32_t>(file_->info().steps());
        std::uint64_t sets = 0;
        for (std::uint32_t step = 0; step < std::min(steps, 4u); ++step) {
            interaction::Commands to;
            to.step = step;
            int frames = 0;
            do {
                ASSERT_LT(++frames, 400) << "step " << step << " never lands";
                const auto& report =
                    session.frame(head_at_rest(frame_++ / 60.0),
                                  frames == 1 ? to : interaction::Commands{}, Waiting::never);
                sets += report.uploaded.sets;
            } while (!session.log().frames().back().shown ||
                     session.log().frames().back().shown->step != step);
        }
        EXPECT_GE(sets, std::min(steps, 4u));
        EXPECT_LE(sets, std::min(steps, 4u) + 1); // what was asked for at the start
        const auto& frames = session.log().frames();
        EXPECT_TRUE(
            std::ranges::any_of(frames, [](const auto& frame) { return frame.gpu.has_value(); }) ||
            frames.size() < 30);
    }
}

INSTANTIATE_TEST_SUITE_P(, SlowGpu,
                         testing::Values(stereo::ContextKind::egl, stereo::ContextKind::osmesa),
                         context_name);

} // namespace
} // namespace isochron::app
