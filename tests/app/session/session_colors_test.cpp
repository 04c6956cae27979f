// Surfaces in the colors of a second array and of the time of first crossing.
#include "tests/support/session_fixture.h"

#include <algorithm>
#include <future>

namespace isochron::app {
namespace {

using interaction::ColorBy;
using interaction::Commands;

/// How far along x: another array on the grid and at the times of a volume.
class AlongX final : public index::VolumeSeries {
  public:
    explicit AlongX(const index::SeriesInfo& volume) : info_(volume) { info_.array = "x"; }
    const index::SeriesInfo& info() const override { return info_; }
    void read(std::size_t, std::span<std::byte> out) override {
        for (std::size_t vertex = 0; vertex < info_.grid.vertex_count(); ++vertex) {
            const auto value = static_cast<float>(vertex % info_.grid.vertices[0]);
            std::memcpy(out.data() + vertex * sizeof value, &value, sizeof value);
        }
    }

  private:
    index::SeriesInfo info_;
};

/// How much of a picture shows the ends of the map `polar`, blue over light gray to red.
struct Ends {
    std::size_t blue = 0, red = 0;
    double blue_x = 0, red_x = 0; ///< where they are, on average, in pixels
};

Ends ends_in(const render::Image& image) {
    Ends found;
    for (int y = 0; y < image.height; ++y)
        for (int x = 0; x < image.width; ++x) {
            const std::uint8_t* pixel = image.at(x, y);
            const int excess = pixel[0] - pixel[2];
            if (excess > 25) {
                ++found.red;
                found.red_x += x;
            } else if (excess < -25) {
                ++found.blue;
                found.blue_x += x;
            }
        }
    found.blue_x /= static_cast<double>(std::max(found.blue, std::size_t{1}));
    found.red_x /= static_cast<double>(std::max(found.red, std::size_t{1}));
    return found;
}

class SessionColors : public SessionTest {
  protected:
    SessionColors() {
        MovingSphere volume(kSteps);
        AlongX colors(volume.info());
        build_index(volume, folder_.path() / "colored.isochron", {.color = &colors});
        file_ = index::IndexFile::open(folder_.path() / "colored.isochron");
    }

    static Config without_box() {
        Config config = small_config();
        config.start.bounding_box = false;
        return config;
    }
    static Commands colored(ColorBy by, std::uint32_t step) {
        Commands commands;
        commands.coloring = interaction::Coloring{.by = by, .map = "polar", .range = {}};
        commands.isovalue = 9.0;
        commands.instant = index::Instant(step);
        return commands;
    }
    /// The left eye's picture of the next frame.
    static render::Image picture(Session& session, const Commands& commands,
                                 Waiting waiting = Waiting::for_cells) {
        const auto frame = static_cast<double>(session.log().frames().size());
        session.frame(head_at_rest(frame / 60), commands, waiting);
        return session.outputs().display().read_eye(stereo::Eye::left);
    }

    static constexpr std::size_t kSteps = 6;
};

INSTANTIATE_TEST_SUITE_P(Contexts, SessionColors,
                         testing::Values(stereo::ContextKind::egl, stereo::ContextKind::osmesa),
                         context_name);

TEST_P(SessionColors, BySecondArrayRunThroughTheMapAlongIt) {
    Session session(without_box(), file_, *context_);
    Commands commands = colored(ColorBy::value, 2);
    commands.coloring->range = {7, 21}; // where the sphere is
    render::Image image = picture(session, commands);
    for (int frame = 0; frame < 30; ++frame) { // in quads, and at rest in surfaces
        const Ends ends = ends_in(image);
        ASSERT_GT(ends.blue, 30u) << "frame " << frame;
        ASSERT_GT(ends.red, 30u) << "frame " << frame;
        ASSERT_LT(ends.blue_x, ends.red_x - 5) << "frame " << frame;
        image = picture(session, {});
    }
    EXPECT_EQ(session.log().frames().back().footprint, render::kBestFootprint);
}

TEST_P(SessionColors, BetweenPercentilesFollowTheShownSurface) {
    Session session(without_box(), file_, *context_);
    Commands commands = colored(ColorBy::value, 2);
    const auto all = picture(session, commands);
    commands.coloring->percentiles = {0, 100}; // the sphere's own ends: x is 7 to 21
    const auto between = picture(session, commands);
    EXPECT_NE(between.rgba, all.rgba);
    const Ends ends = ends_in(between);
    EXPECT_GT(ends.blue, 30u);
    EXPECT_GT(ends.red, 30u);
    EXPECT_LT(ends.blue_x, ends.red_x - 5);
    // A step later the sphere is a voxel further on, and so is the range.
    commands.instant = index::Instant(3);
    EXPECT_GT(ends_in(picture(session, commands)).blue, 30u);
    // A range that is given comes first.
    commands.coloring->range = {0, 31};
    commands.instant = index::Instant(2);
    EXPECT_EQ(picture(session, commands).rgba, all.rgba);
}

TEST_P(SessionColors, ByFirstCrossingAreBlueAtFirstAndRedAtLast) {
    Session session(without_box(), file_, *context_);
    const Ends first = ends_in(picture(session, colored(ColorBy::first_crossing, 0)));
    const Ends last = ends_in(picture(session, colored(ColorBy::first_crossing, kSteps - 1)));
    EXPECT_GT(first.blue, 300u);
    EXPECT_EQ(first.red, 0u);
    EXPECT_GT(last.red, 200u);
}

TEST_P(SessionColors, TellSurfacesApartUntilTheWorkerHasTheCoordinates) {
    const index::Extract real = index::extract_from(file_);
    std::promise<void> release;
    const std::shared_future<void> released = release.get_future().share();
    const index::Extract extract = [&](const index::SurfacesQuery& query, std::stop_token stop) {
        if (query.coloring != index::CellColoring::none)
            released.wait();
        return real(query, stop);
    };
    Session session(without_box(), file_, *context_, extract);
    const auto by_surface = picture(session, colored(ColorBy::surface, 2));
    const auto asked = picture(session, colored(ColorBy::first_crossing, 2), Waiting::never);
    EXPECT_EQ(asked.rgba, by_surface.rgba);
    release.set_value();
    EXPECT_NE(picture(session, {}).rgba, by_surface.rgba);
    EXPECT_EQ(picture(session, colored(ColorBy::surface, 2)).rgba, by_surface.rgba);
}

} // namespace
} // namespace isochron::app
