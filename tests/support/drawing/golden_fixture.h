// Fixture of golden pictures: a sphere in its box, and checks that each of its pictures must pass.
#pragma once

#include "tests/support/session_fixture.h"

#include "tests/support/drawing/image_compare.h"
#include "tests/support/drawing/sphere_oracle.h"

#include <string>

namespace isochron::app {

using interaction::Commands;
using render::Footprint;
using render::Image;
using stereo::Eye;
using stereo::StereoMode;
using test_support::Coverage;
using test_support::ImageTolerance;
using test_support::PinholeEye;

constexpr glm::ivec2 kPicture(192, 128);
constexpr std::uint32_t kStep = 3;
constexpr double kOuterRadius = 11.0, kInnerRadius = 6.5; ///< voxels
constexpr double kFromRadius = 16.0; ///< isovalue plus radius of the data's spheres
constexpr int kPerEdge = 24;         ///< checked points per edge of the box
/// Center of the data's sphere, at that step.
inline const glm::dvec3 kSphereCenter(12.0 + kStep, 15.5, 15.5);
constexpr double kBox = 31.0; ///< side of the volume, voxels

/// How far a driver's pictures may be from the golden ones.
/// llvmpipe's: both contexts must give the same, as the same rasterizer draws in both, with the
/// same bytes. With another processor's instructions (SSE4.1 instead of AVX2) single channels round
/// to the next value. But no outline moves, which would change a pixel by a hundred or more.
/// Others': NVIDIA's round by up to 6, in 0.16 on average, and round points end a pixel earlier or
/// later in one place of two thousand.
inline ImageTolerance tolerance_of(const stereo::GlContext& context) {
    if (context.description().find("llvmpipe") != std::string::npos)
        return {.maximum = 12, .mean = 0.01};
    return {.maximum = 160, .mean = 0.2, .strays = 0.001};
}

/// A placement that is rotated so that no edge of the box hides another.
inline interaction::Similarity place_at(glm::dvec3 center, double scale) {
    interaction::Similarity placement;
    placement.scale = scale;
    placement.rotation =
        glm::angleAxis(0.3, glm::dvec3(1, 0, 0)) * glm::angleAxis(0.55, glm::dvec3(0, 1, 0));
    placement.translation =
        center - placement.scale * (placement.rotation * glm::dvec3(0.5 * kBox));
    return placement;
}

inline glm::dvec3 in_room(const interaction::Similarity& placement, glm::dvec3 voxel) {
    return placement.translation + placement.scale * (placement.rotation * voxel);
}

inline Commands showing(const interaction::Similarity& placement) {
    Commands commands;
    commands.room_from_physical = placement;
    commands.isovalue = kFromRadius - kOuterRadius;
    commands.instant = index::Instant(kStep);
    return commands;
}

/// Fixes the settings that depend on whether a GPU draws.
inline void draw_as_in_software(Config& config) {
    config.rendering.samples = 1;
    config.rendering.blending = Blending::display;
}

/// A configuration with one screen that is a little to the side of the viewer.
inline Config one_window(StereoMode mode, glm::ivec2 size = kPicture) {
    Config config = small_config(mode);
    draw_as_in_software(config);
    stereo::Window& window = config.installation.windows.front();
    window.size = size;
    stereo::Screen& screen = window.viewports.front().screen;
    screen = {{-0.7f, 1.05f, -1.2f}, {-0.7f, 2.05f, -1.2f}, {0.8f, 2.05f, -1.2f}, false, false};
    return config;
}
inline const interaction::Similarity kPlacement = place_at({0.12, 1.75, -2.5}, 0.039);

/// Whether a pixel shows the surface, whose color is warm: background, box and numbers are cold.
inline bool warm(const std::uint8_t* pixel) {
    return pixel[0] > pixel[2] + 12;
}

inline Coverage warm_part(const Image& image) {
    return test_support::coverage({image.width, image.height},
                                  [&](int x, int y) { return warm(image.at(x, y)); });
}

/// The pixels that a sphere of the data should cover.
/// @param radius voxels
inline Coverage expected_part(const PinholeEye& eye, const interaction::Similarity& placement,
                              double radius) {
    return test_support::expected_coverage(eye, in_room(placement, kSphereCenter),
                                           placement.scale * radius);
}

class GoldenPictures : public testing::TestWithParam<stereo::ContextKind> {
  protected:
    /// Draws frames until the picture does not change any more. @return the last footprint
    Footprint settle(Session& session, const Commands& commands, const interaction::Pose& head) {
        Commands now = commands;
        for (int frame = 0; frame < 30; ++frame, ++frame_, now = {}) {
            interaction::InputState input = head_at_rest(frame_ / 60.0);
            input.devices.front().pose = head;
            if (session.frame(input, now, Waiting::for_cells).final)
                break;
        }
        return session.log().frames().back().footprint;
    }
    Footprint settle(Session& session, const Commands& commands) {
        return settle(session, commands, *head_at_rest(0).devices.front().pose);
    }
    PinholeEye before_window(const Session& session, Eye eye, glm::ivec2 picture) const {
        return {session.outputs().display().window().viewports.front().screen,
                *head_at_rest(0).devices.front().pose, eye, session.state().eye_separation,
                picture};
    }

    const ImageTolerance tolerance_ =
        tolerance_of(*stereo::make_context(GetParam(), {.size = kPicture}));
    TestFolder folder_;
    std::shared_ptr<const index::IndexFile> file_ = build_sphere(folder_.path());
    int frame_ = 0;
};

/// Expects the sphere's place and size to be right, within the precision of pixels.
/// @param swelling share of the sphere's area by which the footprint may be larger
inline void expect_sphere(const Coverage& actual, const Coverage& expected, double swelling) {
    EXPECT_NEAR(actual.center.x, expected.center.x, 0.5);
    EXPECT_NEAR(actual.center.y, expected.center.y, 0.5);
    EXPECT_GT(actual.pixels, 0.97 * expected.pixels);
    EXPECT_LT(actual.pixels, (1.03 + swelling) * expected.pixels);
}

/// Whether one of the four pixels around a place differs from the background. Lines have blunt
/// ends, so a corner itself may lie between them.
inline bool drawn_at(const Image& image, glm::dvec2 place, glm::ivec3 background) {
    const glm::ivec2 first(glm::floor(place - 0.5));
    for (const glm::ivec2 step : {glm::ivec2(0, 0), {1, 0}, {0, 1}, {1, 1}}) {
        const glm::ivec2 at =
            glm::clamp(first + step, glm::ivec2(0), glm::ivec2(image.width, image.height) - 1);
        const std::uint8_t* pixel = image.at(at.x, at.y);
        if (glm::ivec3(pixel[0], pixel[1], pixel[2]) != background)
            return true;
    }
    return false;
}

/// Expects every edge of the box, with its corners, to be drawn at the right place.
/// @return number of checked points that are in the picture
inline int expect_box(const Image& image, const PinholeEye& eye,
                      const interaction::Similarity& placement) {
    const glm::ivec3 background(glm::round(255.0f * Config().rendering.background));
    int seen = 0, missing = 0;
    for (const glm::dvec3& point : test_support::points_on_edges(kBox, kPerEdge))
        if (const auto at = eye.pixel_of(in_room(placement, point))) {
            ++seen;
            missing += !drawn_at(image, *at, background);
        }
    EXPECT_EQ(missing, 0) << "of " << seen << " points on the box's edges";
    return seen;
}

} // namespace isochron::app
