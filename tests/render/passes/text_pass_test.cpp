// Text: its place, its reading direction, what hides it and what it hides.
#include "render/passes/text_pass.h"

#include "render/gl/render_target.h"
#include "render/gl/srgb.h"
#include "render/passes/line_pass.h"
#include "tests/support/drawing/gl_test.h"

#include <glm/gtc/matrix_transform.hpp>

namespace isochron::render {
namespace {

/// Two characters of 8 x 8 texels: `L`, its left column and its bottom row, and a full block `#`.
GlyphAtlas two_letters() {
    GlyphAtlas atlas{
        .size = {32, 16}, .coverage = std::vector<std::uint8_t>(512, 0), .halo = {}, .glyphs = {}};
    for (int y = 0; y < 8; ++y)
        for (int x = 0; x < 8; ++x) {
            atlas.coverage[32 * (y + 4) + x + 4] = x < 2 || y >= 6 ? 255 : 0;
            atlas.coverage[32 * (y + 4) + x + 20] = 255;
        }
    const auto glyph = [](float left) {
        return Glyph{.low = {-0.5f, -0.5f}, // half the height of a letter is margin
                     .high = {1.5f, 1.5f},
                     .texture_low = {(left - 4) / 32, 0},
                     .texture_high = {(left + 12) / 32, 1},
                     .advance = 1.25f};
    };
    atlas.glyphs = {{U'L', glyph(4)}, {U'#', glyph(20)}};
    return atlas;
}

class Texts : public GlTest {
  protected:
    Texts() {
        view_.size = {100, 100};
        view_.clip_from_eye = glm::perspective(glm::radians(90.0f), 1.0f, 0.1f, 100.0f);
        target_.bind();
        target_.clear({0, 0, 0, 1});
    }
    Image draw(const Label& label, float height = 16.0f) {
        std::vector<ScreenQuad> quads;
        pass_.set(label, height, quads);
        pass_.draw(view_, glm::mat4(1.0f), quads);
        return target_.read();
    }
    View view_;
    RenderTarget target_{gl_, {100, 100}};
    TextPass pass_{gl_, two_letters()};
};

TEST_P(Texts, StandUprightAtTheirPlaceWhereverTheyAreSeenFrom) {
    // From in front, and from behind, where a texture on the wall would be mirrored.
    for (const float side : {1.0f, -1.0f}) {
        target_.clear({0, 0, 0, 1});
        view_.eye_from_room = glm::lookAt(glm::vec3(0, 0, 2 * side), glm::vec3(0), {0, 1, 0});
        const Image image = draw({.text = "L", .at = {0, 0, 0}, .anchor = {0.5f, 0.5f}});
        EXPECT_GT(image.at(43, 50)[0], 200); // its stem is on the left,
        EXPECT_GT(image.at(55, 56)[0], 200); // its foot at the bottom,
        EXPECT_LT(image.at(55, 45)[0], 20);  // and nothing at the upper right
    }
}

TEST_P(Texts, AreAsHighAsAskedAtAnyDistance) {
    for (const float distance : {1.0f, 30.0f}) {
        target_.clear({0, 0, 0, 1});
        const Image image = draw({.text = "#", .at = {0, 0, -distance}});
        double covered = 0;
        for (int y = 0; y < 100; ++y)
            covered += linear_from_srgb(static_cast<float>(image.at(50, y)[0]) / 255.0f);
        EXPECT_NEAR(covered, 16, 0.5) << distance;
    }
}

TEST_P(Texts, HaveTheDisparityOfTheirPlace) {
    constexpr float kApart = 0.2f;
    std::array<double, 2> middle{};
    for (const int eye : {0, 1}) {
        target_.clear({0, 0, 0, 1});
        view_.eye_from_room =
            glm::translate(glm::mat4(1.0f), {(eye == 0 ? 0.5f : -0.5f) * kApart, 0, 0});
        const Image image = draw({.text = "#", .at = {0.03f, 0, -4}});
        double weight = 0;
        for (int x = 0; x < 100; ++x) {
            const double light = linear_from_srgb(static_cast<float>(image.at(x, 50)[0]) / 255.0f);
            middle[eye] += (x + 0.5) * light;
            weight += light;
        }
        middle[eye] /= weight;
    }
    // 90 degrees wide: half the picture is as wide as the distance.
    EXPECT_NEAR(middle[0] - middle[1], kApart / 4 * 50, 0.1);
}

TEST_P(Texts, AreHiddenByWhatIsNearerAndHideWhatIsFarther) {
    LinePass lines(gl_);
    const std::vector<Line> near{{{-1, 0, -1}, {1, 0, -1}, {1, 0, 0, 1}}};
    const std::vector<Line> far{{{-9, 0, -9}, {9, 0, -9}, {0, 0, 1, 1}}};
    lines.draw(view_, glm::mat4(1.0f), near, 5.0f);
    draw({.text = "#", .at = {0, 0, -3}, .color = {0, 1, 0, 1}});
    lines.draw(view_, glm::mat4(1.0f), far, 9.0f);
    const Image image = target_.read();
    EXPECT_EQ(image.at(50, 50)[0], 255);
    EXPECT_EQ(image.at(50, 50)[1], 0);
    EXPECT_EQ(image.at(50, 46)[1], 255); // above the nearer line, over the farther one
    EXPECT_EQ(image.at(50, 46)[2], 0);
    EXPECT_EQ(image.at(20, 47)[2], 255);
}

TEST_P(Texts, BehindTheEyeAreNotSeen) {
    for (const std::uint8_t value : draw({.text = "#", .at = {0, 0, 2}}).rgba)
        ASSERT_TRUE(value == 0 || value == 255);
    EXPECT_EQ(target_.read().at(50, 50)[0], 0);
}

TEST_P(Texts, InPixelsLieExactlyThere) {
    std::vector<ScreenQuad> quads;
    pass_.fill({10, 20, 0}, {0, 0}, {5, 3}, {1, 1, 1, 1}, quads);
    pass_.draw(pixel_view(view_), glm::mat4(1.0f), quads, TextPass::Depth::none);
    const Image image = target_.read();
    int covered = 0;
    for (int y = 0; y < 100; ++y)
        for (int x = 0; x < 100; ++x)
            covered += image.at(x, y)[0] > 0;
    EXPECT_EQ(covered, 15);
    EXPECT_EQ(image.at(10, 79)[0], 255);
    EXPECT_EQ(image.at(14, 77)[0], 255);
}

INSTANTIATE_TEST_SUITE_P(, Texts, both_contexts(), context_name);

TEST(Characters, AreDecodedFromUtf8AndNothingElse) {
    EXPECT_EQ(characters("a\xc2\xb5m\xe2\x82\x83\xf0\x9f\x98\x80"), U"aµm₃😀");
    EXPECT_EQ(characters("\xff"
                         "a"),
              U"\xfffd"
              U"a");
    EXPECT_EQ(characters("a\xe2\x82"), U"a\xfffd");
}

} // namespace
} // namespace isochron::render
