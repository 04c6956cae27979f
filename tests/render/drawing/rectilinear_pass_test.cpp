// A rectilinear grid looks as a regular one where its cells are as large as that one's.
#include "index/surface/mesh_parts.h"
#include "render/gl/render_target.h"
#include "tests/render/cells/extractions.h"
#include "tests/support/drawing/gl_test.h"
#include "tests/support/test_field.h"

#include "render/drawing/cell_pass.h"

#include <glm/ext/matrix_clip_space.hpp>
#include <glm/ext/matrix_transform.hpp>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>

namespace isochron::render {
namespace {

constexpr glm::ivec2 kPicture{96, 96};
/// Vertices along x with gaps of 0.25, behind which a ball lies among gaps of 1.5.
constexpr std::uint32_t kThin = 12, kWide = 28;

index::Grid regular() {
    return {.vertices = {kWide, 30, 30}, .spacing = {1.5, 1, 1}};
}
index::Grid rectilinear() {
    index::Grid grid{.vertices = {kThin + kWide, 30, 30}, .origin = {-0.25 * kThin, 0, 0}};
    std::vector<double> at{0.0};
    for (std::uint32_t i = 1; i < kThin + kWide; ++i)
        at.push_back(at.back() + (i <= kThin ? 0.25 : 1.5));
    grid.spacing.x = at.back() / (kThin + kWide - 1);
    grid.positions[0] = index::AxisPositions(std::move(at));
    return grid;
}

class RectilinearPass : public GlTest {
  protected:
    Image draw(CellPass& pass, const index::Grid& grid, Footprint footprint, float opacity,
               const glm::vec3& eye) {
        const index::TestField field(
            grid.vertices, 1, index::ValueType::u8, [&](double x, double y, double z, double) {
                return 230 - 9 * glm::distance(grid.physical({x, y, z}), glm::dvec3(20, 15, 14));
            });
        index::StepValues values = field.view();
        values.grid = grid;
        Extractions extractions(values);
        auto set = std::make_shared<index::Extraction>(
            *extractions.shaded(extractions.active(0, {150.5})));
        std::vector<index::MeshMaker> makers(1);
        index::CellMesh mesh;
        EXPECT_TRUE(
            make_mesh(makers, values, {index::Instant(0), 150.5}, set->surfaces[0].ids, mesh));
        set->surfaces[0].mesh = std::make_shared<const index::CellMesh>(std::move(mesh));

        CellBuffers cells(gl_, grid);
        while (cells.shown() != set)
            cells.upload(set, std::numeric_limits<std::size_t>::max());
        cells.compute_corners();
        pass.draw_without_points(); // that a rectilinear grid does without
        pass.draw_hidden_cells();
        RenderTarget target(gl_, kPicture);
        target.bind();
        target.clear({0, 0, 0, 1});
        const View view{.clip_from_eye = glm::perspective(0.7f, 1.0f, 0.5f, 200.0f),
                        .eye_from_room =
                            glm::lookAt(eye, glm::vec3(20, 15, 14), glm::vec3(0, 1, 0)),
                        .size = kPicture};
        CellAppearance look;
        look.depth_cue = 0; // it knows the box
        look.surfaces[0].opacity = opacity;
        pass.draw(view, Placement::of(grid, glm::mat4(1.0f)), cells, footprint, look);
        return target.read();
    }
};

TEST_P(RectilinearPass, EveryFootprintIsAsOnARegularGridOfTheSameCells) {
    const std::array eyes{glm::vec3(60, 40, 70), glm::vec3(20, 15, 80), glm::vec3(31, 18, 20)};
    for (const CellShape shape : {CellShape::plane, CellShape::voxel}) {
        CellPass even(gl_, {.shape = shape}),
            uneven(gl_, {.shape = shape}, prelude_for(rectilinear()));
        const auto expect_equal = [&](Footprint footprint, float opacity) {
            for (const glm::vec3& eye : eyes) {
                const Image a = draw(even, regular(), footprint, opacity, eye);
                const Image b = draw(uneven, rectilinear(), footprint, opacity, eye);
                int covered = 0, different = 0;
                for (int y = 0; y < kPicture.y; ++y)
                    for (int x = 0; x < kPicture.x; ++x) {
                        const std::uint8_t *p = a.at(x, y), *q = b.at(x, y);
                        covered += std::max({p[0], p[1], p[2]}) > 8;
                        different += std::max({std::abs(p[0] - q[0]), std::abs(p[1] - q[1]),
                                               std::abs(p[2] - q[2])}) > 4;
                    }
                EXPECT_GT(covered, 700);
                // Among quads that are as far away, another one may be in front.
                EXPECT_LE(different, covered / 20)
                    << name_of(footprint) << " " << name_of(shape) << " opacity " << opacity
                    << " from " << eye.x << " " << eye.y << " " << eye.z;
            }
        };
        expect_equal(Footprint::quad, 1.0f);
        expect_equal(Footprint::gaussian, 1.0f);
        if (shape == CellShape::voxel)
            continue;
        for (const float opacity : {1.0f, 0.5f}) {
            expect_equal(Footprint::mesh, opacity);
            expect_equal(Footprint::surface, opacity);
        }
    }
}

INSTANTIATE_TEST_SUITE_P(, RectilinearPass, both_contexts(), context_name);

} // namespace
} // namespace isochron::render
