// Pictures of a sphere, compared with golden pictures and with geometry.
#include "render/gl/driver.h"
#include "tests/support/drawing/golden_fixture.h"

#include "stereo/windows.h"

#include <map>

namespace isochron::app {
namespace {

INSTANTIATE_TEST_SUITE_P(, GoldenPictures,
                         testing::Values(stereo::ContextKind::egl, stereo::ContextKind::osmesa),
                         context_name);

TEST_P(GoldenPictures, EveryFootprintToEveryEye) {
    struct Case {
        Footprint footprint;
        const char* name;
        double swelling; ///< voxels reach beyond the surface, their splats by up to two voxels
        render::CellShape shape = render::CellShape::plane;
    };
    constexpr auto kVoxel = render::CellShape::voxel;
    for (const Case& one :
         {Case{Footprint::quad, "quad", 0.05}, Case{Footprint::gaussian, "gaussian", 0.1},
          Case{Footprint::mesh, "mesh", 0.0}, Case{Footprint::surface, "surface", 0.0},
          Case{Footprint::quad, "voxel_quad", 0.3, kVoxel},
          Case{Footprint::gaussian, "voxel_gaussian", 0.42, kVoxel}}) {
        SCOPED_TRACE(one.name);
        Config config = one_window(StereoMode::quadbuffer);
        config.quality.settled = one.footprint;
        config.rendering.cell_shape = one.shape;
        const auto context = stereo::make_context(GetParam(), {.size = kPicture});
        // No meshes are made where a GPU draws, and the exact surface stands for them.
        if (one.footprint == Footprint::mesh &&
            !render::is_drawn_for_processor(render::Gl(context->loader())))
            continue;
        Session session(config, file_, *context);
        Commands commands = showing(kPlacement);
        if (one.footprint == Footprint::quad)
            commands.quality = interaction::QualityMode::fast;
        ASSERT_EQ(settle(session, commands), one.footprint);
        std::map<Eye, Image> pictures;
        for (const Eye eye : {Eye::left, Eye::right})
            pictures[eye] = session.outputs().display().read_eye(eye);
        Commands mono;
        mono.stereo = "mono";
        ASSERT_EQ(settle(session, mono), one.footprint);
        pictures[Eye::center] = session.outputs().display().read_eye(Eye::center);
        std::map<Eye, double> expected_x, actual_x;
        for (const auto& [eye, picture] : pictures) {
            const std::string name = std::string(one.name) + "_" + std::string(name_of(eye));
            SCOPED_TRACE(name);
            EXPECT_TRUE(matches_golden(picture, name, tolerance_));
            const PinholeEye pinhole = before_window(session, eye, kPicture);
            const Coverage actual = warm_part(picture);
            const Coverage expected = expected_part(pinhole, kPlacement, kOuterRadius);
            expect_sphere(actual, expected, one.swelling);
            EXPECT_EQ(expect_box(picture, pinhole, kPlacement), 12 * kPerEdge);
            actual_x[eye] = actual.center.x;
            expected_x[eye] = expected.center.x;
        }
        const double disparity = expected_x[Eye::right] - expected_x[Eye::left];
        EXPECT_GT(disparity, 3.0) << "the sphere stands behind the screen";
        EXPECT_NEAR(actual_x[Eye::right] - actual_x[Eye::left], disparity, 0.5);
    }
}

TEST_P(GoldenPictures, ThePapersModeEndsAtSplats) {
    const auto context = stereo::make_context(GetParam(), {.size = kPicture});
    Session session(one_window(StereoMode::quadbuffer), file_, *context);
    Commands commands = showing(kPlacement);
    commands.quality = interaction::QualityMode::paper;
    ASSERT_EQ(settle(session, commands), Footprint::gaussian);
    for (const Eye eye : {Eye::left, Eye::right})
        EXPECT_TRUE(matches_golden(session.outputs().display().read_eye(eye),
                                   "gaussian_" + std::string(name_of(eye)), tolerance_));
}

/// Whether the inner one of two surfaces is seen: the background has less blue, and the outer, which is
/// warm, less blue than green.
bool blue(const std::uint8_t* pixel) {
    return pixel[2] > 45 && pixel[2] > pixel[1];
}

TEST_P(GoldenPictures, TwoSurfacesThatLetLightThroughToEitherEye) {
    constexpr glm::ivec2 kAboveLegend(kPicture.x, 84);
    Config config = one_window(StereoMode::quadbuffer);
    config.quality.settled = Footprint::surface;
    const auto context = stereo::make_context(GetParam(), {.size = kPicture});
    Session session(config, file_, *context);
    Commands commands = showing(kPlacement);
    commands.isovalue.reset();
    commands.bounding_box = false;
    commands.isosurfaces = {{kFromRadius - kOuterRadius, {0.95f, 0.60f, 0.20f}, 0.35f},
                            {kFromRadius - kInnerRadius, {0.15f, 0.45f, 1.00f}, 0.9f}};
    commands.picked = 0;
    ASSERT_EQ(settle(session, commands), Footprint::surface);
    for (const Eye eye : {Eye::left, Eye::right}) {
        const std::string name = "two_surfaces_" + std::string(name_of(eye));
        SCOPED_TRACE(name);
        const Image picture = session.outputs().display().read_eye(eye);
        EXPECT_TRUE(matches_golden(picture, name, tolerance_));
        const PinholeEye pinhole = before_window(session, eye, kPicture);
        const auto part = [&](bool (*belongs)(const std::uint8_t*)) {
            return test_support::coverage(kAboveLegend,
                                          [&](int x, int y) { return belongs(picture.at(x, y)); });
        };
        expect_sphere(part(warm), expected_part(pinhole, kPlacement, kOuterRadius), 0.0);
        expect_sphere(part(blue), expected_part(pinhole, kPlacement, kInnerRadius), 0.0);
    }
}

TEST_P(GoldenPictures, AxesWithNumbersToEitherEye) {
    constexpr glm::ivec2 kLarger(288, 192);
    Config config = one_window(StereoMode::quadbuffer, kLarger);
    config.quality.settled = Footprint::surface;
    const auto context = stereo::make_context(GetParam(), {.size = kLarger});
    Session session(config, file_, *context);
    const interaction::Similarity placement = place_at({0.12, 1.75, -2.9}, 0.035);
    Commands commands = showing(placement);
    commands.isovalue = kFromRadius - 4.0;
    ASSERT_EQ(settle(session, commands), Footprint::surface);
    for (const Eye eye : {Eye::left, Eye::right}) {
        const std::string name = "axes_" + std::string(name_of(eye));
        SCOPED_TRACE(name);
        const Image picture = session.outputs().display().read_eye(eye);
        EXPECT_TRUE(matches_golden(picture, name, tolerance_));
        EXPECT_EQ(expect_box(picture, before_window(session, eye, kLarger), placement),
                  12 * kPerEdge);
    }
}

/// The sphere hangs in the corner of the walls, so that every one of them shows a part of it.
TEST_P(GoldenPictures, EveryWallOfACaveToEitherEye) {
    constexpr glm::ivec2 kWall(96, 96);
    Config config = read_config("cave4");
    draw_as_in_software(config);
    config.quality.settled = Footprint::surface;
    config.comfort.near_fade = {}; // the sphere comes within reach
    for (stereo::Window& window : config.installation.windows) {
        window.size = kWall;
        window.viewports.front().position = {0, 0};
        window.viewports.front().size = {1, 1};
    }
    const interaction::Pose head{{0.1f, 1.65f, 0.35f},
                                 glm::angleAxis(0.3f, glm::vec3(0.2f, 0.97f, 0.1f))};
    const interaction::Similarity placement = place_at({0.05, 1.15, -0.5}, 0.065);
    Session session(config, file_, stereo::open_windows(GetParam(), config.installation, {}));
    ASSERT_EQ(settle(session, showing(placement), head), Footprint::surface);
    ASSERT_EQ(session.outputs().displays(), 4u);
    for (std::size_t wall = 0; wall < session.outputs().displays(); ++wall)
        for (const Eye eye : {Eye::left, Eye::right}) {
            const stereo::Window& window = config.installation.windows[wall];
            const std::string name = "cave_" + window.name + "_" + std::string(name_of(eye));
            SCOPED_TRACE(name);
            const Image picture = session.outputs().display(wall).read_eye(eye);
            EXPECT_TRUE(matches_golden(picture, name, tolerance_));
            const PinholeEye pinhole(window.viewports.front().screen, head, eye,
                                     session.state().eye_separation, kWall);
            expect_sphere(warm_part(picture), expected_part(pinhole, placement, kOuterRadius), 0.0);
            EXPECT_GT(expect_box(picture, pinhole, placement), kPerEdge);
        }
}

} // namespace
} // namespace isochron::app
