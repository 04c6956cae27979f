// What is behind the data stands still in the room.
#include "render/gl/render_target.h"
#include "render/gl/srgb.h"
#include "render/passes/background_pass.h"
#include "tests/support/drawing/gl_test.h"

#include <glm/ext/matrix_clip_space.hpp>
#include <glm/ext/matrix_transform.hpp>
#include <glm/matrix.hpp>

#include <cmath>

namespace isochron::render {
namespace {

class Backgrounds : public GlTest {
  protected:
    static constexpr glm::ivec2 kSize{96, 64};
    static constexpr BackgroundColors kSky{{0.1f, 0.1f, 0.1f}, {0.2f, 0.6f, 0.9f}};

    Image drawn(const View& view, const BackgroundColors& colors) {
        target_.bind();
        target_.clear({1, 0, 0, 1});
        BackgroundPass(gl_).draw(view, colors);
        return target_.read();
    }
    /// What a direction of this height shows, by the formula.
    static float green(float height) {
        const float t = glm::clamp((height + 0.7f) / 1.4f, 0.0f, 1.0f);
        const float share = t * t * (3 - 2 * t);
        return 255.0f * srgb_from_linear(glm::mix(linear_from_srgb(kSky.low.y),
                                                  linear_from_srgb(kSky.high.y), share));
    }
    RenderTarget target_{gl_, kSize};
};

TEST_P(Backgrounds, GoByTheHeightOfEveryRayForAnyFrustumAndHead) {
    const glm::mat4 off_axis = glm::frustum(-0.2f, 0.9f, -0.5f, 0.3f, 1.0f, 50.0f);
    const glm::mat4 tilted = glm::lookAt(glm::vec3(1, 2, 3), glm::vec3(2, 1.2f, -1),
                                         glm::normalize(glm::vec3(0.3f, 1, 0)));
    for (const glm::mat4& frustum : {off_axis, glm::perspective(1.2f, 1.5f, 0.1f, 10.0f)}) {
        const View view{.clip_from_eye = frustum, .eye_from_room = tilted, .size = kSize};
        const Image image = drawn(view, kSky);
        const glm::mat4 room_from_clip = glm::inverse(frustum * tilted);
        for (int y = 0; y < kSize.y; y += 7)
            for (int x = 0; x < kSize.x; x += 11) {
                const glm::vec2 at = 2.0f * (glm::vec2(x, y) + 0.5f) / glm::vec2(kSize) - 1.0f;
                const glm::vec4 end = room_from_clip * glm::vec4(at, 0.5f, 1.0f);
                const glm::vec3 ray = glm::normalize(glm::vec3(end) / end.w - view.eye_in_room());
                EXPECT_NEAR(image.at(x, kSize.y - 1 - y)[1], green(ray.y), 2) << x << ' ' << y;
            }
    }
}

TEST_P(Backgrounds, CoverTheirViewAloneAndHideNothing) {
    View view{.clip_from_eye = glm::perspective(1.0f, 1.0f, 0.1f, 10.0f),
              .eye_from_room = glm::mat4(1.0f),
              .size = {48, 64}};
    view.corner = {48, 0};
    const Image image = drawn(view, {glm::vec3(0.5f), glm::vec3(0.5f)});
    EXPECT_EQ(image.at(20, 30)[0], 255);
    EXPECT_EQ(image.at(20, 30)[1], 0);
    for (const glm::ivec2 at : {glm::ivec2(50, 2), {94, 61}, {70, 32}})
        EXPECT_NEAR(image.at(at.x, at.y)[1], 128, 1);
    EXPECT_TRUE(gl_.IsEnabled(GL_DEPTH_TEST));
}

INSTANTIATE_TEST_SUITE_P(, Backgrounds, both_contexts(), context_name);

} // namespace
} // namespace isochron::render
