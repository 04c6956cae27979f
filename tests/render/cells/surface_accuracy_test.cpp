// Surfaces, compared with the reference ray-caster: depths, hits and normals.
#include "tests/render/cells/surface_agreement.h"
#include "tests/support/test_field.h"

#include <cmath>
#include <limits>

namespace isochron::render {
namespace {

using index::TestField;
using index::ValueType;

class SurfaceAccuracy : public SurfaceTest {
  protected:
    float uniform(float low, float high) {
        return std::uniform_real_distribution<float>(low, high)(random_);
    }
    glm::vec3 direction() {
        for (;;) {
            const glm::vec3 v(uniform(-1, 1), uniform(-1, 1), uniform(-1, 1));
            if (const float length = glm::length(v); length > 0.1f && length < 1.0f)
                return v / length;
        }
    }
    /// Draws from a few places of each kind; all of them together must be within the figures.
    void expect_agreement(const char* name, const index::StepValues& values, double isovalue,
                          const std::vector<View>& views,
                          const glm::dmat4& room_from_physical = glm::dmat4(1.0)) {
        const VertexField field(values, {index::Instant(0), isovalue});
        const Placement placement = placed_at_origin(values.grid, room_from_physical);
        Agreement all;
        for (const View& view : views)
            all.add(compare(draw(field, placement, view), field, view, placement));
        const double depth = Agreement::percentile(all.depth_errors, 0.999);
        const double angle = Agreement::percentile(all.angles, 0.999);
        std::printf("%-20s %7d pixels, %d hit by one only, %d elsewhere, 99.9 %%: depth %.6f "
                    "voxels, normal %.5f rad\n",
                    name, all.hit, all.hit_by_one, all.elsewhere, depth, angle);
        EXPECT_GT(all.hit, 3000) << name;
        // Where a ray only just touches the surface, rounding decides.
        constexpr double kTouches = 4;
        EXPECT_LE(all.hit_by_one, kTouches + 1e-4 * all.hit) << name;
        EXPECT_LE(all.elsewhere, kTouches + 1e-4 * all.hit) << name;
        EXPECT_LE(depth, 0.02) << name;
        EXPECT_LE(angle, 0.01) << name;
    }
    std::vector<View> outside() {
        std::vector<View> views;
        for (int i = 0; i < 3; ++i)
            views.push_back(perspective_view(uniform(1.5f, 3.0f) * direction()));
        return views;
    }
};

TEST_P(SurfaceAccuracy, OfASphere) {
    const TestField field({40, 38, 41}, 1, ValueType::u8, index::moving_sphere);
    expect_agreement("sphere", field.view(), 100.5, outside());
}

TEST_P(SurfaceAccuracy, OfASmoothField) {
    const TestField field({24, 20, 22}, 1, ValueType::f32, index::turbulence(random_, 24));
    expect_agreement("smooth", field.view(), 0.03, outside());
}

TEST_P(SurfaceAccuracy, OfNoiseWithASaddleInEveryCell) {
    const TestField field({9, 8, 10}, 1, ValueType::u8,
                          index::scaled(index::white_noise(random_), 127.5, 127.5));
    expect_agreement("noise", field.view(), 128.0, outside());
}

TEST_P(SurfaceAccuracy, OfASpacingOfOneToTen) {
    const TestField field({24, 20, 8}, 1, ValueType::f32, index::turbulence(random_, 24));
    for (int axis = 0; axis < 3; ++axis) {
        index::StepValues values = field.view();
        values.grid.spacing[axis] = 10.0;
        std::vector<View> views = outside();
        for (View& view : views)
            view.clip_from_eye = glm::perspective(0.35f, 1.0f, 0.3f, 5.0f);
        expect_agreement("1:1:10", values, 0.03, views);
    }
}

/// Vertices at distances that grow from one to the next, with gaps from `first` on.
index::AxisPositions growing(std::uint32_t vertices, double first, double factor) {
    std::vector<double> at{0.0};
    for (double gap = first; at.size() < vertices; gap *= factor)
        at.push_back(at.back() + gap);
    return index::AxisPositions(std::move(at));
}

index::Grid stretched(index::Grid grid) {
    grid.positions = {
        growing(grid.vertices[0], 0.2, 1.12), {}, growing(grid.vertices[2], 3.0, 0.85)};
    for (int axis : {0, 2})
        grid.spacing[axis] =
            grid.positions[std::size_t(axis)].distances().back() / grid.cells()[std::size_t(axis)];
    return grid;
}

TEST_P(SurfaceAccuracy, OfARectilinearGrid) {
    const TestField field({24, 20, 22}, 1, ValueType::f32, index::turbulence(random_, 24));
    index::StepValues values = field.view();
    values.grid = stretched(values.grid);
    std::vector<View> views = outside();
    views.push_back(perspective_view({0.1f, 0.05f, 0.1f}, direction())); // inside
    views.back().clip_from_eye = glm::perspective(1.6f, 1.0f, 0.004f, 3.0f);
    views.push_back(views.front());
    views.back().clip_from_eye = glm::ortho(-0.8f, 0.7f, -0.6f, 0.9f, 0.2f, 5.0f);
    expect_agreement("rectilinear", values, 0.03, views,
                     glm::rotate(glm::dmat4(1.0), 0.7, glm::dvec3(0.3, 0.5, 0.8)));
}

TEST_P(SurfaceAccuracy, FromInsideTheVolume) {
    const TestField field({24, 20, 22}, 1, ValueType::f32, index::turbulence(random_, 24));
    std::vector<View> views;
    for (int i = 0; i < 4; ++i) {
        const glm::vec3 eye = 0.4f * direction();
        views.push_back(perspective_view(eye, eye + direction()));
        views.back().clip_from_eye = glm::perspective(1.6f, 1.0f, 0.004f, 3.0f);
    }
    expect_agreement("inside", field.view(), 0.03, views);
}

TEST_P(SurfaceAccuracy, OfAParallelView) {
    const TestField field({24, 20, 22}, 1, ValueType::f32, index::turbulence(random_, 24));
    std::vector<View> views = outside();
    for (View& view : views)
        view.clip_from_eye = glm::ortho(-0.8f, 0.7f, -0.6f, 0.9f, 0.2f, 5.0f);
    views.back().eye_from_room = glm::translate(glm::mat4(1.0f), glm::vec3(0, 0, -2)); // along z
    expect_agreement("parallel", field.view(), 0.03, views);
}

TEST_P(SurfaceAccuracy, FarOffTheAxis) {
    const TestField field({24, 20, 22}, 1, ValueType::f32, index::turbulence(random_, 24));
    std::vector<View> views;
    for (const glm::vec2 side : {glm::vec2(1, 0), glm::vec2(-1, 0.7f), glm::vec2(0.2f, 1)}) {
        // The eye looks past the volume, through a window that shows it nevertheless.
        View view = perspective_view({0, 0, 1.6f});
        view.eye_from_room = glm::translate(glm::mat4(1.0f), glm::vec3(3.0f * side, -1.6f));
        const glm::vec2 middle = 0.5f * 3.0f / 1.6f * side;
        view.clip_from_eye = glm::frustum(middle.x - 0.3f, middle.x + 0.3f, middle.y - 0.3f,
                                          middle.y + 0.3f, 0.5f, 3.0f);
        views.push_back(view);
    }
    expect_agreement("off axis", field.view(), 0.03, views);
}

TEST_P(SurfaceAccuracy, OfAMirroredAndSlantedVolume) {
    const TestField field({24, 20, 22}, 1, ValueType::f32, index::turbulence(random_, 24));
    index::StepValues values = field.view();
    values.grid.direction[0] = -values.grid.direction[0];
    values.grid.spacing = {1.0, 2.5, 0.7};
    expect_agreement("mirrored", values, 0.03, outside(),
                     glm::rotate(glm::dmat4(1.0), 0.7, glm::dvec3(0.3, 0.5, 0.8)));
}

TEST_P(SurfaceAccuracy, OfAPlaneSeenAlmostFromItsEdge) {
    const TestField field({30, 30, 30}, 1, ValueType::f32,
                          [](double x, double y, double z, double) {
                              return z + 0.31 * std::sin(0.3 * x) * std::sin(0.2 * y) - 14.8;
                          });
    expect_agreement("grazing", field.view(), 0.0,
                     {perspective_view({2.0f, 0.3f, 0.03f}), perspective_view({-1.4f, 1.2f, 0.1f}),
                      perspective_view({0.0f, 2.0f, -0.06f}), perspective_view({0.9f, 0.8f, 0.15f}),
                      perspective_view({-1.2f, -0.1f, -0.2f})});
}

TEST_P(SurfaceAccuracy, FromTenThousandVoxelsAway) {
    const TestField field({24, 20, 22}, 1, ValueType::f32, index::turbulence(random_, 24));
    View view = perspective_view({0, 0, 2});
    const glm::vec3 eye = 600.0f * direction();
    view.eye_from_room = glm::lookAt(eye, glm::vec3(0), glm::vec3(0, 1, 0));
    view.clip_from_eye = glm::perspective(0.0035f, 1.0f, 598.0f, 602.0f);
    expect_agreement("far eye", field.view(), 0.03, {view});
}

TEST_P(SurfaceAccuracy, InTheLastCornerOfALongVolume) {
    const TestField field({2000, 12, 12}, 1, ValueType::f32, index::turbulence(random_, 24));
    // The eye is where the voxels are: at the far end of x.
    const Placement placement = placed_at_origin(field.view().grid);
    const glm::vec3 target(placement.room_from_index * glm::vec4(1992, 6, 6, 1));
    const float voxel = placement.room_from_index[0][0];
    View view = perspective_view(target + 18.0f * voxel * direction(), target);
    view.clip_from_eye = glm::perspective(0.7f, 1.0f, 2.0f * voxel, 60.0f * voxel);
    expect_agreement("long volume", field.view(), 0.03, {view});
}

TEST_P(SurfaceAccuracy, FromWithinACellAndAcrossTheNearPlane) {
    const TestField field({5, 4, 5}, 1, ValueType::f32, index::white_noise(random_));
    std::vector<View> views;
    for (const float near : {0.002f, 0.1f, 0.6f})
        for (int i = 0; i < 3; ++i) {
            const glm::vec3 eye = 0.2f * direction();
            views.push_back(perspective_view(eye, eye + direction()));
            views.back().clip_from_eye = glm::perspective(1.8f, 1.0f, near, 3.0f);
        }
    views.push_back(perspective_view({0, 0, 0.5f}));
    views.back().clip_from_eye = glm::ortho(-1.0f, 1.0f, -1.0f, 1.0f, 0.4f, 3.0f);
    expect_agreement("within a cell", field.view(), 0.05, views);
}

TEST_P(SurfaceAccuracy, OfAPlaneAlongTheGridSeenAlongTheAxes) {
    const TestField field({12, 12, 12}, 1, ValueType::f32,
                          [](double, double, double z, double) { return z; });
    View view = perspective_view({0, 0, 2});
    expect_agreement("plane, head on", field.view(), 5.3, {view});
    view.clip_from_eye = glm::ortho(-0.5f, 0.5f, -0.5f, 0.5f, 0.5f, 4.0f);
    expect_agreement("plane, parallel", field.view(), 5.3, {view});
    expect_agreement("plane of vertices", field.view(), 5.0, {view});
    view.eye_from_room = glm::lookAt(glm::vec3(2, 0, 0), glm::vec3(0), glm::vec3(0, 1, 0));
    const Placement placement = placed_at_origin(field.view().grid);
    const VertexField from_its_edge(field.view(), {index::Instant(0), 5.3});
    const Agreement agreement =
        compare(draw(from_its_edge, placement, view), from_its_edge, view, placement);
    EXPECT_EQ(agreement.hit_by_one, 0);
}

TEST_P(SurfaceAccuracy, OfValuesOfAnySize) {
    const TestField::Function plain = index::turbulence(random_, 24);
    for (const double scale : {1e-34, 1e-20, 1e20, 1e38}) {
        const TestField field({16, 16, 16}, 1, ValueType::f32, index::scaled(plain, scale, 0.0));
        expect_agreement("scaled", field.view(), 0.03 * scale, outside());
    }
}

TEST_P(SurfaceAccuracy, OfAFieldWithoutSomeOfItsValues) {
    TestField field({16, 16, 16}, 1, ValueType::f32, index::turbulence(random_, 24));
    for (int i = 0; i < 40; ++i)
        field.at<float>(0, random_() % 4096) = std::numeric_limits<float>::quiet_NaN();
    expect_agreement("with NaN", field.view(), 0.03, outside());
}

INSTANTIATE_TEST_SUITE_P(, SurfaceAccuracy, both_contexts(), context_name);

} // namespace
} // namespace isochron::render
