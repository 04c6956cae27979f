// The box's edges in front of the cells are translucent, and no edge behind the cells shows.
#include "tests/support/drawing/golden_fixture.h"

#include "render/gl/srgb.h"

#include <glm/geometric.hpp>

#include <array>

namespace isochron::app {
namespace {

class BoxBeforeCells : public GoldenPictures {};
INSTANTIATE_TEST_SUITE_P(, BoxBeforeCells,
                         testing::Values(stereo::ContextKind::egl, stereo::ContextKind::osmesa),
                         context_name);

glm::dvec3 light_of(const std::uint8_t* pixel) {
    return glm::dvec3(render::linear_from_srgb(glm::vec3(pixel[0], pixel[1], pixel[2]) / 255.0f));
}

/// How far a pixel is from one that shows the line over what is there without it, with whatever
/// share of the pixel the line covers; 0 to 255, of the channel that is farthest.
double beside_blend(const std::uint8_t* with, const std::uint8_t* without) {
    constexpr double kOpacity = 0.55;
    const glm::dvec3 line(render::linear_from_srgb(glm::vec3(0.45f, 0.50f, 0.56f)));
    const glm::dvec3 below = light_of(without), seen = light_of(with);
    double best = 255.0;
    for (int percent = 0; percent <= 100; ++percent) {
        const glm::dvec3 blend = glm::mix(below, line, kOpacity * percent / 100.0);
        double worst = 0.0;
        for (int channel = 0; channel < 3; ++channel)
            worst = std::max(
                worst, 255.0 * std::abs(double(render::srgb_from_linear(float(blend[channel]))) -
                                        double(render::srgb_from_linear(float(seen[channel])))));
        best = std::min(best, worst);
    }
    return best;
}

/// Whether the straight way from the eye to a point of the box, both in voxels, leads through it.
bool through_box(const glm::dvec3& eye, const glm::dvec3& point) {
    for (int step = 1; step < 400; ++step) {
        const glm::dvec3 at = glm::mix(point, eye, step / 400.0);
        if (at.x > 1e-3 && at.y > 1e-3 && at.z > 1e-3 && at.x < kBox - 1e-3 && at.y < kBox - 1e-3 &&
            at.z < kBox - 1e-3)
            return true;
    }
    return false;
}

/// Pixels where a part of the box's edges appears that nothing inside the box hides.
std::vector<glm::dvec2> near_edges(const PinholeEye& pinhole, const glm::dvec3& eye,
                                   const interaction::Similarity& placement) {
    const glm::dvec3 eye_in_box =
        glm::inverse(placement.rotation) * (eye - placement.translation) / placement.scale;
    std::vector<glm::dvec2> pixels;
    for (const glm::dvec3& point : test_support::points_on_edges(kBox, 400))
        if (!through_box(eye_in_box, point))
            if (const auto pixel = pinhole.pixel_of(in_room(placement, point)))
                pixels.push_back(*pixel);
    return pixels;
}

TEST_P(BoxBeforeCells, BlendsWithEveryFootprint) {
    const interaction::Pose head = *head_at_rest(0).devices.front().pose;
    for (const Footprint footprint : {Footprint::quad, Footprint::gaussian, Footprint::surface}) {
        SCOPED_TRACE(name_of(footprint));
        Config config = one_window(StereoMode::mono);
        config.quality.settled = footprint;
        const auto context = stereo::make_context(GetParam(), {.size = kPicture});
        Session session(config, file_, *context);
        Commands commands = showing(kPlacement);
        if (footprint == Footprint::quad)
            commands.quality = interaction::QualityMode::fast;
        ASSERT_EQ(settle(session, commands), footprint);
        const Image with = session.outputs().display().read_eye(Eye::center);
        Commands bare;
        bare.bounding_box = false;
        ASSERT_EQ(settle(session, bare), footprint);
        const Image without = session.outputs().display().read_eye(Eye::center);

        const PinholeEye pinhole = before_window(session, Eye::center, kPicture);
        const auto edges = near_edges(pinhole, glm::dvec3(head.position), kPlacement);
        int before_cells = 0;
        for (int y = 0; y < with.height; ++y)
            for (int x = 0; x < with.width; ++x) {
                const std::uint8_t* pixel = with.at(x, y);
                const std::uint8_t* below = without.at(x, y);
                if (std::equal(pixel, pixel + 3, below) || below[0] < 120)
                    continue; // no line, or none before the sphere
                ++before_cells;
                EXPECT_LT(beside_blend(pixel, below), 4.0) << x << ' ' << y;
                // The rims of splats let far edges shine through.
                EXPECT_TRUE(footprint == Footprint::gaussian ||
                            std::ranges::any_of(
                                edges,
                                [&](const glm::dvec2& edge) {
                                    return glm::distance(edge, glm::dvec2(x + 0.5, y + 0.5)) < 2.0;
                                }))
                    << "a far edge shows through at " << x << ' ' << y;
            }
        EXPECT_GT(before_cells, 40) << "an edge crosses the sphere";
    }
}

} // namespace
} // namespace isochron::app
