// A settled picture gets more samples in parts once it is exact: how true its edges are, what ends
// that, and what is written.
#include "tests/support/session_fixture.h"

#include "render/gl/srgb.h"
#include "stereo/context/gl_context_backends.h"
#include "stereo/image_file.h"
#include "tests/support/eventually.h"
#include "tests/support/memory_series.h"

#include <cmath>
#include <cstdlib>
#include <vector>

namespace isochron::app {
namespace {

using interaction::Commands;
using render::Image;

constexpr glm::ivec2 kFrameSize(160, 120);
constexpr int kFiner = 4; ///< samples of the truth along each side of a pixel

/// Where the data stand: all of it from one side, from a corner, and from among it.
struct NamedView {
    const char* name;
    double turn, tilt;    ///< [rad]
    glm::dvec3 center;    ///< [m]
    double scale = 0.045; ///< [m] of a voxel
};
constexpr NamedView kViews[]{{"front", 0.1, 0.07, {0, 1.5, -2.6}},
                             {"corner", 0.75, 0.55, {0, 1.5, -2.6}},
                             {"near", 0.4, 0.2, {0.1, 1.45, -1.2}}};

class SettledSamplesTest : public testing::Test {
  protected:
    SettledSamplesTest()
        : waves_({33, 33, 33}, 1, index::ValueType::f32, [](double x, double y, double z, double) {
              return std::sin(x / 2) * std::cos(y / 2) + std::sin(y / 2) * std::cos(z / 2) +
                     std::sin(z / 2) * std::cos(x / 2);
          }) {
        index::MemorySeries series(waves_.view());
        build_index(series, folder_.path() / "waves.isochron", {});
        file_ = index::IndexFile::open(folder_.path() / "waves.isochron");
    }
    static std::unique_ptr<stereo::GlContext> context(int finer = 1) {
        return stereo::make_context(stereo::ContextKind::egl, {.size = finer * kFrameSize});
    }
    static Config config_with(int samples, int passes, int finer = 1) {
        Config config = small_config(stereo::StereoMode::mono);
        config.installation.windows.front().size = finer * kFrameSize;
        config.start.bounding_box = config.rendering.wand_ray = false;
        config.rendering.samples = samples;
        config.pictures.passes = passes;
        config.quality.still_budget_ms = 1e4;
        return config;
    }
    static Commands showing(const NamedView& view) {
        Commands commands;
        commands.isovalue = 0.45;
        interaction::Similarity placement;
        placement.scale = view.scale;
        placement.rotation = glm::angleAxis(view.tilt, glm::dvec3(1, 0, 0)) *
                             glm::angleAxis(view.turn, glm::dvec3(0, 1, 0));
        placement.translation =
            view.center - placement.scale * (placement.rotation * glm::dvec3(16));
        commands.room_from_physical = placement;
        return commands;
    }
    FrameReport frame(Session& session, const Commands& commands = {}) {
        return session.frame(head_at_rest(frame_++ / 60.0), commands, Waiting::never);
    }
    /// Frames until nothing is to come. @return the picture when it was exact for the first time
    Image settle(Session& session, const Commands& commands) {
        Image exact;
        frame(session, commands);
        EXPECT_TRUE(test_support::eventually([&] {
            for (int i = 0; i < 50; ++i) {
                const FrameReport report = frame(session);
                if (report.final && report.shown == report.asked && exact.rgba.empty())
                    exact = session.outputs().display().read_window();
                if (const FrameOutlook next = session.outlook(); next.final && !next.busy)
                    return true;
            }
            return false;
        }));
        return exact;
    }
    /// The light of a picture with sixteen samples of each pixel, at the places of a grid.
    struct Truth {
        Image mean;
        std::vector<bool> near_edge; ///< within two pixels of one in which samples differ
    };
    Truth truth(const NamedView& view) {
        const auto large = context(kFiner);
        Session session(config_with(1, 1, kFiner), file_, *large);
        settle(session, showing(view));
        const Image fine = session.outputs().display().read_window();
        Truth truth{{kFrameSize.x, kFrameSize.y,
                     std::vector<std::uint8_t>(4ul * kFrameSize.x * kFrameSize.y)},
                    std::vector<bool>(static_cast<std::size_t>(kFrameSize.x) * kFrameSize.y)};
        std::vector<bool> edge(truth.near_edge.size());
        for (int y = 0; y < kFrameSize.y; ++y)
            for (int x = 0; x < kFrameSize.x; ++x) {
                int apart = 0;
                for (int channel = 0; channel < 3; ++channel) {
                    double sum = 0;
                    int least = 255, most = 0;
                    for (int i = 0; i < kFiner * kFiner; ++i) {
                        const int value =
                            fine.at(kFiner * x + i % kFiner, kFiner * y + i / kFiner)[channel];
                        sum += render::linear_from_srgb(static_cast<float>(value) / 255);
                        least = std::min(least, value);
                        most = std::max(most, value);
                    }
                    const auto light = static_cast<float>(sum / (kFiner * kFiner));
                    truth.mean.rgba[4ul * (y * kFrameSize.x + x) + channel] =
                        static_cast<std::uint8_t>(
                            std::lround(255 * render::srgb_from_linear(light)));
                    apart = std::max(apart, most - least);
                }
                edge[y * kFrameSize.x + x] = apart > 96;
            }
        for (int y = 0; y < kFrameSize.y; ++y)
            for (int x = 0; x < kFrameSize.x; ++x)
                for (int j = std::max(0, y - 2); j <= std::min(kFrameSize.y - 1, y + 2); ++j)
                    for (int i = std::max(0, x - 2); i <= std::min(kFrameSize.x - 1, x + 2); ++i)
                        if (edge[j * kFrameSize.x + i])
                            truth.near_edge[y * kFrameSize.x + x] = true;
        return truth;
    }
    /// Share of the pixels near an edge that are off by more than 32 of 255.
    static double share_off(const Image& picture, const Truth& truth) {
        int near = 0, off = 0;
        for (int y = 0; y < kFrameSize.y; ++y)
            for (int x = 0; x < kFrameSize.x; ++x) {
                if (!truth.near_edge[y * kFrameSize.x + x])
                    continue;
                ++near;
                int most = 0;
                for (int channel = 0; channel < 3; ++channel)
                    most = std::max(
                        most, std::abs(picture.at(x, y)[channel] - truth.mean.at(x, y)[channel]));
                off += most > 32 ? 1 : 0;
            }
        EXPECT_GT(near, 500) << "edges";
        return static_cast<double>(off) / near;
    }

