// Drivers that break their promises are recognized, and can still be used.
#include "render/gl/driver.h"
#include "render/gl/driver_trials.h"
#include "tests/support/drawing/gl_test.h"

#include <algorithm>

namespace isochron::render {
namespace {

PFNGLDRAWARRAYSINSTANCEDPROC real_arrays = nullptr;
void APIENTRY first_instance_only(GLenum mode, GLint first, GLsizei count, GLsizei) {
    real_arrays(mode, first, count, 1);
}
GLenum APIENTRY not_in_time(GLsync, GLbitfield, GLuint64) {
    return GL_TIMEOUT_EXPIRED;
}
GLenum APIENTRY failed(GLsync, GLbitfield, GLuint64) {
    return GL_WAIT_FAILED;
}

class DriverTrials : public GlTest {};

TEST_P(DriverTrials, ADrawThatReachesOneViewportOnlyIsFoundOut) {
    real_arrays = gl_.DrawArraysInstanced;
    gl_.DrawArraysInstanced = first_instance_only;
    EXPECT_FALSE(draws_to_two_viewports(gl_));
}

TEST_P(DriverTrials, FencesArePassedHereAndMissedWhereTheyAreNot) {
    EXPECT_TRUE(passes_fences(gl_));
    for (const auto wait : {not_in_time, failed}) {
        gl_.ClientWaitSync = wait;
        EXPECT_FALSE(passes_fences(gl_));
    }
}

TEST_P(DriverTrials, WithoutFencesBytesArriveWhateverTheirPortions) {
    gl_.ClientWaitSync = not_in_time;
    const Buffer target(gl_);
    std::vector<std::byte> bytes(5000), arrived(bytes.size());
    std::ranges::generate(bytes, [&] { return std::byte(random_()); });
    gl_.NamedBufferData(target.name(), GLsizeiptr(bytes.size()), nullptr, GL_DYNAMIC_COPY);
    StagingRing ring(gl_, 160, Fences::never);
    for (std::size_t sent = 0; sent < bytes.size();) {
        const std::size_t most = StagingRing::kUnit + random_() % 300;
        const std::size_t part =
            ring.send(std::span(bytes).subspan(sent), most, target.name(), sent);
        ASSERT_GT(part, 0u) << "at " << sent;
        sent += part;
        ring.end_frame();
    }
    gl_.GetNamedBufferSubData(target.name(), 0, GLsizeiptr(arrived.size()), arrived.data());
    EXPECT_EQ(arrived, bytes);
}

TEST_P(DriverTrials, TheWaysToDrawAreThoseThatAreAskedFor) {
    gl_.drawn_by = DrawnBy::gpu;
    EXPECT_FALSE(is_drawn_for_processor(gl_));
    EXPECT_EQ(CellBuffers::wanted_shading(gl_), index::Shading::none);
    gl_.drawn_by = DrawnBy::processor;
    EXPECT_TRUE(is_drawn_for_processor(gl_));
    EXPECT_EQ(CellBuffers::wanted_shading(gl_), index::Shading::cells);
}

INSTANTIATE_TEST_SUITE_P(, DriverTrials, both_contexts(), context_name);

} // namespace
} // namespace isochron::render
