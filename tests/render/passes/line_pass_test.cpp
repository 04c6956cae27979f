// Lines: their places and widths, and what they hide.
#include "render/gl/render_target.h"
#include "render/passes/line_pass.h"
#include "tests/support/drawing/gl_test.h"
#include "tests/support/test_seed.h"

#include <glm/gtc/matrix_transform.hpp>
#include <glm/vector_relational.hpp>

#include <random>

namespace isochron::render {
namespace {

class Lines : public GlTest {
  protected:
    Lines() {
        view_.size = {100, 100};
        view_.clip_from_eye = glm::perspective(glm::radians(90.0f), 1.0f, 0.1f, 10.0f);
        target_.bind();
        target_.clear({0, 0, 0, 0});
    }
    Image draw(const std::vector<Line>& lines, float width = 3.0f) {
        pass_.draw(view_, glm::mat4(1.0f), lines, width);
        return target_.read();
    }
    View view_;
    RenderTarget target_{gl_, {100, 100}};
    LinePass pass_{gl_};
};

TEST_P(Lines, CoverTheirProjectionAtTheirWidth) {
    const Image image = draw({{{-0.5f, 0.2f, -1.0f}, {0.5f, 0.2f, -1.0f}, {1, 0, 0, 1}}});
    double covered = 0.0;
    for (int y = 0; y < 100; ++y) {
        covered += image.at(50, y)[3] / 255.0;
        if (image.at(50, y)[3] > 0) {
            EXPECT_NEAR(y + 0.5, 40.0, 2.5);
        }
    }
    EXPECT_NEAR(covered, 3.0, 0.3);
    EXPECT_EQ(image.at(50, 40)[0], 255);
    EXPECT_EQ(image.at(20, 40)[3], 0);
    EXPECT_EQ(image.at(80, 40)[3], 0);
}

TEST_P(Lines, ThatPassTheEyeAreCutInFrontOfIt) {
    const Image image = draw({{{0.0f, -0.3f, 1.0f}, {0.0f, -0.3f, -3.0f}, {0, 1, 0, 1}}});
    EXPECT_EQ(image.at(50, 90)[1] > 100 || image.at(49, 90)[1] > 100, true);
    for (int y = 0; y < 50; ++y)
        for (int x = 0; x < 100; ++x)
            ASSERT_EQ(image.at(x, y)[3], 0) << x << ' ' << y;
    target_.clear({0, 0, 0, 0});
    for (const std::uint8_t value : draw({{{0, 0, 1}, {1, 1, 2}, glm::vec4(1)}}).rgba)
        ASSERT_EQ(value, 0);
}

TEST_P(Lines, HideWhatLiesBehindThemAndNothingBesides) {
    draw({{{-0.5f, 0.0f, -1.0f}, {0.5f, 0.0f, -1.0f}, {1, 0, 0, 1}}}, 4.0f);
    const Image image = draw({{{0.0f, -1.0f, -2.0f}, {0.0f, 1.0f, -2.0f}, {0, 1, 0, 1}}}, 4.0f);
    EXPECT_EQ(image.at(50, 50)[1], 0);
    EXPECT_EQ(image.at(50, 50)[0], 255);
    EXPECT_EQ(image.at(50, 40)[1], 255);
    // No dark rim: next to the nearer line's core the farther one shows at full strength.
    for (int y = 30; y < 70; ++y)
        EXPECT_EQ(image.at(50, y)[3], 255) << y;
}

TEST_P(Lines, InFrontOfOthersAreNeverDarkerThanEither) {
    // A light ground, then a slanting line of the default width, then the ground again, farther.
    const auto ground = [] {
        std::vector<Line> lines;
        for (int i = 0; i < 60; ++i)
            lines.push_back(
                {{-3, 0.1f * float(i) - 3, -2}, {3, 0.1f * float(i) - 3, -2}, glm::vec4(1)});
        return lines;
    }();
    draw({{{-0.7f, -0.33f, -1}, {0.7f, 0.41f, -1}, {1, 0.5f, 0, 1}}}, 1.5f);
    const Image image = draw(ground, 8.0f);
    int seen = 0;
    for (int y = 10; y < 90; ++y)
        for (int x = 25; x < 75; ++x) {
            const std::uint8_t* pixel = image.at(x, y);
            EXPECT_EQ(pixel[0], 255) << x << ' ' << y;
            seen += pixel[2] == 0;
        }
    EXPECT_GE(seen, 50); // without a gap in any column
    EXPECT_LE(seen, 120);
}

TEST_P(Lines, OfABoxAreItsTwelveEdges) {
    const BoxLines lines = box_lines({1, 2, 3}, glm::vec4(1), {5, 1, 1});
    ASSERT_EQ(lines.front.size() + lines.outline.size() + lines.back.size(), 12u);
    glm::vec3 total(0.0f);
    for (const auto* part : {&lines.front, &lines.outline, &lines.back})
        for (const Line& line : *part) {
            const glm::vec3 along = glm::abs(line.to - line.from);
            EXPECT_EQ((along.x > 0) + (along.y > 0) + (along.z > 0), 1);
            total += along;
        }
    EXPECT_EQ(total, glm::vec3(4, 8, 12));
}

TEST_P(Lines, OfABoxAreBeforeWhatIsInsideBesideItOrBehind) {
    std::mt19937 random(test_seed());
    std::uniform_real_distribution<float> place(-3.0f, 5.0f), share(0.02f, 0.98f);
    const glm::vec3 extent(1, 2, 3);
    const auto inside = [&](const glm::vec3& at) {
        return glm::all(glm::greaterThan(at, glm::vec3(0))) && glm::all(glm::lessThan(at, extent));
    };
    for (int i = 0; i < 300; ++i) {
        const glm::vec3 eye(place(random), place(random), place(random));
        const BoxLines lines = box_lines(extent, glm::vec4(1), eye);
        if (inside(eye)) {
            EXPECT_EQ(lines.back.size(), 12u);
        }
        // Just before an edge, or just behind it, a ray from the eye is within the box or is not.
        const auto expect = [&](const std::vector<Line>& edges, bool before, bool behind) {
            for (const Line& line : edges) {
                const glm::vec3 at = glm::mix(line.from, line.to, share(random));
                const glm::vec3 step = 1e-3f * glm::normalize(at - eye);
                EXPECT_EQ(inside(at - step), before)
                    << "eye " << eye.x << ' ' << eye.y << ' ' << eye.z << ", edge " << at.x << ' '
                    << at.y << ' ' << at.z;
                EXPECT_EQ(inside(at + step), behind)
                    << "eye " << eye.x << ' ' << eye.y << ' ' << eye.z << ", edge " << at.x << ' '
                    << at.y << ' ' << at.z;
            }
        };
        expect(lines.front, false, true);
        expect(lines.outline, false, false);
        expect(lines.back, true, false);
    }
}

INSTANTIATE_TEST_SUITE_P(, Lines, both_contexts(), context_name);

} // namespace
} // namespace isochron::render
