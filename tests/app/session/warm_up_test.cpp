// Warming up: what moving pictures and splats are drawn with has been used before the first frame.
#include "tests/support/context_in_between.h"
#include "tests/support/eventually.h"
#include "tests/support/session_fixture.h"

#include <set>
#include <string_view>

namespace isochron::app {
namespace {

struct {
    std::set<GLuint> used;
    PFNGLUSEPROGRAMPROC use = nullptr;
} programs;

void APIENTRY noted_program(GLuint program) {
    programs.used.insert(program);
    programs.use(program);
}
void* with_noted_programs(std::string_view name, void* found) {
    return name == "glUseProgram" ? stereo::before(found, programs.use, &noted_program) : found;
}

class WarmUp : public SessionTest {
  protected:
    stereo::ContextInBetween noting_{GetParam(), {256, 128}, with_noted_programs};
};

INSTANTIATE_TEST_SUITE_P(, WarmUp,
                         testing::Values(stereo::ContextKind::egl, stereo::ContextKind::osmesa),
                         context_name);

TEST_P(WarmUp, UsesEveryProgramThatQuadsAndSplatsNeedFromFarAndFromWithin) {
    Config config = small_config();
    config.quality = interaction::QualityMode::paper; // quads, and splats at rest
    config.mesh_megabytes = 0;
    programs.used.clear();
    Session session(config, file_, noting_);
    session.warm_up();
    EXPECT_TRUE(session.log().frames().empty()) << "nobody sees it";
    const std::set<GLuint> warm = programs.used;
    int number = 0;
    const auto is_drawn = [&](render::Footprint footprint, float way, bool moves) {
        return test_support::eventually([&] {
            bool drawn = false;
            for (int i = 0; i < 30; ++i) {
                interaction::InputState input = head_at_rest(number++ / 60.0);
                input.devices[0].pose->position.z = -way - (moves && i % 2 ? 0.02f : 0.0f);
                interaction::Commands commands;
                if (number == 1)
                    commands.isovalue = 2.0;
                const FrameReport& report = session.frame(input, commands, Waiting::never);
                drawn |= report.redrawn && report.cells > 0 && report.footprint == footprint;
            }
            return drawn;
        });
    };
    for (const float way : {0.0f, 3.0f}) { // ahead is the volume
        // The head moves until cells are there, however late they come.
        ASSERT_TRUE(is_drawn(render::Footprint::quad, way, true));
        ASSERT_TRUE(is_drawn(render::Footprint::gaussian, way, false));
    }
    for (const GLuint program : programs.used)
        EXPECT_TRUE(warm.contains(program)) << program;
    EXPECT_GT(warm.size(), 4u);
}

} // namespace
} // namespace isochron::app