    index::TestField waves_;
    TestFolder folder_;
    std::shared_ptr<const index::IndexFile> file_;
    int frame_ = 0;
};

TEST_F(SettledSamplesTest, MakeEdgesAsTrueAsSixteenSamplesDo) {
    for (const NamedView& view : kViews) {
        SCOPED_TRACE(view.name);
        const Truth truth = this->truth(view);
        const auto small = context();
        Session session(config_with(0, 0), file_, *small);
        const Image exact = settle(session, showing(view));
        const double before = share_off(exact, truth);
        const double after = share_off(session.outputs().display().read_window(), truth);
        std::printf("%s: off by more than 32 of 255 near an edge: %.1f %% of the exact picture, "
                    "%.2f %% of the settled one\n",
                    view.name, 100 * before, 100 * after);
        EXPECT_GT(before, 0.05) << "there is something to mend";
        EXPECT_LT(after, 0.02);
    }
}

TEST_F(SettledSamplesTest, ComeBeforeMoreIsPreparedWhereSomebodyAwaitsThePicture) {
    const auto context = this->context();
    Image all;
    {
        Session session(config_with(0, 0), file_, *context);
        settle(session, showing(kViews[1]));
        all = session.outputs().display().read_window();
    }
    Session session(config_with(0, 0), file_, *context);
    session.prepare_first([](float) { return true; }, nullptr);
    settle(session, showing(kViews[1]));
    const auto view = [&] { return session.capture_view(session.log().frames().back()); };
    EXPECT_FALSE(view().is_final()) << "a picture of it would have a sample of each pixel";
    session.set_awaited(true);
    EXPECT_TRUE(test_support::eventually([&] {
        frame(session);
        return view().is_final();
    }));
    EXPECT_TRUE(session.prepares());
    EXPECT_EQ(session.outputs().display().read_window().rgba, all.rgba);
}

TEST_F(SettledSamplesTest, ComeAfterTheExactPictureAndEndWithTheFirstInput) {
    const auto context = this->context();
    Session plain(config_with(0, 1), file_, *context);
    settle(plain, showing(kViews[0]));
    const Image once = plain.outputs().display().read_window();
    Session session(config_with(0, 0), file_, *context);
    EXPECT_EQ(settle(session, showing(kViews[0])).rgba, once.rgba) << "the exact one is the first";
    EXPECT_EQ(session.outputs().in_mean(), kSettledSamples);
    EXPECT_NE(session.outputs().display().read_window().rgba, once.rgba);
    EXPECT_FALSE(session.outlook().busy);

    const Commands moved = showing(kViews[1]);
    frame(session, moved);
    EXPECT_EQ(session.outputs().in_mean(), 0) << "in the frame of the input";
    settle(session, {});
    settle(plain, moved);
    EXPECT_EQ(session.outputs().in_mean(), kSettledSamples);
    EXPECT_NE(session.outputs().display().read_window().rgba,
              plain.outputs().display().read_window().rgba);

    // Whoever chooses the number of samples gets it.
    Session chosen(config_with(1, 0), file_, *context);
    settle(chosen, showing(kViews[0]));
    EXPECT_EQ(chosen.outputs().display().read_window().rgba, once.rgba);
}

class WrittenSamplesTest : public SettledSamplesTest {
  protected:
    /// What P writes.
    Image written(Session& session, const interaction::WrittenPictures& how) {
        Commands commands;
        commands.pictures = how;
        commands.screenshot = true;
        session.outputs().set_screenshots(folder_.path() / std::to_string(++pictures_));
        std::filesystem::create_directories(folder_.path() / std::to_string(pictures_));
        frame(session, commands);
        const auto file = folder_.path() / std::to_string(pictures_) / "isochron_0001.png";
        EXPECT_TRUE(test_support::eventually([&] {
            frame(session);
            session.outputs().pictures().finish();
            return std::filesystem::exists(file);
        }));
        return stereo::read_image(file);
    }
    static interaction::WrittenPictures with(const auto& change) {
        interaction::WrittenPictures how;
        change(how);
        return how;
    }
    int pictures_ = 0;
};

TEST_F(WrittenSamplesTest, AreWhatIsSeen) {
    const auto context = this->context();
    Config config = config_with(0, 0);
    config.start.bounding_box = true;
    Session session(config, file_, *context);
    frame(session, showing(kViews[1]));
    const Image as_seen = written(session, {}); // before anything has settled
    const Image seen = session.outputs().display().read_window();
    EXPECT_EQ(session.outputs().in_mean(), kSettledSamples) << "P waits for it";
    EXPECT_EQ(as_seen.rgba, seen.rgba);

    const Image captioned =
        written(session, with([](auto& how) { how.caption = true; })); // drawn once more
    int same = 0, differ = 0;
    for (int y = 0; y < kFrameSize.y; ++y)
        for (int x = 0; x < kFrameSize.x; ++x)
            ++(std::equal(seen.at(x, y), seen.at(x, y) + 4, captioned.at(x, y)) ? same : differ);
    EXPECT_GT(differ, 50) << "the caption";
    EXPECT_LT(differ, kFrameSize.x * 24) << "and nothing else";
    for (int y = 30; y < kFrameSize.y; ++y)
        for (int x = 0; x < kFrameSize.x; ++x)
            ASSERT_TRUE(std::equal(seen.at(x, y), seen.at(x, y) + 4, captioned.at(x, y)));
}

TEST_F(WrittenSamplesTest, HaveAWhiteBackgroundOrNoneAndTheChosenScale) {
    using interaction::WrittenBackground;
    const auto context = this->context();
    Session session(config_with(0, 0), file_, *context);
    frame(session, showing(kViews[1]));
    const Image seen = written(session, {});
    const Image white =
        written(session, with([](auto& how) { how.background = WrittenBackground::white; }));
    const Image clear =
        written(session, with([](auto& how) { how.background = WrittenBackground::transparent; }));
    int none = 0, part = 0, full = 0;
    for (int y = 0; y < kFrameSize.y; ++y)
        for (int x = 0; x < kFrameSize.x; ++x) {
            const int opacity = clear.at(x, y)[3];
            ++(opacity == 0 ? none : opacity == 255 ? full : part);
            for (int channel = 0; channel < 3; ++channel) {
                const auto light = [&](const Image& image) {
                    return render::linear_from_srgb(static_cast<float>(image.at(x, y)[channel]) /
                                                    255);
                };
                const float share = static_cast<float>(opacity) / 255;
                ASSERT_NEAR(share * light(clear) + 1 - share, light(white), 0.02)
                    << "over white it is the white one, at " << x << ", " << y;
                if (opacity == 255) {
                    ASSERT_NEAR(light(clear), light(seen), 0.02);
                }
                if (opacity == 0) {
                    ASSERT_EQ(white.at(x, y)[channel], 255);
                }
            }
        }
    EXPECT_GT(none, 1000);
    EXPECT_GT(part, 300) << "edges";
    EXPECT_GT(full, 1000);
    const Image large = written(session, with([](auto& how) { how.scale = 2; }));
    EXPECT_EQ(glm::ivec2(large.width, large.height), 2 * kFrameSize);
}

} // namespace
} // namespace isochron::app
