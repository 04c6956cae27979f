// Slices as they are drawn: the trilinear value at every pixel, holes, lines and depth.
#include "render/cells/placement.h"
#include "render/gl/render_target.h"
#include "render/gl/srgb.h"
#include "render/passes/color_map.h"
#include "render/drawing/slice_pass.h"
#include "tests/support/drawing/gl_test.h"
#include "tests/support/indexed.h"
#include "tests/support/test_seed.h"

#include <glm/gtc/matrix_transform.hpp>

#include <cmath>
#include <limits>
#include <random>

namespace isochron::render {
namespace {

using index::Grid;

constexpr int kSide = 160; ///< [pixel] of the picture

class SlicePassTest : public GlTest {
  protected:
    /// The slice of a field, seen at right angles, two units wide. Red is the share of the range.
    Image draw(const Grid& grid, const index::SliceQuery& plane,
               const std::function<double(double, double, double)>& value,
               const std::vector<Isoline>& lines = {}) {
        const index::TestField field(
            grid.vertices, 1, index::ValueType::f32,
            [&](double x, double y, double z, double) { return value(x, y, z); });
        index::StepValues values = field.view();
        values.grid = grid;
        const test_support::TestFolder folder;
        const auto file = indexed(folder, values);
        slice_ = std::make_shared<index::SliceValues>(index::slice_values(*file, plane));
        const glm::vec3 at(plane.point), normal(plane.normal);
        view_ = {.clip_from_eye = glm::ortho(-1.0f, 1.0f, -1.0f, 1.0f, 0.1f, 4.0f),
                 .eye_from_room = glm::lookAt(at + 2.0f * normal, at,
                                              std::abs(normal.y) < 0.9f ? glm::vec3(0, 1, 0)
                                                                        : glm::vec3(1, 0, 0)),
                 .size = {kSide, kSide}};
        std::vector<glm::vec3> ramp;
        for (std::size_t i = 0; i < kColorMapSize; ++i)
            ramp.emplace_back(static_cast<float>(i) / (kColorMapSize - 1), 0.2f, 0.5f);
        const Texture map = color_map_texture(gl_, ramp);
        SlicePass pass(gl_, grid);
        const std::array held{index::SliceValuesPtr(slice_)};
        pass.hold(held);
        target_.bind();
        target_.clear({0, 0, 0, 0});
        const Placement placement = Placement::of(grid, glm::dmat4(1.0));
        pass.draw(view_, placement.room_from_index, *slice_, {.map = map.name()}, lines, 2.0f);
        return target_.read();
    }
    /// The place of a pixel's middle on the slice.
    glm::dvec3 place_of(int x, int y) const {
        const glm::dmat4 room = glm::inverse(glm::dmat4(view_.clip_from_eye * view_.eye_from_room));
        const double right = 2 * (x + 0.5) / kSide - 1, up = 1 - 2 * (y + 0.5) / kSide;
        const glm::dvec3 near(room * glm::dvec4(right, up, -1, 1));
        const glm::dvec3& normal = slice_->query.normal;
        return near - glm::dot(near - slice_->query.point, normal) * normal;
    }

    RenderTarget target_{gl_, {kSide, kSide}};
    std::shared_ptr<index::SliceValues> slice_;
    View view_;
};

TEST_P(SlicePassTest, ShowTheTrilinearValueAtEveryPixelAndHoles) {
    std::mt19937 random(test_seed());
    const auto uniform = [&](double low, double high) {
        return std::uniform_real_distribution(low, high)(random);
    };
    Grid even{.vertices = {9, 7, 11}, .origin = {-1, -0.9, -0.8}, .spacing = {0.25, 0.3, 0.16}};
    Grid uneven = even;
    uneven.positions[0] = index::AxisPositions({0, 0.1, 0.15, 0.6, 0.7, 1.2, 1.3, 1.9, 2});
    uneven.positions[2] =
        index::AxisPositions({0, 0.3, 0.32, 0.5, 0.6, 0.7, 0.9, 1.1, 1.4, 1.5, 1.6});
    for (const Grid& grid : {even, uneven})
        for (int each = 0; each < 4; ++each) {
            index::SliceQuery plane{.point = {0.03, 0.02, -0.01}};
            plane.normal = each < 3 ? glm::dvec3(each == 0, each == 1, each == 2)
                                    : glm::normalize(glm::dvec3(0.6, uniform(-1, 1), -0.5));
            const Image image = draw(grid, plane, [&](double, double, double) {
                return random() % 60 == 0 ? std::numeric_limits<double>::quiet_NaN()
                                          : uniform(0, 1);
            });
            int seen = 0, wrong = 0, holes = 0, missing = 0;
            for (int y = 0; y < kSide; ++y)
                for (int x = 0; x < kSide; ++x) {
                    const glm::dvec3 index = grid.index_of(place_of(x, y));
                    bool border = false; // border of a cell or of the data, which rounding may cross
                    for (int axis = 0; axis < 3; ++axis)
                        border = border || std::abs(index[axis] - std::round(index[axis])) < 1e-3;
                    if (border)
                        continue;
                    const auto value = index::value_on(*slice_, grid, place_of(x, y));
                    const auto* pixel = image.at(x, y);
                    const bool covered = pixel[3] > 0;
                    if (!value) {
                        ++holes;
                        missing += covered;
                        continue;
                    }
                    ++seen;
                    const auto [low, high] = slice_->whole;
                    const double share = (*value - low) / (high - low);
                    const double shown = linear_from_srgb(static_cast<float>(pixel[0]) / 255.0f);
                    wrong += !covered || std::abs(shown - share) > 0.008;
                }
            EXPECT_GT(seen, 5000);
            EXPECT_GT(holes, 1000);
            EXPECT_EQ(wrong, 0) << each;
            EXPECT_EQ(missing, 0) << each;
        }
}

TEST_P(SlicePassTest, HaveLinesWhereTheValueIsThatOfASurface) {
    const Grid grid{.vertices = {5, 5, 5}, .origin = glm::dvec3(-1), .spacing = glm::dvec3(0.5)};
    const std::vector<Isoline> lines{{0.25f, {0, 1, 0}}};
    const Image image = draw(
        grid, {.point = {0, 0, 0.1}}, [](double x, double, double) { return x; }, lines);
    for (int y = 10; y < kSide - 10; ++y)
        for (int x = 10; x < kSide - 10; ++x) {
            const bool green = image.at(x, y)[1] > 240;
            EXPECT_EQ(green, x == kSide / 4 - 1 || x == kSide / 4) << x << ' ' << y;
        }
}

INSTANTIATE_TEST_SUITE_P(, SlicePassTest, both_contexts(), context_name);

} // namespace
} // namespace isochron::render
