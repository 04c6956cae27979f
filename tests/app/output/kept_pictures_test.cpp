// Pictures to keep are smoother than those on the displays, which stay as they are.
#include "tests/support/session_fixture.h"

#include "app/loop/pattern_show.h"
#include "render/gl/driver.h"
#include "render/gl/srgb.h"
#include "stereo/image_file.h"
#include "stereo/windows.h"

#include <cmath>

namespace isochron::app {
namespace {

using interaction::Commands;
using render::Image;

constexpr glm::ivec2 kSize(160, 120);

/// A window of a screen that stands in the room, with nothing but the sphere.
Config config_with(int samples, int picture_samples, int scale = 1) {
    Config config = small_config(stereo::StereoMode::mono);
    config.installation.windows.front().size = scale * kSize;
    config.start.bounding_box = config.rendering.wand_ray = false;
    config.quality.settled = render::Footprint::surface;
    config.rendering.blending = Blending::display;
    config.rendering.samples = samples;
    config.pictures.samples = picture_samples;
    return config;
}

class KeptPicturesTest : public SessionTest {
  protected:
    std::unique_ptr<stereo::GlContext> context(int scale = 1) const {
        return stereo::make_context(GetParam(), {.size = scale * kSize});
    }
    static void settle(Session& session) {
        Commands commands;
        commands.isovalue = 6.0;
        for (int frame = 0; frame < 30; ++frame, commands = {})
            session.frame(head_at_rest(frame / 60.0), commands, Waiting::for_cells);
        ASSERT_EQ(session.log().frames().back().footprint, render::Footprint::surface);
    }
    Image eight_times_as_large() const {
        const auto large = context(8);
        Session session(config_with(1, 1, 8), file_, *large);
        settle(session);
        return session.outputs().display().read_window();
    }
    static Image kept(Session& session) {
        Image image;
        session.outputs().kept_pictures().each(
            [&](std::size_t, const stereo::Display& display) { image = display.read_window(); });
        return image;
    }
};

INSTANTIATE_TEST_SUITE_P(Contexts, KeptPicturesTest,
                         testing::Values(stereo::ContextKind::egl, stereo::ContextKind::osmesa),
                         context_name);

/// The light of a picture that is larger by a whole factor, averaged over each pixel.
double averaged(const Image& large, int x, int y, int channel) {
    const int scale = large.width / kSize.x;
    double sum = 0;
    for (int j = 0; j < scale; ++j)
        for (int i = 0; i < scale; ++i)
            sum += render::linear_from_srgb(
                static_cast<float>(large.at(scale * x + i, scale * y + j)[channel]) / 255.0f);
    return 255.0 * render::srgb_from_linear(static_cast<float>(sum / (scale * scale)));
}

/// Mean difference from the averages, 0 to 255, over the pixels in which a picture of one sample
/// for each differs from them: along the outline.
double along_outline(const Image& picture, const Image& coarse, const Image& large) {
    double sum = 0;
    int pixels = 0;
    for (int y = 0; y < kSize.y; ++y)
        for (int x = 0; x < kSize.x; ++x) {
            const double truth = averaged(large, x, y, 0);
            if (std::abs(coarse.at(x, y)[0] - truth) < 12)
                continue;
            ++pixels;
            sum += std::abs(picture.at(x, y)[0] - truth);
        }
    EXPECT_GT(pixels, 40) << "an outline";
    return sum / pixels;
}

TEST_P(KeptPicturesTest, HaveSmoothOutlinesAndLeaveTheDisplayAsItIs) {
    const Image truth = eight_times_as_large();
    const auto small = context();
    Session session(config_with(1, 0), file_, *small);
    settle(session);
    const Image shown = session.outputs().display().read_window();
    const Image picture = kept(session);
    EXPECT_EQ(session.outputs().display().read_window().rgba, shown.rgba);
    EXPECT_FALSE(session.frame(head_at_rest(1), {}, Waiting::for_cells).redrawn);
    EXPECT_EQ(session.outputs().display().read_window().rgba, shown.rgba);
    EXPECT_EQ(kept(session).rgba, picture.rgba);

    const double rough = along_outline(shown, shown, truth);
    EXPECT_LT(along_outline(picture, shown, truth), 0.45 * rough) << "rough: " << rough;
}

TEST_P(KeptPicturesTest, HaveThePartsAndTheSizeThatTheUserHasChosen) {
    const auto small = context();
    Config config = config_with(1, 1);
    config.start.bounding_box = true;
    Session session(config, file_, *small);
    settle(session);
    const Image whole = session.outputs().display().read_window();
    const TestFolder folder;
    session.outputs().set_screenshots(folder.path());
    Commands commands;
    commands.pictures =
        interaction::WrittenPictures{.legend = false, .box = false, .width = 320, .height = 240};
    commands.screenshot = true;
    for (int frame = 0; frame < 10; ++frame, commands = {})
        session.frame(head_at_rest(1 + frame / 60.0), commands, Waiting::for_cells);
    session.outputs().pictures().finish();
    EXPECT_EQ(session.outputs().display().read_window().rgba, whole.rgba) << "the window stays";
    const Image written = stereo::read_image(folder.path() / "isochron_0001.png");
    EXPECT_EQ(glm::ivec2(written.width, written.height), glm::ivec2(320, 240));
    const auto differ = [](const Image& picture) { // from the background, in the uppermost rows
        int pixels = 0;
        for (int y = picture.height * 5 / 6; y < picture.height; ++y)
            for (int x = 0; x < picture.width; ++x)
                pixels += std::abs(picture.at(x, y)[0] - picture.at(0, 0)[0]) > 12 ? 1 : 0;
        return pixels;
    };
    Image bare;
    session.outputs()
        .kept_pictures(session.note())
        .each([&](std::size_t, const stereo::Display& display) { bare = display.read_window(); });
    EXPECT_LT(differ(bare), differ(whole)) << "without legend and box";
}

TEST_P(KeptPicturesTest, OfOneSampleAreWhatTheDisplayShows) {
    const auto small = context();
    Session session(config_with(1, 1), file_, *small);
    settle(session);
    EXPECT_EQ(kept(session).rgba, session.outputs().display().read_window().rgba);
}

TEST_P(KeptPicturesTest, NeverHaveFewerSamplesThanTheDisplayUnlessToldSo) {
    const auto small = context();
    Session session(config_with(4, 0), file_, *small);
    settle(session);
    const Image picture = kept(session);
    EXPECT_EQ(picture.rgba, session.outputs().display().read_window().rgba);
    Session rough(config_with(1, 4), file_, *small);
    settle(rough);
    EXPECT_EQ(kept(rough).rgba, picture.rgba);
}

TEST_P(KeptPicturesTest, AreWhatACaptureWrites) {
    const auto small = context();
    Session session(config_with(1, 4), file_, *small);
    session.outputs().set_screenshots(folder_.path());
    settle(session);
    Commands capture;
    capture.screenshot = true;
    session.frame(head_at_rest(2), capture, Waiting::for_cells);
    session.outputs().pictures().finish();
    EXPECT_EQ(stereo::read_image(folder_.path() / "isochron_0001.png").rgba, kept(session).rgba);
    EXPECT_NE(kept(session).rgba, session.outputs().display().read_window().rgba);
}

TEST_P(KeptPicturesTest, OfMoreSamplesThanThereAreAreRefusedAtTheStart) {
    const auto small = context();
    if (render::max_samples(render::Gl(small->loader())) >= 64)
        GTEST_SKIP() << "there are as many as can be asked for";
    try {
        Session session(config_with(1, 64), file_, *small);
        FAIL() << "no error";
    } catch (const render::Error& error) {
        EXPECT_NE(std::string(error.what()).find("rendering.picture_samples"), std::string::npos);
        EXPECT_NE(std::string(error.what()).find("64"), std::string::npos);
    }
}

TEST_P(KeptPicturesTest, OfAnEmulatedRoomAndItsWallsAreSmoothToo) {
    Config config = read_config("cave4");
    for (stereo::Window& window : config.installation.windows)
        window.size = {96, 96};
    for (const int samples : {1, 4}) {
        config.rendering.samples = 1;
        config.pictures.samples = samples;
        PatternShow show(config,
                         stereo::open_room(GetParam(), config.installation, {.size = kSize}));
        show.frame(head_at_rest(0));
        const Image room = show.outputs().room()->read();
        const Image picture = show.outputs().kept_pictures().of_room();
        EXPECT_EQ(show.outputs().room()->read().rgba, room.rgba);
        EXPECT_EQ(picture.rgba == room.rgba, samples == 1);
        std::size_t walls = 0;
        show.outputs().kept_pictures().each([&](std::size_t i, const stereo::Display& display) {
            EXPECT_EQ(i, walls++);
            EXPECT_EQ(display.read_window().rgba == show.outputs().display(i).read_window().rgba,
                      samples == 1);
        });
        EXPECT_EQ(walls, 4u);
    }
}

} // namespace
} // namespace isochron::app
