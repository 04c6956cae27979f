// Darkening of a picture.
#include "render/gl/render_target.h"
#include "render/gl/srgb.h"
#include "render/passes/veil_pass.h"
#include "tests/support/drawing/gl_test.h"

namespace isochron::render {
namespace {

class Veils : public GlTest {
  protected:
    /// White, with a veil over its right half.
    Image veiled(const Veil& veil) {
        target_.bind();
        target_.clear({1, 1, 1, 1});
        gl_.Enable(GL_DEPTH_TEST);
        View view;
        view.corner = {50, 0};
        view.size = {50, 50};
        VeilPass(gl_).draw(view, veil);
        return target_.read();
    }
    RenderTarget target_{gl_, {100, 50}};
};

TEST_P(Veils, LeaveTheRestAndNothingOfItAlone) {
    EXPECT_EQ(veiled({}).at(75, 25)[0], 255);
    const Image half = veiled({.whole = 0.5f});
    EXPECT_EQ(half.at(25, 25)[0], 255);
    EXPECT_NEAR(half.at(75, 25)[0], 255.0f * srgb_from_linear(0.5f), 1);
    EXPECT_EQ(veiled({.whole = 1.0f}).at(99, 49)[2], 0);
}

TEST_P(Veils, OfTheRimSpareTheMiddle) {
    const Image image = veiled({.rim = 1.0f});
    EXPECT_EQ(image.at(75, 25)[1], 255);
    EXPECT_EQ(image.at(51, 1)[1], 0);
    EXPECT_EQ(image.at(98, 48)[1], 0);
    EXPECT_EQ(image.at(49, 48)[1], 255) << "another viewport's corner";
    EXPECT_LT(image.at(53, 25)[1], 255);
    EXPECT_GT(image.at(53, 25)[1], 0);
}

INSTANTIATE_TEST_SUITE_P(, Veils, both_contexts(), context_name);

} // namespace
} // namespace isochron::render
