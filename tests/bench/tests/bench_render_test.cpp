// What the rendering benchmark draws and measures is what it says.
#include "index/error.h"
#include "index/extraction/extractor.h"
#include "render/drawing/cell_pass.h"
#include "render/gl/render_target.h"
#include "tests/bench/measures/child.h"
#include "tests/bench/measures/data_sets.h"
#include "tests/bench/measures/render_camera.h"
#include "tests/bench/measures/render_measure.h"
#include "tests/bench/rivals/bare_quads.h"
#include "tests/bench/rivals/vtk_scene.h"
#include "tests/support/test_folder.h"

#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <gmock/gmock.h>

#include <cmath>
#include <csignal>
#include <numeric>
#include <poll.h>
#include <unistd.h>

namespace isochron::bench {
namespace {

using render::Footprint;

class BenchRender : public testing::Test {
  protected:
    BenchRender() {
        const DataSet data = data_set("sphere-25", index::ValueType::u8, 2);
        file_ =
            build_file(data, folder_.path() / "sphere.isochron", [](std::string_view, double) {});
        context_ = stereo::make_context(stereo::ContextKind::egl, {.size = {16, 16}});
        gl_ = std::make_unique<render::Gl>(context_->loader());
        set_ = index::extract_from(file_)({index::Instant(0), {112.5}}, {});
    }
    test_support::TestFolder folder_;
    std::shared_ptr<const index::IndexFile> file_;
    std::unique_ptr<stereo::GlContext> context_;
    std::unique_ptr<render::Gl> gl_;
    render::CellBuffers shown() const {
        render::CellBuffers cells(*gl_, file_->info().grid);
        while (cells.shown() != set_)
            cells.upload(set_, std::size_t{1} << 30);
        return cells;
    }
    index::ExtractionPtr set_;
};

double covered(const render::Image& image) {
    std::size_t lit = 0;
    for (std::size_t i = 3; i < image.rgba.size(); i += 4)
        lit += image.rgba[i] > 0;
    return static_cast<double>(4 * lit) / static_cast<double>(image.rgba.size());
}

TEST_F(BenchRender, TheBoundingSphereTouchesThePicture) {
    for (const int eyes : {1, 2}) {
        const BenchCamera camera = bench_camera(file_->info(), 200, eyes);
        ASSERT_EQ(camera.views.size(), std::size_t(eyes));
        const glm::vec3 extent = camera.placement.extent;
        for (const render::View& view : camera.views) {
            const glm::mat4 eye_from_index = view.eye_from_room * camera.placement.room_from_index;
            const glm::vec3 center(eye_from_index * glm::vec4(0.5f * extent, 1.0f));
            const float radius =
                glm::distance(center, glm::vec3(eye_from_index * glm::vec4(extent, 1.0f)));
            // Seen from straight ahead: the sine of the half angle.
            EXPECT_NEAR(radius / -center.z, std::sin(glm::radians(22.5f)), 1e-4f);
            const glm::vec4 middle = view.clip_from_eye * glm::vec4(center, 1.0f);
            EXPECT_NEAR(middle.x / middle.w, 0.0f, 1e-5f) << "zero parallax";
            EXPECT_NEAR(middle.y / middle.w, 0.0f, 1e-5f);
        }
    }
}

TEST_F(BenchRender, BareQuadsLieWhereTheFootprintsAre) {
    const BenchCamera camera = bench_camera(file_->info(), 256, 2);
    render::RenderTarget target(*gl_, {512, 256});
    render::CellPass pass(*gl_, {.shape = render::CellShape::voxel});
    pass.draw_without_points();
    const render::CellBuffers cells = shown();
    target.bind();
    target.clear({0, 0, 0, 0});
    pass.draw(camera.views, camera.placement, cells, Footprint::quad);
    const render::Image footprints = target.read();
    BareQuads bare(*gl_);
    for (std::size_t i = 0; i < 2; ++i)
        bare.set(i, projected_corners(camera.views[i], camera.placement,
                                      0.5f * render::FootprintShapes{}.quad_diameter,
                                      cells.slots().places, {}));
    target.clear({0, 0, 0, 0});
    bare.draw(camera.views, false);
    const render::Image quads = target.read();
    EXPECT_GT(covered(footprints), 0.05);
    int different = 0;
    for (std::size_t i = 3; i < quads.rgba.size(); i += 4)
        different += (quads.rgba[i] > 0) != (footprints.rgba[i] > 0);
    EXPECT_LT(different, 100) << "of 131,072 pixels";
}

TEST_F(BenchRender, VtkDrawsTheSameSurfaceInTheSameContext) {
    for (const int eyes : {1, 2}) {
        const BenchCamera camera = bench_camera(file_->info(), 256, eyes);
        const auto scene = vtk_scene(file_->values(), camera.poses, 256, 2);
        scene->draw({index::Instant(0), 112.5});
        render::RenderTarget target(*gl_, {256 * eyes, 256});
        render::CellPass pass(*gl_);
        const render::CellBuffers cells = shown();
        gl_->Disable(GL_SCISSOR_TEST);
        target.bind();
        target.clear({0, 0, 0, 0});
        pass.draw(camera.views, camera.placement, cells, Footprint::quad);
        const double ours = covered(target.read()), theirs = scene->covered();
        // Footprints reach beyond the surface, by their radius and half a cell's diagonal at most.
        constexpr double kRadius = 14.07, kReach = 0.71 + 0.87;
        EXPECT_GT(theirs, 0.03);
        EXPECT_GT(std::sqrt(theirs / ours), kRadius / (kRadius + kReach));
        EXPECT_LT(theirs, ours);
    }
}

TEST_F(BenchRender, MeasuresEveryPictureAndFootprint) {
    RenderOptions options;
    options.data = "ball";
    options.isovalue = 112.5;
    options.context = stereo::ContextKind::osmesa;
    options.pictures = {{32, 1}, {24, 2}};
    options.rounds = 2;
    options.motion_ms = 0;
    const auto rows = measure_rendering(file_, options, [](std::string_view, double) {});
    ASSERT_EQ(rows.size(), 2 * all_footprints().size());
    for (const RenderRow& row : rows) {
        EXPECT_EQ(row.data, "ball");
        EXPECT_EQ(row.context, "osmesa");
        EXPECT_EQ(row.size, row.eyes == 1 ? 32 : 24);
        EXPECT_NEAR(row.cells, 3733, 20);
        EXPECT_FALSE(row.vtk_fps) << "VTK cannot draw there";
        EXPECT_LE(row.p99_over_static, row.worst_over_static);
        EXPECT_GT(row.p99_over_static, 0.0);
        EXPECT_GT(row.sent_ids_percent.value_or(0), 0.0);
        EXPECT_LT(row.sent_ids_percent.value_or(100), 100.0);
        const double whole = 1e3 / row.fps;
        for (const double part : {row.extract_ms, row.upload_ms, row.draw_ms})
            EXPECT_GT(part, 0.0);
        EXPECT_GT(whole, row.extract_ms);
        EXPECT_EQ(row.order_ms > 0.0, row.footprint == "gaussian");
        EXPECT_EQ(row.bare_fps.has_value(), row.footprint == "quad" || row.footprint == "gaussian");
    }
}

TEST(Percentile, IsTheNumberThatSoManyAreNotAbove) {
    std::vector<double> numbers(100);
    std::iota(numbers.rbegin(), numbers.rend(), 1.0);
    EXPECT_EQ(percentile(numbers, 99), 100.0);
    EXPECT_EQ(percentile(numbers, 50), 51.0);
    EXPECT_EQ(percentile(numbers, 0), 1.0);
    EXPECT_EQ(percentile({7.0}, 99), 7.0);
}

TEST(InChild, ReturnsTheAnswerOrItsError) {
    const app::CancelOnSignal signals;
    std::string large(1 << 20, 'x');
    EXPECT_EQ(in_child([&] { return large; }, signals), large);
    try {
        in_child([]() -> std::string { throw index::Error("no such volume"); }, signals);
        FAIL() << "no error";
    } catch (const index::Error& error) {
        EXPECT_STREQ(error.what(), "no such volume");
    }
    EXPECT_THROW(in_child(
                     []() -> std::string {
                         std::raise(SIGKILL);
                         return {};
                     },
                     signals),
                 index::Error);
}

TEST(InChild, IsToldWhenTheUserCancels) {
    const app::CancelOnSignal signals;
    const auto interrupt_and_wait = [&]() -> std::string {
        kill(getppid(), SIGINT);
        for (;;) {
            poll(nullptr, 0, 10); // a signal ends it
            signals.check();
        }
    };
    EXPECT_THROW(in_child(interrupt_and_wait, signals), app::Canceled);
}

} // namespace
} // namespace isochron::bench
