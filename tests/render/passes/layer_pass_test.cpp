// Translucent surfaces by the nearest layer of each.
#include "render/gl/render_target.h"
#include "render/gl/shader.h"
#include "render/gl/srgb.h"
#include "render/passes/layer_pass.h"
#include "tests/support/drawing/gl_test.h"

#include <glm/gtc/matrix_transform.hpp>

#include <algorithm>
#include <array>
#include <random>
#include <utility>
#include <vector>

namespace isochron::render {
namespace {

constexpr int kColumns = 16, kWide = 6, kHigh = 10;

/// What lies in a column of the picture.
struct Column {
    float opaque = 2;          ///< depth of an opaque surface, above 1: there is none
    std::vector<float> layers; ///< depth of each layer
};

class Layers : public GlTest {
  protected:
    void SetUp() override {
        const ShaderSource flat{"flat.frag", "#version 450 core\n"
                                             "layout(location = 0) uniform vec4 light;\n"
                                             "out vec4 color;\n"
                                             "void main() { color = light; }\n"};
        program_.emplace(link_program(gl_, {shader_file("full_screen.vert"), flat}));
    }
    /// Fills a column of the bound framebuffer as an opaque surface would. @param color sRGB
    void fill(int column, float depth, glm::vec3 color) {
        gl_.ScissorIndexed(0, kWide * column, 0, kWide, kHigh);
        gl_.Enable(GL_DEPTH_TEST);
        gl_.DepthFunc(GL_LESS);
        gl_.DepthRange(depth, depth);
        const glm::vec3 light = linear_from_srgb(color);
        gl_.ProgramUniform4f(program_->name(), 0, light.x, light.y, light.z, 1.0f);
        gl_.UseProgram(program_->name());
        gl_.BindVertexArray(none_.name());
        gl_.DrawArrays(GL_TRIANGLES, 0, 3);
        gl_.DepthRange(0.0, 1.0);
    }
    Image drawn(const std::vector<Column>& columns, const std::vector<glm::vec3>& colors,
                const std::vector<float>& opacities, bool hidden, bool linear) {
        for (int i = 0; i < kColumns; ++i)
            if (columns[i].opaque <= 1)
                fill(i, columns[i].opaque, kOpaque);
        View view;
        view.size = target_.size();
        const glm::mat4 all = glm::scale(glm::translate(glm::mat4(1), glm::vec3(-1)), glm::vec3(2));
        LayerPass(gl_).draw(
            std::span(&view, 1), opacities,
            [&](std::size_t layer) {
                for (int i = 0; i < kColumns; ++i)
                    if (columns[i].layers[layer] <= 1)
                        fill(i, columns[i].layers[layer], colors[layer]);
            },
            hidden, linear, all);
        return target_.read();
    }
    /// The slow and obvious way: display values of a column.
    static glm::vec3 expected(const Column& column, const std::vector<glm::vec3>& colors,
                              const std::vector<float>& opacities, bool linear) {
        const bool opaque = column.opaque <= 1;
        std::vector<std::pair<float, std::size_t>> near_first;
        for (std::size_t i = 0; i < colors.size(); ++i)
            if (column.layers[i] <= 1 && column.layers[i] < column.opaque)
                near_first.emplace_back(column.layers[i], i);
        std::ranges::sort(near_first);
        std::vector<std::pair<float, std::size_t>> all = near_first;
        all.insert(all.end(), near_first.rbegin(), near_first.rend());
        const auto value = [&](glm::vec3 color) {
            return linear ? linear_from_srgb(color) : color;
        };
        glm::vec3 light = opaque ? value(kOpaque) : glm::vec3(0);
        for (auto layer = all.rbegin(); layer != all.rend(); ++layer)
            light = glm::mix(light, value(colors[layer->second]), opacities[layer->second]);
        return linear ? srgb_from_linear(light) : light;
    }
    static constexpr glm::vec3 kOpaque{0.2f, 0.9f, 0.4f};
    std::optional<Program> program_;
    VertexArray none_{gl_};
    RenderTarget target_{gl_, {kColumns * kWide, kHigh}};
};
INSTANTIATE_TEST_SUITE_P(, Layers, both_contexts(), context_name);

TEST_P(Layers, LieOverThePictureInTheOrderOfTheirDepthsAndAgainBehind) {
    std::uniform_real_distribution<float> depth(0.1f, 1.3f), share(0.0f, 1.0f);
    for (const std::size_t count : {1, 2, 3})
        for (const bool hidden : {false, true})
            for (const bool linear : {false, true}) {
                SCOPED_TRACE(testing::Message() << count << hidden << linear);
                target_.bind();
                target_.clear({0, 0, 0, 1});
                gl_.Enable(GL_SCISSOR_TEST);
                std::vector<Column> columns(kColumns);
                for (Column& column : columns) {
                    column.opaque = hidden ? depth(random_) : 2;
                    for (std::size_t i = 0; i < count; ++i)
                        column.layers.push_back(depth(random_));
                }
                std::vector<glm::vec3> colors;
                std::vector<float> opacities;
                for (std::size_t i = 0; i < count; ++i) {
                    colors.emplace_back(share(random_), share(random_), share(random_));
                    opacities.push_back(share(random_));
                }
                const Image image = drawn(columns, colors, opacities, hidden, linear);
                for (int i = 0; i < kColumns; ++i) {
                    const glm::vec3 wanted = expected(columns[i], colors, opacities, linear);
                    for (int channel = 0; channel < 3; ++channel)
                        EXPECT_NEAR(image.at(kWide * i + kWide / 2, kHigh / 2)[channel],
                                    255 * wanted[channel], 2)
                            << "column " << i;
                }
            }
}

} // namespace
} // namespace isochron::render
