// Occlusion culling on rectilinear grids: hidden cells are left out, and pictures do not change.
#include "index/detail/detail_regions.h"
#include "render/drawing/cell_pass.h"
#include "render/gl/driver.h"
#include "tests/render/culling/hidden_cells.h"

#include <array>
#include <cstdlib>
#include <set>
#include <tuple>

namespace isochron::render {
namespace {

/// Makes the sides of the cells along some axes from a twelfth of the largest up.
void stretch(Volume& volume, std::mt19937& random) {
    index::Grid grid;
    const auto axes = random() % 7 + 1; // at least one
    for (int axis = 0; axis < 3; ++axis) {
        const auto cells = static_cast<std::uint32_t>(volume.placement.extent[axis]);
        grid.vertices[static_cast<std::size_t>(axis)] = cells + 1;
        if (!(axes >> axis & 1))
            continue;
        std::vector<double> at{0.0};
        for (std::uint32_t i = 0; i < cells; ++i)
            at.push_back(at.back() + std::uniform_real_distribution(0.25, 3.0)(random));
        grid.spacing[axis] = at.back() / cells;
        grid.positions[static_cast<std::size_t>(axis)] = index::AxisPositions(std::move(at));
    }
    volume.placement.rectilinear = grid;
}

/// Some cells become one of a coarser level with those around them.
std::vector<index::CellPoint> coarser(const std::vector<index::CellPoint>& points) {
    std::vector<index::CellPoint> mixed;
    std::set<std::tuple<int, int, int>> there;
    for (index::CellPoint point : points) {
        const unsigned level = (point.x / 4 + point.y / 4 + point.z / 4) % 3;
        for (std::uint16_t* at : {&point.x, &point.y, &point.z})
            *at = static_cast<std::uint16_t>(index::doubled_center(*at >> level, level));
        if (there.insert({point.x, point.y, point.z}).second)
            mixed.push_back(point);
    }
    return mixed;
}

class UnevenCulling : public HiddenCellsTest {
  protected:
    UnevenCulling() { gl_.CreateQueries(GL_PRIMITIVES_GENERATED, 1, &query_); }
    ~UnevenCulling() override { gl_.DeleteQueries(1, &query_); }

    /// @param drawn the number of points or quads is added to it
    Image draw_counted(CellPass& pass, const Volume& volume, const CellBuffers& cells,
                       const CellAppearance& look, Footprint footprint, std::uint64_t& drawn) {
        gl_.BeginQuery(GL_PRIMITIVES_GENERATED, query_);
        Image image = draw(pass, volume, cells, look, footprint);
        gl_.EndQuery(GL_PRIMITIVES_GENERATED);
        GLuint64 count = 0;
        gl_.GetQueryObjectui64v(query_, GL_QUERY_RESULT, &count);
        drawn += count;
        return image;
    }

    /// Draws random volumes with all cells and without hidden ones.
    /// @param compare gets both pictures
    template <class Compare>
    void draw_both(Footprint footprint, int rounds, const Compare& compare) {
        CellAppearance look = three_colors();
        look.linear_light = footprint == Footprint::quad;
        for (const CellShape shape : {CellShape::plane, CellShape::voxel}) {
            CellPass seen(gl_, {.shape = shape}, "#define UNEVEN\n"),
                all(gl_, {.shape = shape}, "#define UNEVEN\n");
            all.draw_hidden_cells();
            std::array<std::uint64_t, 2> left{}, whole{}; // by whether of mixed levels
            for (int round = 0; round < rounds; ++round) {
                Volume volume = random_volume(random_);
                if (volume.cells.empty())
                    continue;
                stretch(volume, random_);
                auto points = points_of(volume);
                const bool mixed = round % 3 == 2;
                if (mixed)
                    points = coarser(points);
                const CellBuffers cells = CellBuffers::of_points(
                    gl_, points, *volume.placement.rectilinear, mixed ? 4u : 0u);
                SCOPED_TRACE(testing::Message() << name_of(shape) << " round " << round);
                compare(draw_counted(seen, volume, cells, look, footprint, left[mixed]),
                        draw_counted(all, volume, cells, look, footprint, whole[mixed]));
                if (testing::Test::HasFailure())
                    return;
            }
            for (const bool mixed : {false, true})
                if (is_drawn_for_processor(gl_)) {
                    EXPECT_LT(left[mixed], whole[mixed]) << name_of(shape) << " " << mixed;
                }
        }
    }

    GLuint query_ = 0;
};

TEST_P(UnevenCulling, PicturesOfQuadsAreThoseOfAllCells) {
    draw_both(Footprint::quad, 30,
              [](const Image& seen, const Image& all) { ASSERT_EQ(seen.rgba, all.rgba); });
}

TEST_P(UnevenCulling, PicturesOfSplatsAreThoseOfAllToWithinRounding) {
    draw_both(Footprint::gaussian, 20, [](const Image& seen, const Image& all) {
        int most = 0;
        for (std::size_t i = 0; i < all.rgba.size(); ++i)
            most = std::max(most, std::abs(int(all.rgba[i]) - int(seen.rgba[i])));
        ASSERT_LE(most, 1);
    });
}

INSTANTIATE_TEST_SUITE_P(, UnevenCulling, both_contexts(), context_name);

} // namespace
} // namespace isochron::render
