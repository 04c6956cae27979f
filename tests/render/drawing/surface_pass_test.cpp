// Surfaces in several views, translucent ones, and normals across the borders of cells.
#include "render/gl/driver.h"
#include "render/gl/render_target.h"
#include "tests/render/cells/surface_agreement.h"
#include "tests/support/test_field.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace isochron::render {
namespace {

using index::TestField;
using index::ValueType;

class SurfacePasses : public SurfaceTest {
  protected:
    const TestField smooth_{{24, 20, 22}, 1, ValueType::f32, index::turbulence(random_, 24)};
    const VertexField field_{smooth_.view(), {index::Instant(0), 0.03}};
    const Placement placement_ = placed_at_origin(smooth_.view().grid);

    /// Side by side in one target, of two sizes and off its corner.
    std::array<View, 2> two_views() const {
        std::array<View, 2> views{perspective_view({-0.3f, 0.4f, 2.0f}),
                                  perspective_view({0.3f, 0.4f, 2.0f})};
        views[0].corner = {7, 12};
        views[1].corner = {175, 3};
        views[1].size = {133, 149};
        return views;
    }
    static CellAppearance of_opacity(float opacity) {
        CellAppearance appearance;
        appearance.surfaces[0].opacity = opacity;
        return appearance;
    }
    static constexpr glm::ivec2 kTarget{320, 180};
};

TEST_P(SurfacePasses, TwoViewsInOnePassLookAsInTwo) {
    const std::array<View, 2> views = two_views();
    for (const float opacity : {1.0f, 0.5f}) {
        const CellAppearance appearance = of_opacity(opacity);
        CellPass apart_pass = normals_pass();
        apart_pass.draw_views_apart();
        const SurfacePicture once = draw(field_, placement_, views, kTarget, appearance);
        const SurfacePicture apart =
            draw(apart_pass, field_, placement_, views, kTarget, appearance);
        int covered = 0, different = 0;
        for (std::size_t i = 0; i < once.depths.size(); ++i) {
            covered += once.normals[i].w > 0.0f;
            different += std::abs(once.depths[i] - apart.depths[i]) > 1e-6f ||
                         glm::length(once.normals[i] - apart.normals[i]) > 1e-4f;
        }
        EXPECT_GT(covered, 10000);
        EXPECT_LE(different, 1e-4 * covered);
    }
}

TEST_P(SurfacePasses, EveryViewportShowsWhatItsEyeSeesAndNothingIsDrawnBeside) {
    const std::array<View, 2> views = two_views();
    const SurfacePicture picture = draw(field_, placement_, views, kTarget);
    int covered = 0, hit = 0;
    for (const glm::vec4& normal : picture.normals)
        covered += normal.w > 0.0f;
    for (const View& view : views) {
        const Agreement agreement = compare(picture, field_, view, placement_);
        EXPECT_LE(agreement.hit_by_one, 2 + 1e-4 * agreement.hit);
        EXPECT_LE(Agreement::percentile(agreement.depth_errors, 0.999), 0.02);
        hit += agreement.hit;
    }
    EXPECT_NEAR(covered, hit, 4 + 1e-4 * hit);
}

TEST_P(SurfacePasses, EverySampleOfAPixelHasARayOfItsOwn) {
    const int samples = std::min(4, max_samples(gl_));
    ASSERT_GE(samples, 4) << "a GL 4.5 has as many";
    CellBuffers cells(gl_, field_.values().grid);
    const index::ExtractionPtr active =
        Extractions(field_.values()).active(field_.query().instant.step, {field_.query().isovalue});
    while (cells.shown() != active)
        cells.upload(active, std::size_t{1} << 30);
    cells.compute_corners();
    CellPass pass(gl_);
    constexpr int kFiner = 4;
    // How much of a pixel the surface covers is its alpha.
    const auto coverage = [&](int finer, int of_pixel) {
        View view = perspective_view({-0.3f, 0.4f, 2.0f});
        view.size *= finer;
        const RenderTarget target(gl_, view.size, of_pixel);
        target.bind();
        target.clear(glm::vec4(0.0f));
        pass.draw(std::span(&view, 1), placement_, cells, Footprint::surface);
        target.resolve();
        return target.read();
    };
    const Image fine = coverage(kFiner, 1), one = coverage(1, 1), many = coverage(1, samples);
    double error_of_one = 0, error_of_many = 0;
    int edges = 0;
    for (int y = 0; y < one.height; ++y)
        for (int x = 0; x < one.width; ++x) {
            double truth = 0;
            for (int v = 0; v < kFiner; ++v)
                for (int u = 0; u < kFiner; ++u)
                    truth += fine.at(x * kFiner + u, y * kFiner + v)[3] / 255.0;
            truth /= kFiner * kFiner;
            if (truth < 0.1 || truth > 0.9)
                continue;
            ++edges;
            error_of_one += std::abs(one.at(x, y)[3] / 255.0 - truth);
            error_of_many += std::abs(many.at(x, y)[3] / 255.0 - truth);
        }
    EXPECT_GT(edges, 300);
    EXPECT_GT(error_of_one / edges, 0.2); // it is there or not
    EXPECT_LT(error_of_many / edges, 0.1);
}

TEST_P(SurfacePasses, ATransparentSurfaceShowsEveryLayerFarToNear) {
    // Coarse noise: rays cross it up to three times within a cell.
    const TestField noise({7, 7, 7}, 1, ValueType::f32, index::white_noise(random_));
    const VertexField field(noise.view(), {index::Instant(0), 0.1});
    const Placement placement = placed_at_origin(noise.view().grid);
    const View view = perspective_view({1.1f, 0.9f, 1.5f});
    constexpr float kOpacity = 0.4f;
    const SurfacePicture picture =
        draw(field, placement, std::span(&view, 1), view.size, of_opacity(kOpacity));
    const ReferenceRayCaster reference(field, view, placement);
    int seen = 0, wrong_alpha = 0, wrong_order = 0, within_a_cell = 0;
    for (int y = 0; y < view.size.y; ++y)
        for (int x = 0; x < view.size.x; ++x) {
            const glm::dvec2 pixel(x + 0.5, y + 0.5);
            const std::vector<RayHit> hits = reference.hits(pixel);
            const glm::dvec3 along =
                glm::normalize(reference.point(pixel, 1.0) - reference.point(pixel, 0.0));
            glm::dvec3 color(0.0);
            double through = 1.0;
            for (std::size_t i = 0; i < hits.size(); ++i) {
                const double facing = std::abs(glm::dot(glm::normalize(hits[i].normal), along));
                // Towards its rim a layer covers as up to seven would.
                const double left = std::pow(1.0 - kOpacity, 1.0 + 6.0 * std::pow(1.0 - facing, 3));
                color += through * (1.0 - left) * hits[i].normal;
                through *= left;
                within_a_cell += i > 0 && hits[i].cell == hits[i - 1].cell;
            }
            seen += !hits.empty();
            const double alpha = picture.normals[picture.index(x, y)].w;
            wrong_alpha += std::abs(alpha - (1.0 - through)) > 1e-3;
            // The scale of the gradients is the buffers' own.
            const glm::dvec3 drawn = picture.normal(x, y);
            const double lengths = glm::length(drawn) * glm::length(color);
            wrong_order += lengths > 1e-6 && glm::dot(drawn, color) < std::cos(0.02) * lengths;
        }
    EXPECT_GT(seen, 5000);
    EXPECT_GT(within_a_cell, 500);
    EXPECT_LE(wrong_alpha, 1e-3 * seen);
    EXPECT_LE(wrong_order, 3e-3 * seen);
    EXPECT_TRUE(std::all_of(picture.depths.begin(), picture.depths.end(),
                            [](float depth) { return depth == 1.0f; })); // blends, hides nothing
}

TEST_P(SurfacePasses, MoreCellsThanHaveCornersAtATimeAreAllWhereTheyBelong) {
    const TestField sheet({400, 300, 2}, 1, ValueType::u8, index::white_noise(random_));
    const VertexField field(sheet.view(), {index::Instant(0), 0.01});
    const Placement placement = placed_at_origin(sheet.view().grid);
    CellBuffers cells(gl_, field.values().grid);
    const index::ExtractionPtr active = Extractions(field.values()).active(0, {0.01});
    ASSERT_GT(active->cells(), CornerWindow::kCells);
    cells.upload(active, std::numeric_limits<std::size_t>::max());
    View view = perspective_view({0.1f, 0.05f, 1.2f});
    view.size = {640, 480};
    const SurfacePicture picture = draw(field, placement, view);
    const Agreement agreement = compare(picture, field, view, placement);
    EXPECT_GT(agreement.hit, 40'000);
    EXPECT_LE(agreement.hit_by_one, 1e-3 * agreement.hit);
    EXPECT_LE(Agreement::percentile(agreement.depth_errors, 0.99), 0.02);
    CellPass pass(gl_);
    const auto drawn = [&](std::size_t together) {
        const RenderTarget target(gl_, view.size);
        target.bind();
        target.clear(glm::vec4(0.0f));
        const std::size_t work = pass.work(1, cells, Footprint::surface, {});
        for (std::size_t done = 0; done < work;)
            done += pass.draw(std::span(&view, 1), placement, cells, Footprint::surface, {},
                              {done, together});
        return target.read().rgba;
    };
    EXPECT_TRUE(drawn(cells.size()) == drawn(9'999));
}

TEST_P(SurfacePasses, AnOpaqueSurfaceIsSeenThroughAnotherThatSharesItsCells) {
    // Two levels of a slope, 0.4 voxels apart in the same layer of cells.
    const TestField slope({12, 12, 12}, 1, ValueType::f32,
                          [](double, double, double z, double) { return z; });
    const index::StepValues values = slope.view();
    Extractions extractions(values);
    CellBuffers cells(gl_, values.grid);
    cells.upload(extractions.active(0, {5.3, 5.7}), std::numeric_limits<std::size_t>::max());
    cells.compute_corners();
    const Placement placement = placed_at_origin(values.grid);
    CellAppearance look;
    look.depth_cue = look.outline = look.reflectance = 0.0f;
    look.linear_light = false;
    look.surfaces[0].color = {1, 0, 0};
    look.surfaces[1].color = {0, 1, 0};
    CellPass pass(gl_);
    RenderTarget target(gl_, {160, 160});
    for (const bool near_is_clear : {true, false}) {
        look.surfaces[1].opacity = 0.5f;
        const View view = perspective_view({0, 0, near_is_clear ? 3.0f : -3.0f});
        target.bind();
        target.clear({0, 0, 0, 1});
        pass.draw(view, placement, cells, Footprint::surface, look);
        const Image image = target.read();
        for (int y = 65; y < 95; ++y)
            for (int x = 65; x < 95; ++x) {
                ASSERT_GT(image.at(x, y)[0], 40) << x << ", " << y;
                ASSERT_EQ(image.at(x, y)[1] > 40, near_is_clear) << x << ", " << y;
            }
    }
}

TEST_P(SurfacePasses, NormalsRunOnAcrossTheBordersOfCells) {
    const TestField sphere({40, 38, 41}, 1, ValueType::f32, index::moving_sphere);
    const VertexField field(sphere.view(), {index::Instant(0), 100.5});
    const Placement placement = placed_at_origin(sphere.view().grid);
    View view = perspective_view({0.3f, 0.2f, 1.5f});
    const SurfacePicture picture = draw(field, placement, view);
    const ReferenceRayCaster reference(field, view, placement);
    const glm::dvec3 eye(glm::inverse(placement.room_from_index) *
                         glm::vec4(view.eye_in_room(), 1.0f));
    double within = 0.0, across = 0.0; // largest turn of the normal from pixel to pixel
    int borders = 0;
    for (int y = 0; y < view.size.y; ++y)
        for (int x = 0; x + 1 < view.size.x; ++x) {
            if (!picture.covered(x, y) || !picture.covered(x + 1, y))
                continue;
            const auto a = reference.first_hit({x + 0.5, y + 0.5});
            const auto b = reference.first_hit({x + 1.5, y + 0.5});
            const glm::dvec3 n = glm::normalize(picture.normal(x, y));
            if (!a || !b || glm::dot(n, glm::normalize(eye - a->at)) < 0.5)
                continue; // the silhouette turns away as fast as it likes
            const double turn = glm::length(n - glm::normalize(picture.normal(x + 1, y)));
            double& largest = a->cell == b->cell ? within : across;
            largest = std::max(largest, turn);
            borders += a->cell != b->cell;
        }
    EXPECT_GT(borders, 1000);
    EXPECT_GT(within, 0.0);
    EXPECT_LT(across, 1.5 * within);
}

TEST_P(SurfacePasses, NormalsBesideMissingValuesAreNumbers) {
    TestField gaps({16, 16, 16}, 1, ValueType::f32, index::turbulence(random_, 24));
    for (int i = 0; i < 40; ++i)
        gaps.at<float>(0, random_() % 4096) = std::numeric_limits<float>::quiet_NaN();
    const SurfacePicture picture =
        draw(VertexField(gaps.view(), {index::Instant(0), 0.03}),
             placed_at_origin(gaps.view().grid), perspective_view({0.8f, 0.7f, 1.5f}));
    int covered = 0;
    for (const glm::vec4& normal : picture.normals) {
        covered += normal.w > 0.0f;
        ASSERT_TRUE(std::isfinite(glm::dot(normal, normal)));
    }
    EXPECT_GT(covered, 3000);
}

INSTANTIATE_TEST_SUITE_P(, SurfacePasses, both_contexts(), context_name);

} // namespace
} // namespace isochron::render
