// A driver with the smallest limits of GL 4.5 core draws the same; with smaller limits an error
// says what is missing.
#include "tests/support/drawing/context_in_between.h"
#include "tests/support/drawing/golden_fixture.h"
#include "tests/support/drawing/least_driver.h"

#include <array>
#include <map>
#include <string>

namespace isochron::app {
namespace {

class LimitedContext final : public stereo::ContextInBetween {
  public:
    LimitedContext(stereo::ContextKind kind, const std::map<GLenum, GLint64>& limits)
        : ContextInBetween(kind, kPicture, test_support::with_limits(limits)) {}
};

class LeastDriver : public GoldenPictures {
  protected:
    Config config_for(Footprint footprint) const {
        Config config = one_window(StereoMode::side_by_side);
        config.quality.settled = footprint;
        return config;
    }
    /// What a footprint looks like at two steps, of which the second sends what has changed.
    std::array<Image, 2> pictures_of(Footprint footprint, stereo::GlContext& context) {
        Session session(config_for(footprint), file_, context);
        Commands commands = showing(kPlacement);
        if (footprint == Footprint::quad)
            commands.quality = interaction::QualityMode::fast;
        std::array<Image, 2> pictures;
        for (Image& picture : pictures) {
            EXPECT_EQ(settle(session, commands), footprint);
            picture = session.outputs().display().read_window();
            commands.instant->step += 1;
        }
        return pictures;
    }
};

/// Where points are a pixel at most, quads stand for them, which round a little otherwise. Of
/// ellipses, which end between pixels, one pixel in a thousand may lie on the other side of an
/// edge.
constexpr ImageTolerance kEllipses{.maximum = 160, .mean = 0.08, .strays = 0.001};
constexpr ImageTolerance kSame{.maximum = 0, .mean = 0.0};

TEST_P(LeastDriver, DrawsEveryFootprintAsAnyOther) {
    for (const Footprint footprint : {Footprint::quad, Footprint::gaussian, Footprint::surface}) {
        SCOPED_TRACE(render::name_of(footprint));
        LimitedContext unlimited(GetParam(), {});
        const auto expected = pictures_of(footprint, unlimited);
        LimitedContext least(GetParam(), test_support::least_limits());
        const auto actual = pictures_of(footprint, least);
        for (std::size_t i = 0; i < expected.size(); ++i)
            EXPECT_TRUE(test_support::images_match(
                actual[i], expected[i], footprint == Footprint::surface ? kSame : kEllipses,
                "least_driver_" + std::string(render::name_of(footprint)) + std::to_string(i)));
    }
}

TEST_P(LeastDriver, WithLessSaysAtTheStartWhatItLacks) {
    std::map<GLenum, GLint64> limits = test_support::least_limits();
    limits[GL_MAX_COMPUTE_SHADER_STORAGE_BLOCKS] = 2;
    LimitedContext less(GetParam(), limits);
    try {
        Session session(config_for(Footprint::quad), file_, less);
        FAIL() << "no error";
    } catch (const render::Error& error) {
        EXPECT_STREQ(error.what(), "GL_MAX_COMPUTE_SHADER_STORAGE_BLOCKS is 2 with this GL, at "
                                   "least 3 is needed");
    }
}

INSTANTIATE_TEST_SUITE_P(, LeastDriver,
                         testing::Values(stereo::ContextKind::egl, stereo::ContextKind::osmesa),
                         context_name);

} // namespace
} // namespace isochron::app
