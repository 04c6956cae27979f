// Ghosts as they are drawn: the nearest last wherever they are, each in its color, cut, and hidden by
// what is before them.
#include "render/drawing/ghost_pass.h"
#include "render/drawing/triangle_pass.h"
#include "render/gl/render_target.h"
#include "render/gl/srgb.h"
#include "tests/render/drawing/flat_view.h"
#include "tests/support/drawing/gl_test.h"

#include <glm/gtc/matrix_transform.hpp>

#include <cmath>
#include <functional>

namespace isochron::render {
namespace {

constexpr int kGhostPixels = 100; ///< [pixel] of a picture of 10 x 10 units, seen along -z
constexpr glm::vec3 kGhostRed(1, 0, 0), kGhostGreen(0, 1, 0), kGhostBlue(0, 0, 1);

/// A sheet over [0, 10] x [0, 10] with a height for each x from 0 to 10, in strips one unit wide.
index::CellMeshPtr sheet(const std::function<double(int x)>& height) {
    auto mesh = std::make_shared<index::CellMesh>();
    for (int x = 0; x <= 10; ++x)
        for (const int y : {0, 10}) {
            const double low = std::min(std::floor(height(x)), 9.0);
            mesh->vertices.push_back(
                {static_cast<std::uint16_t>(x), static_cast<std::uint16_t>(y),
                 static_cast<std::uint16_t>(low), 2,
                 static_cast<std::uint32_t>((height(x) - low) * index::MeshVertex::kWhole),
                 index::MeshVertex::kNoNormal});
        }
    for (std::uint32_t x = 0; x < 20; x += 2)
        for (const std::uint32_t corner : {x, x + 1, x + 2, x + 1, x + 3, x + 2})
            mesh->triangles.push_back(corner);
    return mesh;
}

class GhostPassTest : public GlTest {
  protected:
    /// All light is ambient, so that colors are those of the ghosts.
    /// @param wall height of something opaque and white that was drawn before; below 0: nothing was
    Image draw(const std::vector<GhostMesh>& ghosts, float opacity,
               const std::vector<glm::vec4>& cuts = {}, float wall = -1,
               TriangleShare share = TriangleShare::all) {
        const index::Grid grid{.vertices = {11, 11, 11}};
        const Placement placement = Placement::of(grid, glm::dmat4(1.0));
        const View view = flat_view(kGhostPixels);
        const CellAppearance look = flat_light(cuts);
        target_.bind();
        target_.clear({0, 0, 0, 1});
        if (wall >= 0) {
            TrianglePass opaque(gl_, grid);
            auto plate = std::make_shared<index::TriangleMesh>();
            plate->points = {{0, 0, wall}, {10, 0, wall}, {10, 10, wall}, {0, 10, wall}};
            plate->corners = {0, 1, 2, 0, 2, 3};
            const index::TriangleMeshPtr held = plate;
            opaque.hold({&held, 1});
            opaque.draw(view, placement, *held, {}, look);
        }
        pass_.hold(ghosts);
        pass_.draw(view, placement, opacity, look, share);
        return target_.read();
    }
    static glm::vec3 light(const Image& image, double x, double y = 5.2) {
        const auto* at =
            image.at(static_cast<int>(10 * x), kGhostPixels - 1 - static_cast<int>(10 * y));
        return linear_from_srgb(glm::vec3(at[0], at[1], at[2]) / 255.0f);
    }
    static void expect_light(const Image& image, double x, const glm::vec3& expected) {
        EXPECT_LT(glm::distance(light(image, x), expected), 0.03f)
            << x << ": " << light(image, x).x << ' ' << light(image, x).y << ' '
            << light(image, x).z;
    }
    RenderTarget target_{gl_, {kGhostPixels, kGhostPixels}};
    GhostPass pass_{gl_, {.vertices = {11, 11, 11}}};
};

const auto kRising = [](int x) { return double(x); };
const auto kFalling = [](int x) { return 10.0 - x; };
const auto level_at(double height) {
    return [height](int) { return height; };
}

/// Two that cross each other: on each side another one is nearer, in whatever order they are given.
TEST_P(GhostPassTest, CoverEachOtherByDepthAndNotByTheirOrder) {
    const GhostMesh rising{sheet(kRising), kGhostRed}, falling{sheet(kFalling), kGhostGreen};
    for (const bool turned : {false, true}) {
        const Image image =
            draw(turned ? std::vector{falling, rising} : std::vector{rising, falling}, 0.6f);
        for (const double x : {1.2, 3.2})
            expect_light(image, x, 0.6f * kGhostGreen + 0.4f * 0.6f * kGhostRed);
        for (const double x : {6.7, 8.7})
            expect_light(image, x, 0.6f * kGhostRed + 0.4f * 0.6f * kGhostGreen);
    }
}

TEST_P(GhostPassTest, HaveTheirColorsHoweverManyThereAre) {
    constexpr int kMany = 64;
    std::vector<GhostMesh> ghosts;
    const index::CellMeshPtr mesh = sheet(level_at(3));
    for (int i = 0; i < kMany; ++i) // the last one lies above all others
        ghosts.push_back({i + 1 < kMany ? mesh : sheet(level_at(8)), kGhostBlue});
    for (const int picked : {0, 17, kMany - 1}) {
        std::vector<GhostMesh> some = ghosts;
        some[static_cast<std::size_t>(picked)].color = kGhostRed;
        const glm::vec3 seen = light(draw(some, 0.05f), 5.2);
        const double below = picked + 1 < kMany ? 0.5 : 1.0;
        EXPECT_GT(seen.x, picked + 1 < kMany ? 0.0 : 0.04) << picked;
        EXPECT_GT(seen.z, below * 0.5) << picked;
    }
    ghosts.resize(3, {mesh, kGhostBlue});
    ghosts[1].color = kGhostRed;
    ghosts[1].mesh = sheet(level_at(9));
    expect_light(draw(ghosts, 1.0f), 5.2, kGhostRed);
    ghosts[1].color = kGhostGreen; // only the colors are others
    expect_light(draw(ghosts, 1.0f), 5.2, kGhostGreen);
}

TEST_P(GhostPassTest, AreHiddenByWhatIsBeforeThemAndCut) {
    const std::vector<GhostMesh> ghost{{sheet(kRising), kGhostRed}};
    const Image behind = draw(ghost, 0.5f, {}, 5);
    expect_light(behind, 2.2, glm::vec3(1));
    expect_light(behind, 8.2, glm::vec3(1, 0.5, 0.5));
    const Image cut = draw(ghost, 0.5f, {glm::vec4(1, 0, 0, -6)}); // x > 6
    expect_light(cut, 4.2, 0.5f * kGhostRed);
    expect_light(cut, 7.2, glm::vec3(0));
}

/// Beyond the middle of the volume, z = 5, they come before cells that write no depth.
TEST_P(GhostPassTest, DivideIntoSharesAtTheMiddleOfTheVolume) {
    const std::vector<GhostMesh> ghost{{sheet(kRising), kGhostRed}};
    for (const TriangleShare share : {TriangleShare::beyond, TriangleShare::before}) {
        const bool before = share == TriangleShare::before;
        const Image image = draw(ghost, 0.5f, {}, -1, share);
        expect_light(image, 2.2, before ? glm::vec3(0) : 0.5f * kGhostRed);
        expect_light(image, 8.2, before ? 0.5f * kGhostRed : glm::vec3(0));
    }
}

INSTANTIATE_TEST_SUITE_P(, GhostPassTest, both_contexts(), context_name);

} // namespace
} // namespace isochron::render
