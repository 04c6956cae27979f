// The GPU timer: its times are true, it leaves out impossible ones, and it never waits.
#include "render/gl/gpu_timer.h"

#include "render/gl/render_target.h"
#include "tests/support/drawing/gl_test.h"

#include <functional>
#include <vector>

namespace isochron::render {
namespace {

using namespace std::chrono_literals;
using Clock = GpuTimer::Clock;

/// A driver whose clock and whose delay the test sets.
struct FakeDriver {
    GLint bits = 64;
    bool answers = true;
    GLuint64 clock = 1'000'000;         ///< [ns]
    std::vector<GLuint64> stamps = {0}; ///< by query name
    int waits = 0;                      ///< results read that were not there
    int live = 0;                       ///< queries
} driver;

Gl fake_gl() {
    static int nothing = 0;
    Gl gl([](const char*) -> void* { return &nothing; });
    driver = {};
    gl.GetQueryiv = [](GLenum, GLenum, GLint* bits) { *bits = driver.bits; };
    gl.CreateQueries = [](GLenum, GLsizei, GLuint* name) {
        *name = static_cast<GLuint>(driver.stamps.size());
        driver.stamps.push_back(0);
        ++driver.live;
    };
    gl.DeleteQueries = [](GLsizei count, const GLuint*) { driver.live -= count; };
    gl.QueryCounter = [](GLuint name, GLenum) { driver.stamps[name] = driver.clock; };
    gl.GetQueryObjectiv = [](GLuint, GLenum, GLint* there) { *there = driver.answers; };
    gl.GetQueryObjectui64v = [](GLuint name, GLenum, GLuint64* stamp) {
        driver.waits += !driver.answers;
        *stamp = driver.stamps[name];
    };
    return gl;
}

/// A span of `time` on the fake driver's clock.
void span(GpuTimer& timer, std::uint64_t tag, std::chrono::nanoseconds time) {
    timer.begin(tag, Clock::time_point{});
    driver.clock += static_cast<GLuint64>(time.count());
    timer.end();
}

constexpr Clock::time_point kLater{1h};

TEST(GpuTimer, GivesEverySpanOnceInOrder) {
    const Gl gl = fake_gl();
    {
        GpuTimer timer(gl);
        for (std::uint64_t frame = 0; frame < 100; ++frame) {
            span(timer, 2 * frame, 3ms * (frame % 4 + 1));
            span(timer, 2 * frame + 1, 1ms);
            const auto first = timer.take(kLater), second = timer.take(kLater);
            ASSERT_TRUE(first && second);
            EXPECT_EQ(first->tag, 2 * frame);
            EXPECT_EQ(first->time, 3ms * (frame % 4 + 1));
            EXPECT_EQ(second->tag, 2 * frame + 1);
            EXPECT_EQ(second->time, 1ms);
            EXPECT_FALSE(timer.take(kLater));
        }
    }
    EXPECT_EQ(driver.live, 0);
}

TEST(GpuTimer, ADriverThatIsBehindIsNotWaitedFor) {
    const Gl gl = fake_gl();
    GpuTimer timer(gl);
    driver.answers = false;
    int measured = 0;
    for (std::uint64_t frame = 0; frame < 50; ++frame) {
        measured += timer.begin(frame, Clock::time_point{});
        timer.end();
        EXPECT_FALSE(timer.take(kLater));
    }
    EXPECT_GT(measured, 2);
    EXPECT_LT(measured, 20) << "queries that are under way were used again";
    EXPECT_EQ(driver.waits, 0);
    driver.answers = true;
    for (std::uint64_t frame = 0; frame < static_cast<std::uint64_t>(measured); ++frame)
        EXPECT_EQ(timer.take(kLater)->tag, frame);
    EXPECT_TRUE(timer.begin(99, Clock::time_point{}));
}

TEST(GpuTimer, WithoutTimestampsItSaysSo) {
    const Gl gl = fake_gl();
    driver.bits = 0;
    GpuTimer timer(gl);
    EXPECT_FALSE(timer.works());
    EXPECT_FALSE(timer.begin(0, Clock::time_point{}));
    timer.end();
    EXPECT_FALSE(timer.take(kLater));
}

TEST(GpuTimer, AnswersThatCannotBeTrueAreNotGivenAndManyEndIt) {
    const auto zero = [](GpuTimer& timer) {
        driver.clock = 0;
        span(timer, 0, 0ns);
    };
    const auto backwards = [](GpuTimer& timer) { span(timer, 0, -1us); };
    const auto longer_than_time = [](GpuTimer& timer) { span(timer, 0, 2h); };
    for (const auto& broken :
         std::vector<std::function<void(GpuTimer&)>>{zero, backwards, longer_than_time}) {
        const Gl gl = fake_gl();
        GpuTimer timer(gl);
        broken(timer);
        EXPECT_EQ(timer.take(kLater)->time, std::nullopt);
        EXPECT_TRUE(timer.works()) << "one answer is an accident";
        driver.clock = 5'000'000;
        span(timer, 1, 1ms);
        EXPECT_EQ(timer.take(kLater)->time, 1ms);
        for (int i = 0; i < 20 && timer.works(); ++i) {
            broken(timer);
            timer.take(kLater);
        }
        EXPECT_FALSE(timer.works());
    }
}

class GpuTimerOnGl : public GlTest {};

TEST_P(GpuTimerOnGl, MeasuresWorkWithinTheTimeThatPassed) {
    GpuTimer timer(gl_);
    ASSERT_TRUE(timer.works());
    RenderTarget target(gl_, {256, 256});
    for (std::uint64_t frame = 0; frame < 20; ++frame) {
        const auto start = Clock::now();
        ASSERT_TRUE(timer.begin(frame, start));
        for (int i = 0; i < 10; ++i)
            target.clear({0, 0, 0, 1});
        timer.end();
        gl_.Finish();
        const auto finished = timer.take(Clock::now());
        const auto most = Clock::now() - start;
        ASSERT_TRUE(finished && finished->time) << "after a finish the result is there";
        EXPECT_EQ(finished->tag, frame);
        EXPECT_GT(*finished->time, 0ns);
        EXPECT_LE(*finished->time, most + 1ms);
    }
    EXPECT_TRUE(timer.works());
}

INSTANTIATE_TEST_SUITE_P(, GpuTimerOnGl, both_contexts(), context_name);

} // namespace
} // namespace isochron::render
