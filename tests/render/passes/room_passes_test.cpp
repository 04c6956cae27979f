// Pictures on walls and solid models: their places, what they hide, and which way they face.
#include "render/gl/render_target.h"
#include "render/passes/picture_pass.h"
#include "render/passes/solid_pass.h"
#include "tests/support/drawing/gl_test.h"

#include <glm/geometric.hpp>
#include <glm/gtc/constants.hpp>
#include <glm/gtc/matrix_transform.hpp>

namespace isochron::render {
namespace {

/// Volume of a closed surface whose triangles are counter-clockwise from outside: six times it is
/// the sum of the triple products.
float volume(const std::vector<Triangle>& surface) {
    float sum = 0;
    for (const Triangle& t : surface)
        sum += glm::dot(t.corners[0], glm::cross(t.corners[1], t.corners[2]));
    return sum / 6.0f;
}

TEST(Solids, AreClosedAndFaceOutwards) {
    const glm::vec3 low(-0.1f, 0.2f, 0.3f), high(0.4f, 0.6f, 0.5f);
    EXPECT_NEAR(volume(solid_box(low, high, glm::vec3(1))), 0.5f * 0.4f * 0.2f, 1e-6f);
    const float sphere = 4.0f / 3.0f * glm::pi<float>() * 0.2f * 0.3f * 0.4f;
    const float facets = volume(ellipsoid({1, 2, 3}, {0.2f, 0.3f, 0.4f}, glm::vec3(1)));
    EXPECT_LT(facets, sphere);
    EXPECT_GT(facets, 0.93f * sphere);
    const auto sides =
        pyramid({glm::vec3(0, 0, 0), glm::vec3(0, 0, 1), glm::vec3(1, 0, 1), glm::vec3(1, 0, 0)},
                {0.5f, 3.0f, 0.5f}, glm::vec3(1));
    EXPECT_NEAR(volume(sides), 1.0f, 1e-6f) << "the base passes through the origin";
}

class RoomPasses : public GlTest {
  protected:
    RoomPasses() {
        view_.size = {100, 100};
        view_.clip_from_eye = glm::perspective(glm::radians(90.0f), 1.0f, 0.1f, 10.0f);
        target_.bind();
        target_.clear({0, 0, 0, 1});
    }
    /// A square across the middle half of the picture, at a distance.
    static std::array<glm::vec3, 4> square(float distance) {
        const float half = 0.5f * distance;
        return {glm::vec3(-half, -half, -distance), glm::vec3(-half, half, -distance),
                glm::vec3(half, half, -distance), glm::vec3(half, -half, -distance)};
    }
    /// A picture whose lower left quarter alone is of a color.
    RenderTarget picture(glm::vec4 rest, glm::vec4 lower_left) {
        RenderTarget made(gl_, {10, 10});
        made.clear(rest);
        made.bind();
        gl_.Enable(GL_SCISSOR_TEST);
        gl_.Scissor(0, 0, 5, 5);
        gl_.ClearColor(lower_left.x, lower_left.y, lower_left.z, 1);
        gl_.Clear(GL_COLOR_BUFFER_BIT);
        gl_.Disable(GL_SCISSOR_TEST);
        target_.bind();
        return made;
    }
    std::array<int, 3> rgb(int x, int y) {
        const Image image = target_.read();
        return {image.at(x, y)[0], image.at(x, y)[1], image.at(x, y)[2]};
    }
    using Rgb = std::array<int, 3>;

    View view_;
    RenderTarget target_{gl_, {100, 100}};
    PicturePass pictures_{gl_};
    SolidPass solids_{gl_};
};

TEST_P(RoomPasses, APictureStandsUprightBetweenItsCorners) {
    const RenderTarget shown = picture({1, 0, 0, 1}, {0, 1, 0, 1});
    pictures_.draw(view_, square(2), shown.color_texture(), 1.0f);
    EXPECT_EQ(rgb(30, 70), (Rgb{0, 255, 0})) << "lower left";
    EXPECT_EQ(rgb(70, 70), (Rgb{255, 0, 0}));
    EXPECT_EQ(rgb(30, 30), (Rgb{255, 0, 0}));
    EXPECT_EQ(rgb(20, 50), (Rgb{0, 0, 0})) << "beside it";
}

TEST_P(RoomPasses, OpaquePicturesHideWhatLiesBehindAndGlassDoesNot) {
    const RenderTarget red = picture({1, 0, 0, 1}, {1, 0, 0, 1});
    const RenderTarget blue = picture({0, 0, 1, 1}, {0, 0, 1, 1});
    pictures_.draw(view_, square(2), red.color_texture(), 1.0f);
    pictures_.draw(view_, square(3), blue.color_texture(), 1.0f);
    EXPECT_EQ(rgb(50, 50), (Rgb{255, 0, 0}));
    pictures_.draw(view_, square(1), blue.color_texture(), 0.4f);
    EXPECT_NEAR(rgb(50, 50)[0], 203, 1) << "light adds up: 0.6 of it";
    EXPECT_NEAR(rgb(50, 50)[2], 170, 1) << "0.4 of it";
    pictures_.draw(view_, square(1.5f), red.color_texture(), 1.0f);
    EXPECT_EQ(rgb(50, 50), (Rgb{255, 0, 0})) << "glass writes no depth";
}

TEST_P(RoomPasses, FacetsAreAsBrightAsTheyFaceTheEyeAndHideEachOther) {
    solids_.draw(view_, glm::translate(glm::mat4(1.0f), glm::vec3(0, 0, -3)),
                 ellipsoid({0, 0, 0}, glm::vec3(1), {1, 0.5f, 0}));
    const Rgb middle = rgb(50, 50), rim = rgb(36, 50);
    EXPECT_GT(middle[0], 240);
    EXPECT_NEAR(middle[1], middle[0] / 2.0, 2);
    EXPECT_LT(rim[0], middle[0] - 40);
    EXPECT_GT(rim[0], 60) << "nothing is black";
    solids_.draw(view_, glm::mat4(1.0f), solid_box({-1, -1, -6}, {1, 1, -5}, {0, 0, 1}));
    EXPECT_EQ(rgb(50, 50), middle) << "what lies behind stays there";
}

INSTANTIATE_TEST_SUITE_P(, RoomPasses, both_contexts(), context_name);

} // namespace
} // namespace isochron::render
