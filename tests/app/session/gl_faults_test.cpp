// Every GL object made to fail in turn: one line, or the right picture; never a crash or a wrong
// one. With ISOCHRON_EVERY_FAULT in the environment all are tried, else some.
#include "tests/support/drawing/context_in_between.h"
#include "tests/support/drawing/faulty_driver.h"
#include "tests/support/drawing/golden_fixture.h"
#include "tests/support/every_fault.h"

#include <algorithm>
#include <map>
#include <string>

namespace isochron::app {
namespace {

class GlFaults : public GoldenPictures {
  protected:
    /// The picture of a settled session; `line` takes the error instead.
    Image picture_with_fault(long at, Footprint footprint, std::string& line) {
        try {
            stereo::ContextInBetween context(GetParam(), kPicture, test_support::with_fault(at));
            Config config = one_window(StereoMode::side_by_side);
            config.quality.settled = footprint;
            Session session(config, file_, context);
            settle(session, showing(kPlacement));
            return session.outputs().display().read_window();
        } catch (const render::Error& error) {
            line = error.what();
            return {};
        }
    }
};

TEST_P(GlFaults, GiveALineOrTheRightPicture) {
    std::map<std::string, int> met; // how often each call failed
    int lines = 0;
    for (const Footprint footprint : {Footprint::gaussian, Footprint::mesh, Footprint::surface}) {
        SCOPED_TRACE(render::name_of(footprint));
        std::string line;
        const Image right = picture_with_fault(0, footprint, line);
        ASSERT_EQ(line, "");
        test_support::FaultyCalls calls([](long at) { return at + 1 + at / 6; });
        for (long at = calls.next();; at = calls.next()) {
            line.clear();
            const Image picture = picture_with_fault(at, footprint, line);
            const std::string call = test_support::failed_call();
            if (call.empty())
                break;
            SCOPED_TRACE(std::to_string(at) + " " + call + ": " + line);
            ++met[call];
            lines += !line.empty();
            // A compiler's own words may take more lines.
            if (call != "glCompileShader" && call != "glLinkProgram") {
                EXPECT_EQ(std::ranges::count(line, '\n'), 0);
            }
            if (line.empty()) {
                EXPECT_EQ(picture.rgba, right.rgba);
            }
        }
    }
    EXPECT_GE(met.size(), 8u);
    EXPECT_GE(lines, 20);
    if (test_support::tries_every_fault()) {
        for (const auto& [call, times] : met)
            RecordProperty(call, times);
    }
}

INSTANTIATE_TEST_SUITE_P(, GlFaults, testing::Values(stereo::ContextKind::egl), context_name);

} // namespace
} // namespace isochron::app
