// Fast quads leave no gap in a surface: nothing behind it shows.
#include "render/drawing/cell_pass.h"
#include "render/gl/render_target.h"
#include "tests/render/cells/extractions.h"
#include "tests/render/cells/surface_agreement.h"

#include <limits>

namespace isochron::render {
namespace {

using index::TestField;
using index::ValueType;

class QuadCoverage : public GlTest {
  protected:
    static constexpr int kSize = 500;

    /// Eye-space distances by pixel, infinite where nothing is.
    std::vector<float> distances(CellPass& pass, const View& view, const Placement& placement,
                                 const CellBuffers& cells, Footprint footprint) {
        RenderTarget target(gl_, view.size);
        target.bind();
        target.clear({0, 0, 0, 1});
        pass.draw(view, placement, cells, footprint);
        std::vector<float> depths(std::size_t(kSize) * kSize);
        gl_.BindFramebuffer(GL_READ_FRAMEBUFFER, target.framebuffer());
        gl_.ReadPixels(0, 0, kSize, kSize, GL_DEPTH_COMPONENT, GL_FLOAT, depths.data());
        for (float& depth : depths)
            depth = depth >= 1.0f ? std::numeric_limits<float>::infinity()
                                  : view.clip_from_eye[3][2] /
                                        (-2.0f * depth + 1.0f - view.clip_from_eye[2][2]) * -1.0f;
        return depths;
    }
    /// Pixels within the surface, all around which it goes on at nearly the same distance, and
    /// those of them where quads show nothing, or only what is two voxels and more behind it.
    struct Count {
        int surface = 0, gaps = 0;
    };
    static bool goes_on(const std::vector<float>& surface, int x, int y, float voxel) {
        constexpr int kAround = 10, kStep = 5; // pixels; a voxel has 10 to 20
        const float here = surface[std::size_t(y) * kSize + x];
        for (int v = std::max(y - kAround, 0); v <= std::min(y + kAround, kSize - 1); v += kStep)
            for (int u = std::max(x - kAround, 0); u <= std::min(x + kAround, kSize - 1);
                 u += kStep)
                if (!(std::abs(surface[std::size_t(v) * kSize + u] - here) < 1.5f * voxel))
                    return false;
        return true;
    }
    Count count(CellPass& pass, const index::StepValues& values, double isovalue) {
        Extractions extractions(values);
        CellBuffers cells(gl_, values.grid);
        cells.upload(extractions.active(0, {isovalue}), std::numeric_limits<std::size_t>::max());
        cells.compute_corners();
        const Placement placement = placed_at_origin(values.grid);
        const glm::vec3 spacing = placement.spacing();
        const float voxel = std::max({spacing.x, spacing.y, spacing.z});
        Count result;
        for (const glm::vec3& from : {glm::vec3(0, 0, 3), glm::vec3(3, 0, 0), glm::vec3(2, 0, 2),
                                      glm::vec3(1.7f, 1.8f, 1.6f), glm::vec3(0.5f, 2.7f, 0.9f)}) {
            View view = perspective_view(from);
            view.size = {kSize, kSize};
            view.clip_from_eye = glm::perspective(0.75f, 1.0f, 1.0f, 5.0f);
            // Turned about the line of sight, too: quads stay upright.
            const float turn = 0.785f * float(random_() % 3);
            view.eye_from_room =
                glm::rotate(glm::mat4(1.0f), turn, glm::vec3(0, 0, 1)) * view.eye_from_room;
            const auto surface = distances(pass, view, placement, cells, Footprint::surface);
            const auto quads = distances(pass, view, placement, cells, Footprint::quad);
            for (int y = 0; y < kSize; ++y)
                for (int x = 0; x < kSize; ++x) {
                    const std::size_t i = std::size_t(y) * kSize + x;
                    if (!std::isfinite(surface[i]) || !goes_on(surface, x, y, voxel))
                        continue;
                    ++result.surface;
                    result.gaps += !(quads[i] < surface[i] + 2.0f * voxel);
                }
        }
        return result;
    }
};

TEST_P(QuadCoverage, QuadsLeaveNoGapInASurface) {
    CellPass planes(gl_), voxels(gl_, {.shape = CellShape::voxel});
    CellPass smaller(gl_, {.half_cell = 0.4f});
    CellPass smaller_voxels(gl_, {.shape = CellShape::voxel, .quad_diameter = 1.15f});
    const TestField sphere({30, 28, 31}, 1, ValueType::u8, index::moving_sphere);
    const TestField smooth({24, 20, 22}, 1, ValueType::f32, index::turbulence(random_, 24));
    const TestField plane({20, 20, 20}, 1, ValueType::f32,
                          [](double, double, double z, double) { return z; });
    int gaps_of_smaller = 0, gaps_of_smaller_voxels = 0;
    for (const auto& [field, isovalue] :
         {std::pair(&sphere, 100.5), {&smooth, 0.03}, {&plane, 9.5}, {&plane, 9.99}}) {
        index::StepValues values = field->view();
        for (const double spacing : {1.0, 3.0}) {
            values.grid.spacing[0] = spacing;
            for (CellPass* pass : {&planes, &voxels}) {
                const Count found = count(*pass, values, isovalue);
                EXPECT_GT(found.surface, 20000);
                // One or two pixels in a thousand may lie between planes of which two just meet.
                EXPECT_LE(found.gaps, pass == &planes ? found.surface / 500 : 0)
                    << "of " << found.surface << (pass == &planes ? ", planes" : ", voxels")
                    << ", isovalue " << isovalue << ", spacing " << spacing;
            }
            gaps_of_smaller += count(smaller, values, isovalue).gaps;
            gaps_of_smaller_voxels += count(smaller_voxels, values, isovalue).gaps;
        }
    }
    EXPECT_GT(gaps_of_smaller, 1000) << "parts of planes that are too small would be found";
    EXPECT_GT(gaps_of_smaller_voxels, 1000) << "quads that are too small would be found";
}

INSTANTIATE_TEST_SUITE_P(, QuadCoverage, both_contexts(), context_name);

} // namespace
} // namespace isochron::render
