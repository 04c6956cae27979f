// The offscreen target: orientation, size and color.
#include "render/gl/render_target.h"
#include "tests/support/drawing/gl_test.h"

namespace isochron::render {
namespace {

class RenderTargets : public GlTest {};

TEST_P(RenderTargets, AreReadTopRowFirst) {
    RenderTarget target(gl_, {5, 3});
    target.bind();
    target.clear({0, 0, 0, 1});
    gl_.Enable(GL_SCISSOR_TEST);
    gl_.Scissor(0, 2, 1, 1); // the upper left pixel, in GL's rows
    gl_.ClearColor(1.0f, 0.5f, 0.0f, 1.0f);
    gl_.Clear(GL_COLOR_BUFFER_BIT);
    const Image image = target.read();
    ASSERT_EQ(image.rgba.size(), 60u);
    EXPECT_EQ(image.at(0, 0)[0], 255);
    EXPECT_NEAR(image.at(0, 0)[1], 188, 1); // half the light of white
    EXPECT_EQ(image.at(0, 2)[0], 0);
    EXPECT_EQ(image.at(1, 0)[0], 0);
}

TEST_P(RenderTargets, ClearWhateverMasksAndScissorAreSet) {
    RenderTarget target(gl_, {4, 4});
    gl_.Enable(GL_SCISSOR_TEST);
    gl_.Scissor(0, 0, 1, 1);
    gl_.ColorMask(GL_FALSE, GL_FALSE, GL_FALSE, GL_FALSE);
    gl_.DepthMask(GL_FALSE);
    target.clear({0, 0, 1, 1});
    EXPECT_EQ(target.read().at(3, 0)[2], 255);
}

TEST_P(RenderTargets, TakeANewSize) {
    RenderTarget target(gl_, {4, 4});
    target.resize({70, 30});
    target.bind();
    GLint viewport[4];
    gl_.GetIntegerv(GL_VIEWPORT, viewport);
    EXPECT_EQ(viewport[2], 70);
    EXPECT_EQ(viewport[3], 30);
    target.clear({0, 1, 0, 1});
    const Image image = target.read();
    EXPECT_EQ(image.width, 70);
    EXPECT_EQ(image.height, 30);
    EXPECT_EQ(image.at(69, 29)[1], 255);
}

TEST_P(RenderTargets, OfNoSizeAreAnErrorThatGivesIt) {
    try {
        RenderTarget target(gl_, {0, 30});
        FAIL() << "no error";
    } catch (const Error& error) {
        EXPECT_NE(std::string(error.what()).find("0x30"), std::string::npos) << error.what();
    }
}

INSTANTIATE_TEST_SUITE_P(, RenderTargets, both_contexts(), context_name);

} // namespace
} // namespace isochron::render
