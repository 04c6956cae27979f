// Labels along the box: none covers another in either eye, and none is left out without need.
#include "app/scene/axis_labels.h"

#include "app/scene/font.h"
#include "app/scene/legend.h"
#include "tests/support/test_seed.h"

#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/vector_relational.hpp>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <random>
#include <set>

namespace isochron::app {
namespace {

constexpr glm::ivec2 kPicture(1280, 960);

/// A box of which each number tells which axis it belongs to: by its decade.
index::SeriesInfo info_of_labeled_box() {
    index::SeriesInfo info;
    info.length_unit = "mm";
    info.grid.vertices = {11, 21, 31};
    info.grid.spacing = {1.0, 10.0, 100.0};
    info.grid.origin = {0.0, 0.0, 0.0};
    return info;
}

/// A cube of 1.5 m, since the grid's sides are equally long in the room.
render::Placement cube_of(const index::SeriesInfo& info) {
    render::Placement placement;
    for (int axis = 0; axis < 3; ++axis)
        placement.extent[axis] = static_cast<float>(info.grid.vertices[axis] - 1);
    placement.room_from_index = glm::translate(glm::mat4(1.0f), glm::vec3(-0.75f, 0.85f, -3.75f));
    placement.room_from_index =
        glm::scale(placement.room_from_index, glm::vec3(1.5f) / placement.extent);
    return placement;
}
constexpr glm::vec3 kMiddle(0.0f, 1.6f, -3.0f);

/// Two eyes of a head that looks at the cube.
struct Looking {
    explicit Looking(const glm::vec3& position) {
        const glm::mat4 eye = glm::lookAt(position, kMiddle, glm::vec3(0, 1, 0));
        head = {position, glm::conjugate(glm::quat_cast(glm::mat3(eye)))};
        for (const float side : {0.5f, -0.5f})
            views.push_back(
                {.clip_from_eye = glm::perspective(glm::radians(50.0f), 4.0f / 3, 0.05f, 50.0f),
                 .eye_from_room =
                     glm::translate(glm::mat4(1.0f), glm::vec3(side * 0.063f, 0, 0)) * eye,
                 .size = kPicture});
    }
    interaction::Pose head;
    std::vector<render::View> views;
};

class AxisLabelsTest : public testing::Test {
  protected:
    std::vector<render::Label> shown(const Looking& from, const std::vector<Covered>& taken = {}) {
        axes_ = axes_for(info_, placement_, from.head, from.views);
        return labels_with_room(axes_.labels, atlas_, placement_, from.views, 0.0f, taken);
    }
    /// Whether the two texts cover a common pixel in a view, worked out anew.
    bool overlap(const render::Label& a, const render::Label& b, const render::View& view) const {
        const float height = text_height(view.size);
        const auto box = [&](const render::Label& label) {
            const glm::vec4 clip = view.clip_from_eye * view.eye_from_room *
                                   placement_.room_from_index * glm::vec4(label.at, 1.0f);
            const float width = height * render::text_width(atlas_, label.text);
            const float x = (clip.x / clip.w + 1) / 2 * static_cast<float>(view.size.x) +
                            height * label.offset.x - label.anchor.x * width;
            const float y = (clip.y / clip.w + 1) / 2 * static_cast<float>(view.size.y) +
                            height * label.offset.y - label.anchor.y * height;
            return std::array{x, y, x + width, y + height};
        };
        const auto p = box(a), q = box(b);
        return p[0] < q[2] && q[0] < p[2] && p[1] < q[3] && q[1] < p[3];
    }

