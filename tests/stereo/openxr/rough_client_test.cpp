// The played runtime itself: a correct program passes, and each mistake is noticed.
#include "tests/stereo/openxr/rough_client.h"

#include "tests/support/played_fixture.h"

namespace isochron::played {
namespace {

class RoughClientTest : public testing::TestWithParam<MistakeCode> {
  protected:
    RoughClientTest() {
        stereo::use_played_runtime();
        played_headset().reset();
    }
    std::vector<std::string> violations_of(Mistake mistake) {
        run_client(std::get<stereo::EglHandles>(context_->native()), mistake);
        std::vector<std::string> codes;
        for (const Violation& each : played_headset().violations)
            codes.push_back(each.code);
        return codes;
    }
    std::unique_ptr<stereo::GlContext> context_ =
        stereo::make_context(stereo::ContextKind::egl, {.size = {16, 16}});
};

TEST_F(RoughClientTest, WithoutAMistakePassesAndShowsFrames) {
    EXPECT_THAT(violations_of(Mistake::none), testing::IsEmpty());
    const auto& frames = played_headset().frames;
    ASSERT_GE(frames.size(), 3u);
    EXPECT_EQ(frames.back().views.size(), 2u);
}

TEST_P(RoughClientTest, TurnsRed) {
    EXPECT_THAT(violations_of(GetParam().mistake), testing::Contains(std::string(GetParam().code)));
}

INSTANTIATE_TEST_SUITE_P(, RoughClientTest, testing::ValuesIn(kMistakes),
                         [](const auto& each) { return std::string(each.param.code); });

} // namespace
} // namespace isochron::played
