// The results of the compute passes, compared with the CPU and the definitions.
#include "tests/render/cells/extractions.h"
#include "tests/support/drawing/gl_test.h"

#include <glm/ext/matrix_transform.hpp>
#include <glm/geometric.hpp>
#include <glm/gtc/packing.hpp>
#include <glm/matrix.hpp>

#include <array>
#include <cmath>
#include <cstring>
#include <limits>

namespace isochron::render {
namespace {

using index::CellId;
using index::StepValues;
using index::TestField;
using index::ValueType;

constexpr std::size_t kEnough = std::size_t{1} << 30;

class CellComputing : public GlTest {
  protected:
    template <class T>
    std::vector<T> read(GLuint texture, std::size_t count) {
        gl_.BindTextureUnit(0, texture);
        gl_.ActiveTexture(GL_TEXTURE0);
        GLint buffer = 0;
        gl_.GetIntegerv(GL_TEXTURE_BUFFER_DATA_STORE_BINDING, &buffer);
        std::vector<T> data(count);
        if (count > 0)
            gl_.GetNamedBufferSubData(GLuint(buffer), 0, GLsizeiptr(count * sizeof(T)),
                                      data.data());
        return data;
    }
    static CellId id_of(const index::Grid& grid, const index::CellPoint& point) {
        const auto cells = grid.cells();
        return (CellId{point.z} * cells[1] + point.y) * cells[0] + point.x;
    }
};

StepValues turned(StepValues values, const glm::dvec3& spacing) {
    values.grid.spacing = spacing;
    values.grid.direction =
        glm::dmat3(glm::rotate(glm::dmat4(1.0), 0.7, glm::normalize(glm::dvec3(1, 2, -0.5))));
    values.grid.direction[2] = -values.grid.direction[2]; // left-handed
    return values;
}

/// But for the rounding of floats, which may lead to the next step.
bool are_equal_planes(std::uint32_t a, std::uint32_t b) {
    const index::CellPlane p = index::unpack_plane(a), q = index::unpack_plane(b);
    return glm::distance(p.normal, q.normal) < 2e-3 &&
           std::abs(p.offset - q.offset) < 1.5 * index::CellPlane::kFarthest / 127;
}

TEST_P(CellComputing, PlanesAreTheCpusForEveryTypeSpacingAndBorder) {
    std::size_t beside = 0;
    for (const ValueType type : index::kAllTypes)
        for (const double slope : {1.0, -0.25})
            for (const glm::dvec3 spacing : {glm::dvec3(1.0), glm::dvec3(0.5, 2.0, 5.0)}) {
                const TestField field({19, 10, 17}, 2, type,
                                      index::scaled(index::white_noise(random_), 50, 60),
                                      {slope, 3.0});
                StepValues values = turned(field.view(), spacing);
                if (spacing.x != 1.0 && slope < 0) // rectilinear
                    values.grid.positions = {
                        index::AxisPositions({0, 0.1, 0.3, 0.4, 0.8, 1.6, 2.1, 2.2, 3.9, 4.3, 4.4,
                                              5.2, 5.3, 6.1, 6.4, 7.0, 7.9, 8.1, 9}),
                        {},
                        index::AxisPositions(
                            {0, 1, 9, 14, 17, 19, 20, 23, 30, 36, 41, 43, 52, 66, 69, 71, 80})};
                Extractions extractions(values);
                std::vector<CellId> all(values.grid.cell_count());
                for (std::size_t i = 0; i < all.size(); ++i)
                    all[i] = CellId(i);
                CellBuffers cells(gl_, values.grid);
                const double isovalue = index::quantiles(index::sorted_values(values), 1)[0];
                ASSERT_TRUE(cells.upload(extractions.of_cells(1, {all}, isovalue), kEnough));
                index::CellSet expected;
                expected.query = {index::Instant(1), isovalue};
                expected.ids = all;
                ASSERT_TRUE(index::shade_cells(values, expected));
                const auto points = read<index::CellPoint>(cells.texture(), cells.size());
                ASSERT_EQ(points.size(), all.size());
                for (const index::CellPoint& point : points) {
                    const CellId id = id_of(values.grid, point);
                    const index::CellPoint& other = expected.points[id];
                    ASSERT_EQ(point.style, 0);
                    ASSERT_TRUE(are_equal_planes(point.plane, other.plane))
                        << name_of(type) << " cell " << id;
                    const double offset = std::abs(index::unpack_plane(point.plane).offset);
                    beside += offset > 0.05 && offset < 0.8;
                }
            }
    EXPECT_GT(beside, 10000u) << "offsets that say something";
}

TEST_P(CellComputing, PointsThatComeWithASetAreTakenAsTheyAre) {
    const TestField field({19, 10, 17}, 2, ValueType::f32, index::turbulence(random_));
    const StepValues values = field.view();
    const auto isovalues = index::quantiles(index::sorted_values(values), 2);
    Extractions extractions(values);
    CellBuffers given(gl_, values.grid), computed(gl_, values.grid);
    std::size_t drawn = 0;
    // Sets with points and without in turn, of one surface and of two, and the same step again.
    for (const std::uint32_t turn : {0u, 1u, 2u, 3u, 4u, 5u, 6u, 7u}) {
        auto chosen = isovalues;
        chosen.resize(1 + turn / 2 % 2);
        const auto set = extractions.active(turn % 2, chosen);
        const auto shaded = turn == 5 ? set : extractions.shaded(set);
        ASSERT_EQ(shaded->shaded(), turn != 5);
        ASSERT_TRUE(computed.upload(set, kEnough));
        ASSERT_TRUE(given.upload(shaded, kEnough));
        ASSERT_EQ(given.size(), set->cells());
        const auto points = read<index::CellPoint>(given.texture(), given.size());
        const auto others = read<index::CellPoint>(computed.texture(), computed.size());
        for (std::size_t rank = 0; rank < points.size(); ++rank) {
            const index::CellPoint& point = points[given.slots().slot_of(rank)];
            const index::CellPoint& other = others[computed.slots().slot_of(rank)];
            ASSERT_EQ(id_of(values.grid, point), id_of(values.grid, other));
            ASSERT_EQ(point.style, other.style);
            ASSERT_TRUE(are_equal_planes(point.plane, other.plane));
            ++drawn;
        }
    }
    EXPECT_GT(drawn, 2000u);
}

TEST_P(CellComputing, ACellWithoutAGradientHasNoNormal) {
    TestField field({12, 12, 12}, 1, ValueType::f32,
                    [](double x, double, double, double) { return x < 6 ? 2.0 : x; });
    field.at<float>(0, 12 * 12 * 11 + 12 * 11 + 9) = std::numeric_limits<float>::quiet_NaN();
    field.at<float>(0, 9) = std::numeric_limits<float>::infinity();
    const StepValues values = field.view();
    Extractions extractions(values);
    std::vector<CellId> all(values.grid.cell_count());
    for (std::size_t i = 0; i < all.size(); ++i)
        all[i] = CellId(i);
    CellBuffers cells(gl_, values.grid);
    ASSERT_TRUE(cells.upload(extractions.of_cells(0, {all}), kEnough));
    std::size_t none = 0;
    for (const index::CellPoint& point : read<index::CellPoint>(cells.texture(), cells.size())) {
        const CellId id = id_of(values.grid, point);
        const bool expected = index::cell_normal(values, 0, id) == glm::dvec3(0.0);
        EXPECT_EQ(point.plane == 0, expected) << "cell " << id;
        none += expected;
    }
    EXPECT_GT(none, 100u);
}

double half(std::uint32_t bits) {
    return double{glm::unpackHalf1x16(static_cast<std::uint16_t>(bits))};
}

/// Values at a cell's vertices, x fastest.
std::array<double, 8> vertex_values(const StepValues& values, std::uint32_t step, CellId id) {
    const auto at = values.grid.cell_of(id);
    const auto& n = values.grid.vertices;
    std::array<double, 8> corners;
    for (std::uint32_t c = 0; c < 8; ++c)
        corners[c] = index::scaled_value(
            values, step,
            (std::size_t{at[2] + (c >> 2)} * n[1] + at[1] + (c >> 1 & 1)) * n[0] + at[0] + (c & 1));
    return corners;
}

/// Gradient at a vertex, in physical space.
glm::dvec3 gradient(const StepValues& values, std::uint32_t step,
                    const std::array<std::uint32_t, 3>& vertex) {
    const auto& n = values.grid.vertices;
    glm::dvec3 by_index;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        auto low = vertex, high = vertex;
        low[axis] -= low[axis] > 0;
        high[axis] += high[axis] + 1 < n[axis];
        const auto value = [&](const std::array<std::uint32_t, 3>& v) {
            return index::scaled_value(values, step,
                                       (std::size_t{v[2]} * n[1] + v[1]) * n[0] + v[0]);
        };
        by_index[int(axis)] = (value(high) - value(low)) / double(high[axis] - low[axis]);
    }
    return by_index * glm::inverse(glm::dmat3(values.grid.physical_from_index()));
}

TEST_P(CellComputing, CornersHaveTheValuesAndGradientsOfTheStepForEveryTypeAndSurface) {
    for (const ValueType type : index::kAllTypes) {
        const double slope = type == ValueType::u16 || type == ValueType::f32 ? -0.25 : 0.1;
        const TestField field({18, 11, 9}, 2, type,
                              index::scaled(index::turbulence(random_), 100, 20), {slope, 3.0});
        const StepValues values = turned(field.view(), {0.5, 2.0, 1.0});
        const auto isovalues = index::quantiles(index::sorted_values(values), 3);
        Extractions extractions(values);
        const auto set = extractions.active(1, isovalues);
        ASSERT_GT(set->cells(), 300u);
        CellBuffers cells(gl_, values.grid);
        ASSERT_TRUE(cells.upload(set, kEnough));
        cells.compute_corners();
        const auto points = read<index::CellPoint>(cells.texture(), cells.size());
        const auto corners = read<float>(cells.corner_values_texture(), 8 * cells.size());
        const auto gradients =
            read<std::uint32_t>(cells.corner_gradients_texture(), 16 * cells.size());
        // Scales of the first: one for the whole data set.
        double value_scale = 0, gradient_scale = 0;
        for (std::size_t slot = 0; slot < points.size(); ++slot) {
            const CellId id = id_of(values.grid, points[slot]);
            const auto at = values.grid.cell_of(id);
            const std::size_t surface = points[slot].style & 7;
            ASSERT_LT(surface, isovalues.size());
            const auto expected = vertex_values(values, 1, id);
            for (std::uint32_t c = 0; c < 8; ++c) {
                const double difference = expected[c] - isovalues[surface];
                const double corner = double{corners[8 * slot + c]};
                ASSERT_EQ(corner < 0, expected[c] < isovalues[surface]) << name_of(type);
                if (value_scale == 0 && std::abs(difference) > 10 * std::abs(slope))
                    value_scale = corner / difference;
                if (value_scale != 0) {
                    ASSERT_NEAR(corner / value_scale, difference, 1e-3) << name_of(type);
                }
                const glm::dvec3 g =
                    gradient(values, 1, {at[0] + (c & 1), at[1] + (c >> 1 & 1), at[2] + (c >> 2)});
                const std::uint32_t* words = &gradients[16 * slot + 2 * c];
                const glm::dvec3 packed(half(words[0]), half(words[0] >> 16), half(words[1]));
                EXPECT_EQ(words[1] >> 16, 0u);
                if (gradient_scale == 0 && glm::length(g) > 5 * std::abs(slope))
                    gradient_scale = glm::length(packed) / glm::length(g);
                if (gradient_scale != 0) {
                    ASSERT_LT(glm::distance(packed / gradient_scale, -g),
                              2e-3 * glm::length(g) + 1e-4)
                        << name_of(type) << " cell " << id << " vertex " << c;
                }
            }
        }
        EXPECT_GT(value_scale, 0);
        EXPECT_GT(gradient_scale, 0);
    }
}

TEST_P(CellComputing, CornersFollowTheShownSetAndAreComputedOnceForIt) {
    const TestField field({20, 20, 20}, 3, ValueType::u8,
                          [](double x, double, double, double t) { return 10 * x + 2 * t; });
    Extractions extractions(field.view());
    CellBuffers cells(gl_, field.view().grid);
    cells.compute_corners(); // nothing is shown: nothing to do
    for (std::uint32_t step = 0; step < 3; ++step) {
        ASSERT_TRUE(cells.upload(extractions.active(step, {55}), kEnough));
        cells.compute_corners();
        const auto first = read<float>(cells.corner_values_texture(), 8 * cells.size());
        ASSERT_FALSE(first.empty());
        // 50 + 2 t and 60 + 2 t around 55, in one unit.
        EXPECT_FLOAT_EQ(first[0] / first[1], float(2.0 * step - 5) / float(2.0 * step + 5));
        cells.compute_corners();
        EXPECT_EQ(read<float>(cells.corner_values_texture(), first.size()), first);
    }
}

INSTANTIATE_TEST_SUITE_P(, CellComputing, both_contexts(), context_name);

} // namespace
} // namespace isochron::render