    index::SeriesInfo info_ = info_of_labeled_box();
    render::Placement placement_ = cube_of(info_);
    render::GlyphAtlas atlas_ = room_font(32);
    Axes axes_;
};

TEST_F(AxisLabelsTest, NeverCoverEachOtherInEitherEye) {
    std::mt19937 random(test_seed());
    std::uniform_real_distribution<float> share(-1.0f, 1.0f);
    std::size_t without_care = 0, kept = 0, all = 0;
    for (int i = 0; i < 400; ++i) {
        const glm::vec3 direction(share(random), share(random), share(random));
        const Looking from(kMiddle + (3.0f + share(random)) * glm::normalize(direction));
        const auto labels = shown(from);
        std::vector<render::Label> every;
        for (const AxisLabels& axis : axes_.labels) {
            every.push_back(axis.title);
            for (const auto& number : axis.numbers)
                every.push_back(number.label);
        }
        for (const render::View& view : from.views) {
            for (std::size_t a = 0; a < labels.size(); ++a)
                for (std::size_t b = 0; b < a; ++b)
                    ASSERT_FALSE(overlap(labels[a], labels[b], view))
                        << labels[a].text << " and " << labels[b].text << " from " << i;
            for (std::size_t a = 0; a < every.size(); ++a)
                for (std::size_t b = 0; b < a; ++b)
                    without_care += overlap(every[a], every[b], view);
        }
        kept += labels.size();
        all += every.size();
    }
    EXPECT_GT(without_care, 100u) << "there is something to see to";
    EXPECT_GT(kept, all * 4 / 5) << "most labels have room, of " << all;
}

TEST_F(AxisLabelsTest, NeverCoverWordsInACorner) {
    const glm::vec2 picture(kPicture), words(0.2f * picture.x, 0.5f * picture.y);
    std::mt19937 random(test_seed());
    std::uniform_real_distribution<float> share(-1.0f, 1.0f);
    std::size_t hidden = 0, titles = 0, titles_without = 0;
    constexpr int kRounds = 100;
    for (int i = 0; i < kRounds; ++i) {
        const glm::vec3 direction(share(random), share(random), share(random));
        const Looking from(kMiddle + (2.5f + 0.5f * share(random)) * glm::normalize(direction));
        for (const glm::vec2 corner :
             {glm::vec2(0, 0), glm::vec2(1, 0), glm::vec2(0, 1), glm::vec2(1, 1)}) {
            const glm::vec2 low = corner * (picture - words);
            const auto over = [&](const std::vector<render::Label>& labels) {
                std::size_t count = 0;
                for (const render::Label& label : labels)
                    for (const render::View& view : from.views) {
                        const auto box = covered_by(label, text_height(view.size), atlas_,
                                                    view.clip_from_eye * view.eye_from_room *
                                                        placement_.room_from_index,
                                                    view.size);
                        count += box && box->low.x < low.x + words.x && box->high.x > low.x &&
                                 box->low.y < low.y + words.y && box->high.y > low.y;
                    }
                return count;
            };
            const auto without = shown(from);
            hidden += over(without);
            const auto labels = shown(from, {Covered(2, TextRectangle{low, low + words})});
            ASSERT_EQ(over(labels), 0u) << "round " << i;
            for (const AxisLabels& axis : axes_.labels) {
                titles += std::ranges::count(labels, axis.title.text, &render::Label::text);
                titles_without +=
                    std::ranges::count(without, axis.title.text, &render::Label::text);
            }
        }
    }
    EXPECT_GT(hidden, 100u) << "there is something to see to";
    EXPECT_GT(titles, titles_without * 17 / 20) << "most titles have room, of " << titles_without;
}

TEST_F(AxisLabelsTest, HaveTheirTitlesAndAllThatDoNotMeet) {
    const Looking from(kMiddle + glm::vec3(1.6f, 1.1f, 2.6f));
    std::multiset<std::string> texts;
    for (const render::Label& label : shown(from))
        texts.insert(label.text);
    for (const char* title : {"x [mm]", "y [mm]", "z [mm]"})
        EXPECT_EQ(texts.count(title), 1u) << title;
    for (const char* number : {"2", "4", "6", "8", "50", "100", "150", "1000", "2000"})
        EXPECT_EQ(texts.count(number), 1u) << number;
}

TEST_F(AxisLabelsTest, ThinOutEvenlyFarAway) {
    std::size_t before = 6; // 0 to 10 by 2
    for (const float distance : {3.2f, 8.0f, 14.0f, 24.0f}) {
        const Looking from(kMiddle + distance * glm::normalize(glm::vec3(1.6f, 0.9f, 2.6f)));
        std::set<int> of_x;
        for (const render::Label& label : shown(from))
            for (const char* number : {"2", "4", "6", "8", "10"})
                if (label.text == number)
                    of_x.insert(std::stoi(number));
        ASSERT_FALSE(of_x.empty()) << distance;
        for (const int number : of_x)
            EXPECT_EQ(number % *of_x.begin(), 0) << "from " << distance << " m";
        EXPECT_LE(of_x.size(), before) << distance;
        before = of_x.size();
    }
    EXPECT_LT(before, 3u) << "far away there is room for few";
}

TEST_F(AxisLabelsTest, AreNeverCutAndAreATitleAndTwoNumbersOfEachAxisFromNearAndFar) {
    std::mt19937 random(test_seed());
    std::uniform_real_distribution<float> share(-1.0f, 1.0f);
    int axes = 0, near = 0, lacking = 0;
    for (int i = 0; i < 400; ++i) {
        const glm::vec3 direction(share(random), share(random), share(random));
        const float distance = 2.6f + 1.2f * share(random); // nearer than 2, parts are not seen
        const Looking from(kMiddle + distance * glm::normalize(direction));
        const auto labels = shown(from);
        for (const render::Label& label : labels)
            for (const render::View& view : from.views) {
                const auto covered =
                    covered_by(label, text_height(view.size), atlas_,
                               view.clip_from_eye * view.eye_from_room * placement_.room_from_index,
                               view.size);
                ASSERT_TRUE(covered) << label.text;
                EXPECT_GE(std::min(covered->low.x, covered->low.y), 0) << label.text << ", " << i;
                EXPECT_LE(covered->high.x, kPicture.x) << label.text << ", " << i;
                EXPECT_LE(covered->high.y, kPicture.y) << label.text << ", " << i;
            }
        for (const AxisLabels& axis : axes_.labels) {
            const auto shows = [&](const render::Label& asked) {
                return std::ranges::any_of(labels, [&](const render::Label& label) {
                    return label.text == asked.text && label.at == asked.at;
                });
            };
            // An axis that is seen along its length has no room for two numbers.
            const auto on_screen = [&](const glm::vec3& at) {
                const glm::vec4 clip = from.views[0].clip_from_eye * from.views[0].eye_from_room *
                                       placement_.room_from_index * glm::vec4(at, 1.0f);
                return (0.5f * glm::vec2(clip) / clip.w + 0.5f) * glm::vec2(kPicture);
            };
            const auto& numbers = axis.numbers;
            std::vector<glm::vec2> inside;
            for (const auto& number : numbers)
                if (const glm::vec2 at = on_screen(number.label.at);
                    glm::all(glm::greaterThan(at, glm::vec2(120))) &&
                    glm::all(glm::lessThan(at, glm::vec2(kPicture - 120))))
                    inside.push_back(at);
            if (inside.size() < 2 || glm::distance(inside.front(), inside.back()) < 150)
                continue;
            ++axes;
            near += distance < 2 ? 1 : 0;
            EXPECT_TRUE(shows(axis.title)) << axis.title.text << " from " << i;
            lacking += std::ranges::count_if(
                           numbers, [&](const auto& number) { return shows(number.label); }) < 2
                           ? 1
                           : 0;
        }
    }
    EXPECT_GT(axes, 300);
    EXPECT_GT(near, 0);
    EXPECT_LE(lacking, axes / 100) << "where three axes meet in a corner";
}

TEST_F(AxisLabelsTest, BehindTheEyeTakeNoRoom) {
    const render::Label label{.text = "0", .at = {0, 0, 0}};
    const glm::mat4 clip = glm::perspective(1.0f, 1.0f, 0.1f, 10.0f);
    const auto behind = glm::translate(clip, glm::vec3(0, 0, 1));
    EXPECT_FALSE(covered_by(label, 20, atlas_, behind, {100, 100}));
    const auto before = covered_by(label, 20, atlas_, glm::translate(clip, {0, 0, -1}), {100, 100});
    ASSERT_TRUE(before);
    EXPECT_NEAR(0.5f * (before->low.x + before->high.x), 50, 1e-3);
    EXPECT_NEAR(before->high.y - before->low.y, 20, 1e-3);
}

} // namespace
} // namespace isochron::app
