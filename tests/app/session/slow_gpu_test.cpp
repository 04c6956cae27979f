// A slow driver: fences are passed late, times are known ten frames late. Frames continue, every set
// is shown once and complete, and nothing is sent twice.
#include "tests/support/drawing/context_in_between.h"
#include "tests/support/drawing/late_fences.h"
#include "tests/support/eventually.h"
#include "tests/support/session_fixture.h"

#include <algorithm>
#include <map>
#include <set>

namespace isochron::app {
namespace {

/// What is counted and delayed between the program and the driver. GL's functions have no room for
/// state.
struct Between {
    static constexpr int kTimesLate = 10; ///< frames
    PFNGLGETQUERYOBJECTIVPROC query = nullptr;
    PFNGLMAPNAMEDBUFFERRANGEPROC map = nullptr;
    PFNGLCOPYNAMEDBUFFERSUBDATAPROC copy = nullptr;
    std::map<GLuint, int> asked; ///< how often for a query's result, once a frame
    std::set<GLuint> mapped;
    std::uint64_t staged = 0; ///< bytes copied from mapped buffers
} between;

void APIENTRY ask_late(GLuint query, GLenum name, GLint* value) {
    between.query(query, name, value);
    if (name == GL_QUERY_RESULT_AVAILABLE && ++between.asked[query] < Between::kTimesLate)
        *value = GL_FALSE;
    else
        between.asked[query] = 0;
}

void* APIENTRY note_map(GLuint buffer, GLintptr offset, GLsizeiptr length, GLbitfield access) {
    between.mapped.insert(buffer);
    return between.map(buffer, offset, length, access);
}

void APIENTRY count_copy(GLuint from, GLuint to, GLintptr read, GLintptr write, GLsizeiptr size) {
    if (between.mapped.contains(from))
        between.staged += static_cast<std::uint64_t>(size);
    between.copy(from, to, read, write, size);
}

/// What a walk through the steps sent and showed.
struct Walk {
    std::vector<std::uint64_t> staged; ///< bytes for each step
    std::uint64_t sets = 0;
    std::size_t maps_later = 0; ///< mapped after the first frame
    bool timed = false;         ///< times of the GPU reached the report
};

class SlowGpu : public SessionTest {
  protected:
    static stereo::ContextInBetween context_of_driver(bool slow) {
        between = {};
        render::late_fences = {};
        return {GetParam(), {160, 90}, [slow](std::string_view wanted, void* found) {
                    if (wanted == "glMapNamedBufferRange")
                        return stereo::before(found, between.map, &note_map);
                    if (wanted == "glCopyNamedBufferSubData")
                        return stereo::before(found, between.copy, &count_copy);
                    if (slow && wanted == "glFenceSync")
                        return stereo::before(found, render::late_fences.fence,
                                              &render::make_late_fence);
                    if (slow && wanted == "glClientWaitSync")
                        return stereo::before(found, render::late_fences.wait,
                                              &render::wait_for_late_fence);
                    if (slow && wanted == "glGetQueryObjectiv")
                        return stereo::before(found, between.query, &ask_late);
                    return found;
                }};
    }

    /// To each of the first steps, one after the other; all of it is sent before the next.
    Walk walk(bool slow, render::DrawnBy drawn_by) const {
        stereo::ContextInBetween context = context_of_driver(slow);
        Config config = small_config();
        config.rendering.drawn_by = drawn_by;
        config.memory.mesh_megabytes = 0;                 // no set comes again with its triangles
        config.rendering.upload_kilobytes_per_frame = 16; // several frames for each
        Session session(config, file_, context);
        Walk walk;
        std::size_t maps_at_start = 0;
        int frame = 0;
        for (std::uint32_t step = 0; step < std::min<std::size_t>(file_->info().steps(), 4u);
             ++step) {
            interaction::Commands to;
            to.instant = index::Instant(step);
            const std::uint64_t before = between.staged;
            // What follows a set that is shown already, such as its volume, has come after these.
            int frames = 0, left = 30;
            const auto one_frame = [&] {
                ++frames;
                const FrameReport& report =
                    session.frame(head_at_rest(frame++ / 60.0),
                                  frames == 1 ? to : interaction::Commands{}, Waiting::never);
                walk.sets += report.uploaded.sets;
                const bool sent = report.uploaded.id_bytes + report.uploaded.block_bytes > 0;
                if (!report.shown || report.shown->instant != index::Instant(step) || sent)
                    left = 30;
                else
                    --left;
                if (frame == 1)
                    maps_at_start = between.mapped.size();
            };
            const bool landed = test_support::eventually([&] {
                for (int i = 0; i < 10 && left > 0; ++i)
                    one_frame();
                return left == 0;
            });
            EXPECT_TRUE(landed) << "step " << step;
            walk.staged.push_back(between.staged - before);
        }
        walk.timed = std::ranges::any_of(session.log().frames(),
                                         [](const auto& each) { return each.gpu.has_value(); });
        walk.maps_later = between.mapped.size() - maps_at_start;
        return walk;
    }
};

TEST_P(SlowGpu, HoldsUpNoFrameForGoodAndEverySetLandsOnce) {
    for (const auto drawn_by : {render::DrawnBy::gpu, render::DrawnBy::processor}) {
        const Walk late = walk(true, drawn_by), on_time = walk(false, drawn_by);
        EXPECT_EQ(late.staged, on_time.staged) << "bytes sent twice, or never";
        EXPECT_GT(late.staged.front(), 0u);
        EXPECT_EQ(late.sets, on_time.sets);
        EXPECT_EQ(late.maps_later, 0u) << "a map may wait, so none is made once pictures are shown";
        EXPECT_TRUE(late.timed) << "times that come late come all the same";
    }
}

INSTANTIATE_TEST_SUITE_P(, SlowGpu,
                         testing::Values(stereo::ContextKind::egl, stereo::ContextKind::osmesa),
                         context_name);

} // namespace
} // namespace isochron::app
