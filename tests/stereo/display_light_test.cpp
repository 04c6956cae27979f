// Light in every stereo mode: the composed pictures of the eyes, with one sample and with several.
#include "stereo/display.h"

#include "render/gl/shader.h"
#include "render/gl/srgb.h"
#include "render/passes/line_pass.h"
#include "tests/stereo/each_eye.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <string>

namespace isochron::stereo {
namespace {

using render::Image;

constexpr std::string_view kEdgeVertex = R"(#version 450 core
void main() {
    gl_Position = vec4(gl_VertexID == 1 ? 3.1 : -0.9, gl_VertexID == 2 ? 3.3 : -1.2, 0.0, 1.0);
}
)";
constexpr std::string_view kEdgeFragment = R"(#version 450 core
out vec4 color;
void main() { color = vec4(1.0); }
)";

const interaction::Pose kHead{{0.0f, 1.55f, 0.0f}, {1.0f, 0.0f, 0.0f, 0.0f}};

class DisplayLight : public testing::TestWithParam<ContextKind> {
  protected:
    std::unique_ptr<GlContext> context_ = make_context(GetParam(), {.size = {256, 192}});
    render::Gl gl_{context_->loader()};
};

TEST_P(DisplayLight, HalfTheLightIsHalfTheLightInEveryModeAndWithSeveralSamples) {
    constexpr int kHalfLight = 188; // half the light of white, as sRGB
    for (const int samples : {1, 4}) {
        Display display(gl_, *context_, {}, {.samples = samples});
        render::LinePass lines(gl_);
        for (const StereoMode mode : all_stereo_modes()) {
            // Half opaque white over black, at the middle of every eye's screen.
            draw_each_eye(gl_, display, kHead, 0.0f, mode, [&](const render::View& view, Eye) {
                const std::array line{render::Line{
                    {-5.0f, 1.55f, -1.0f}, {5.0f, 1.55f, -1.0f}, {1.0f, 1.0f, 1.0f, 0.5f}}};
                lines.draw(view, glm::mat4(1.0f), line, 80.0f);
            });
            // A quarter into the window is the left eye's picture, or a place in everybody's.
            const Image window = display.read_window();
            const bool stacked = upright(mode) == StereoMode::top_bottom;
            const int y = stacked ? window.height / 4 : window.height / 2;
            for (const int x : {window.width / 4, window.width * 3 / 4})
                for (int channel = 0; channel < 3; ++channel)
                    EXPECT_NEAR(window.at(x, y)[channel], kHalfLight, 1)
                        << name_of(mode) << ", " << samples << " samples";
        }
    }
}

TEST_P(DisplayLight, SeveralSamplesSmoothEdgesInLight) {
    Display display(gl_, *context_, {}, {.samples = 4});
    // A scissored clear has no edge within a pixel; a steep triangle has many.
    const render::Program triangle =
        render::link_program(gl_, {{"edge.vert", kEdgeVertex}, {"edge.frag", kEdgeFragment}});
    const render::VertexArray none(gl_);
    for (const StereoMode mode : all_stereo_modes()) {
        draw_each_eye(gl_, display, kHead, 0.0f, mode, [&](const render::View&, Eye) {
            gl_.Disable(GL_DEPTH_TEST);
            gl_.UseProgram(triangle.name());
            gl_.BindVertexArray(none.name());
            gl_.DrawArrays(GL_TRIANGLES, 0, 3);
        });
        const Image window = display.read_window();
        int partly = 0;
        for (std::size_t i = 0; i < window.rgba.size(); i += 4) {
            const float quarters =
                4 * render::linear_from_srgb(static_cast<float>(window.rgba[i]) / 255.0f);
            ASSERT_NEAR(quarters, std::round(quarters), 0.04) << name_of(mode);
            partly += std::round(quarters) > 0 && std::round(quarters) < 4;
        }
        EXPECT_GT(partly, window.height / 4) << name_of(mode);
    }
}

INSTANTIATE_TEST_SUITE_P(Contexts, DisplayLight,
                         testing::Values(ContextKind::egl, ContextKind::osmesa),
                         [](const auto& kind) { return std::string(name_of(kind.param)); });

} // namespace
} // namespace isochron::stereo
