// What is surrounded is darker, in every footprint and for every eye; and surfaces within others
// stay behind them.
#include "render/drawing/cell_pass.h"

#include "index/surface/mesh_parts.h"
#include "render/gl/render_target.h"
#include "tests/render/cells/extractions.h"
#include "tests/support/drawing/gl_test.h"

#include <glm/ext/matrix_clip_space.hpp>
#include <glm/ext/matrix_transform.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace isochron::render {
namespace {

class SurroundedTest : public GlTest {
  protected:
    static constexpr glm::ivec2 kSize{200, 200};
    static constexpr float kMiddle = 20.0f; ///< middle of the field, voxels

    static index::ExtractionPtr extracted(const index::TestField& field,
                                          const std::vector<double>& isovalues) {
        const index::StepValues values = field.view();
        Extractions extractions(values);
        auto set = std::make_shared<index::Extraction>(
            *extractions.shaded(extractions.active(0, isovalues)));
        std::vector<index::MeshMaker> makers(1);
        for (index::CellSet& surface : set->surfaces) {
            index::CellMesh mesh;
            EXPECT_TRUE(make_mesh(makers, values, surface.query, surface.ids, mesh));
            surface.mesh = std::make_shared<const index::CellMesh>(std::move(mesh));
        }
        set->surroundings = index::surroundings_of(values, 0, 0, isovalues);
        return set;
    }

    /// Seen along z, from `aside` voxels beside the middle. A voxel is 4 pixels, about.
    Image draw(const index::TestField& field, const index::ExtractionPtr& set, Footprint footprint,
               const CellAppearance& look, float aside = 0.0f) {
        CellBuffers cells(gl_, field.view().grid);
        while (cells.shown() != set)
            cells.upload(set, std::numeric_limits<std::size_t>::max());
        EXPECT_GT(cells.count().surrounding_bytes, 0u);
        cells.compute_corners();
        RenderTarget target(gl_, kSize);
        target.bind();
        target.clear({0, 0, 0, 1});
        const glm::vec3 middle(kMiddle);
        const View view{.clip_from_eye = glm::perspective(0.5f, 1.0f, 5.0f, 300.0f),
                        .eye_from_room =
                            glm::lookAt(middle + glm::vec3(aside, 0, 100), middle, {0, 1, 0}),
                        .size = kSize};
        pass_.draw(view, Placement::of(field.view().grid, glm::mat4(1.0f)), cells, footprint, look);
        return target.read();
    }
    CellPass pass_{gl_};
};

constexpr std::array kEveryFootprint{Footprint::quad, Footprint::gaussian, Footprint::mesh,
                                     Footprint::surface};

TEST_P(SurroundedTest, AGrooveIsDarkerAndThePlainAroundItIsNot) {
    const index::TestField field(
        {41, 41, 41}, 1, index::ValueType::f32, [](double x, double, double z, double) {
            const double depth = 12 * std::exp(-(x - kMiddle) * (x - kMiddle) / 6);
            return 22 - depth - z;
        });
    const auto set = extracted(field, {0.0});
    CellAppearance look;
    for (const Footprint footprint : kEveryFootprint)
        for (const float aside : {0.0f, 3.0f}) {
            SCOPED_TRACE(testing::Message() << name_of(footprint) << " " << aside);
            look.occlusion = 0.0f;
            const Image plain = draw(field, set, footprint, look, aside);
            look.occlusion = 0.8f;
            const Image deep = draw(field, set, footprint, look, aside);
            /// Light that is left in a column, about the picture's middle.
            const auto left = [&](int x) {
                double before = 0, after = 0;
                for (int y = 80; y < 120; ++y) {
                    before += plain.at(x, y)[1];
                    after += deep.at(x, y)[1];
                }
                return after / before;
            };
            EXPECT_LT(left(100), 0.8) << "at the groove's bottom";
            EXPECT_GT(left(150), 0.93) << "beside it";
        }
}

TEST_P(SurroundedTest, TheInnerOfTwoSurfacesDoesNotPokeThroughTheOuterInFastMode) {
    const index::TestField field({41, 41, 41}, 1, index::ValueType::f32,
                                 [](double x, double y, double z, double) {
                                     return 30 - std::hypot(x - kMiddle, y - kMiddle, z - kMiddle);
                                 });
    CellAppearance look;
    look.surfaces[0].color = {1, 0, 0};
    look.surfaces[1].color = {0, 0, 1};
    for (const double apart : {0.5, 1.0, 3.0}) {
        const auto set = extracted(field, {30 - 16.0, 30 - 16.0 + apart});
        for (const Footprint footprint : {Footprint::quad, Footprint::mesh, Footprint::surface}) {
            const Image image = draw(field, set, footprint, look);
            int red = 0, blue = 0;
            for (std::size_t i = 0; i < image.rgba.size(); i += 4) {
                red += image.rgba[i] > image.rgba[i + 2];
                blue += image.rgba[i] < image.rgba[i + 2];
            }
            EXPECT_GT(red, 8000);
            EXPECT_LE(blue, red / 500) << name_of(footprint) << ", " << apart << " voxels apart";
        }
    }
}

INSTANTIATE_TEST_SUITE_P(, SurroundedTest, both_contexts(), context_name);

} // namespace
} // namespace isochron::render
