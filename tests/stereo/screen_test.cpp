// Frusta project the corners of screens to the corners of pictures; wrong screens are reported.
#include "stereo/screen.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <glm/gtc/quaternion.hpp>

#include <array>
#include <cmath>
#include <random>

namespace isochron::stereo {
namespace {

using interaction::Pose;

constexpr float kNear = 0.05f, kFar = 50.0f;

class RandomRoom {
  public:
    explicit RandomRoom(unsigned seed) : engine_(seed) {}
    float number(float low, float high) {
        return std::uniform_real_distribution<float>(low, high)(engine_);
    }
    glm::vec3 point(float reach) {
        return {number(-reach, reach), number(-reach, reach), number(-reach, reach)};
    }
    glm::quat orientation() {
        glm::quat q;
        do
            q = glm::quat(number(-1, 1), number(-1, 1), number(-1, 1), number(-1, 1));
        while (glm::dot(q, q) < 0.1f);
        return glm::normalize(q);
    }
    /// A rectangle anywhere, and a head that stands at least 0.3 m in front of it.
    std::pair<Screen, Pose> screen_and_head() {
        const glm::quat turn = orientation();
        const glm::vec3 corner = point(3);
        const float width = number(0.2f, 4), height = number(0.2f, 4);
        Screen screen;
        screen.lower_left = corner;
        screen.upper_left = corner + turn * glm::vec3(0, height, 0);
        screen.upper_right = corner + turn * glm::vec3(width, height, 0);
        const glm::vec3 stand(number(-2, 4), number(-2, 4), number(0.3f, 4));
        return {screen, Pose{corner + turn * stand, orientation()}};
    }

  private:
    std::mt19937 engine_;
};

glm::vec3 ndc(const render::View& view, glm::vec3 room) {
    const glm::vec4 clip = view.clip_from_eye * view.eye_from_room * glm::vec4(room, 1);
    return glm::vec3(clip) / clip.w;
}

void expect_corners_on_corners(const render::View& view, const Screen& screen, float tolerance) {
    const std::array corners{screen.lower_left, screen.upper_left, screen.upper_right,
                             screen.lower_left + screen.upper_right - screen.upper_left};
    const std::array expected{glm::vec2(-1, -1), glm::vec2(-1, 1), glm::vec2(1, 1),
                              glm::vec2(1, -1)};
    for (int i = 0; i < 4; ++i) {
        const glm::vec3 p = ndc(view, corners[i]);
        EXPECT_NEAR(p.x, expected[i].x, tolerance) << "corner " << i;
        EXPECT_NEAR(p.y, expected[i].y, tolerance) << "corner " << i;
    }
}

constexpr unsigned kScreenSeed = 20041;

TEST(Screen, CornersFallOnTheCornersOfThePictureForEveryEye) {
    SCOPED_TRACE(testing::Message() << "seed " << kScreenSeed);
    RandomRoom room(kScreenSeed);
    for (int i = 0; i < 500; ++i) {
        const auto [screen, head] = room.screen_and_head();
        for (const Eye eye : {Eye::center, Eye::left, Eye::right})
            expect_corners_on_corners(view_of(screen, head, eye, 0.08f, kNear, kFar, {640, 480}),
                                      screen, 2e-4f);
    }
}

/// The oracle: the ray from the eye through the point meets the screen's plane; where, measured
/// along the screen's edges, is where the point is seen. No matrix is involved.
TEST(Screen, PointsAreSeenWhereTheirRayMeetsTheScreen) {
    SCOPED_TRACE(testing::Message() << "seed " << kScreenSeed);
    RandomRoom room(kScreenSeed);
    for (int i = 0; i < 500; ++i) {
        const auto [screen, head] = room.screen_and_head();
        const Eye eye = i % 2 ? Eye::left : Eye::right;
        const glm::vec3 from =
            head.position + head.orientation * glm::vec3(eye == Eye::left ? -0.04f : 0.04f, 0, 0);
        const glm::vec3 across = screen.upper_right - screen.upper_left;
        const glm::vec3 upwards = screen.upper_left - screen.lower_left;
        const float u = room.number(-1, 2), v = room.number(-1, 2), t = room.number(0.3f, 3);
        const glm::vec3 on_screen = screen.lower_left + u * across + v * upwards;
        const glm::vec3 seen = ndc(view_of(screen, head, eye, 0.08f, 0.01f, kFar, {640, 480}),
                                   from + t * (on_screen - from));
        EXPECT_NEAR(seen.x, 2 * u - 1, 2e-3f);
        EXPECT_NEAR(seen.y, 2 * v - 1, 2e-3f);
    }
}

TEST(Screen, EyesStandHalfTheSeparationToEachSideOfTheHead) {
    RandomRoom room(kScreenSeed);
    for (int i = 0; i < 50; ++i) {
        const auto [screen, head] = room.screen_and_head();
        const auto at = [&, &s = screen, &h = head](Eye eye) {
            return view_of(s, h, eye, 0.07f, kNear, kFar, {10, 10}).eye_in_room();
        };
        const glm::vec3 right_axis = head.orientation * glm::vec3(1, 0, 0);
        EXPECT_NEAR(glm::dot(at(Eye::right) - at(Eye::left), right_axis), 0.07f, 1e-5f);
        EXPECT_LT(glm::distance(0.5f * (at(Eye::left) + at(Eye::right)), head.position), 1e-5f);
        EXPECT_LT(glm::distance(at(Eye::center), head.position), 1e-5f);
    }
}

TEST(Screen, DepthRunsFromNearToFar) {
    const Screen screen;
    const Pose head{{0.1f, 1.6f, 0.5f}, {1, 0, 0, 0}};
    const render::View view = view_of(screen, head, Eye::left, 0.06f, kNear, kFar, {640, 480});
    const glm::vec3 eye = view.eye_in_room();
    EXPECT_NEAR(ndc(view, eye + glm::vec3(0, 0, -kNear)).z, -1, 1e-4f);
    EXPECT_NEAR(ndc(view, eye + glm::vec3(0, 0, -kFar)).z, 1, 1e-4f);
}

/// What is beside the screen takes its share of the picture, and the screen is as in a picture of
/// its own.
TEST(Screen, AShareOfThePictureBesideItLeavesTheScreenAsItWas) {
    SCOPED_TRACE(testing::Message() << "seed " << kScreenSeed);
    RandomRoom room(kScreenSeed);
    constexpr glm::ivec2 kOwn(600, 480), kBoth(1000, 480);
    for (int i = 0; i < 300; ++i) {
        auto [screen, head] = room.screen_and_head();
        screen.fit_aspect = i % 2 == 0;
        Screen both = screen;
        both.aside = 0.4f;
        const glm::vec3 point = room.point(3);
        const bool parallel = i % 3 == 0;
        const auto seen = [&, &h = head](const Screen& s, glm::ivec2 pixels) {
            const render::View view = parallel
                                          ? parallel_view_of(s, h, 1.5f, kFar, pixels)
                                          : view_of(s, h, Eye::left, 0.06f, kNear, kFar, pixels);
            return (ndc(view, point) * 0.5f + 0.5f) * glm::vec3(pixels, 1);
        };
        const glm::vec3 alone = seen(screen, kOwn), beside = seen(both, kBoth);
        if (std::abs(alone.x) > 1e4f || std::abs(alone.y) > 1e4f)
            continue;                                 // in the eye's own plane
        const float rounded = parallel ? 4.0f : 0.3f; // floats, 500 m from the eye
        EXPECT_NEAR(beside.x, alone.x + 400, rounded + 1e-3f * std::abs(alone.x));
        EXPECT_NEAR(beside.y, alone.y, rounded + 1e-3f * std::abs(alone.y));
    }
}

TEST(Screen, CarriedScreensFollowTheHead) {
    RandomRoom room(kScreenSeed);
    Screen carried;
    carried.lower_left = {-0.5f, -0.4f, -1.0f};
    carried.upper_left = {-0.5f, 0.3f, -1.1f};
    carried.upper_right = {0.6f, 0.3f, -1.1f};
    carried.carried_by_head = true;
    const render::View rest = view_of(carried, Pose{}, Eye::left, 0.06f, kNear, kFar, {64, 48});
    for (int i = 0; i < 100; ++i) {
        const Pose head{room.point(3), room.orientation()};
        const render::View view = view_of(carried, head, Eye::left, 0.06f, kNear, kFar, {64, 48});
        Screen moved = carried;
        for (glm::vec3* corner : {&moved.lower_left, &moved.upper_left, &moved.upper_right})
            *corner = glm::vec3(interaction::room_from(head) * glm::vec4(*corner, 1));
        expect_corners_on_corners(view, moved, 2e-4f);
        for (int column = 0; column < 4; ++column)
            for (int row = 0; row < 4; ++row)
                EXPECT_NEAR(view.clip_from_eye[column][row], rest.clip_from_eye[column][row],
                            1e-4f);
    }
}

TEST(Screen, FittedScreensGrowAboutTheirMiddleSoThatShapesStayRoundAndInView) {
    Screen screen;
    screen.fit_aspect = true;
    const Pose head{{0.2f, 1.5f, 0.7f}, {1, 0, 0, 0}};
    for (const glm::ivec2 pixels : {glm::ivec2(640, 720), glm::ivec2(1920, 480), glm::ivec2(300)}) {
        const render::View view = view_of(screen, head, Eye::center, 0, kNear, kFar, pixels);
        const glm::vec3 middle = 0.5f * (screen.lower_left + screen.upper_right);
        EXPECT_NEAR(ndc(view, middle).x, 0, 1e-5f);
        EXPECT_NEAR(ndc(view, middle).y, 0, 1e-5f);
        const glm::vec3 step = ndc(view, middle + glm::vec3(0.1f, 0.1f, 0));
        EXPECT_NEAR(step.x * static_cast<float>(pixels.x), step.y * static_cast<float>(pixels.y),
                    1e-2f);
        const glm::vec2 corner = glm::abs(glm::vec2(ndc(view, screen.upper_left)));
        EXPECT_NEAR(std::max(corner.x, corner.y), 1, 1e-5f);
    }
}

TEST(Screen, ProjectionStaysFiniteWithTheEyeOnOrBehindTheScreen) {
    const Screen screen;
    for (const float z : {-0.9999f, -1.0f, -1.5f, -30.0f}) {
        const Pose head{{0.1f, 1.5f, z}, {1, 0, 0, 0}};
        const render::View view = view_of(screen, head, Eye::left, 0.06f, kNear, kFar, {64, 48});
        for (int column = 0; column < 4; ++column)
            for (int row = 0; row < 4; ++row) {
                EXPECT_TRUE(std::isfinite(view.clip_from_eye[column][row])) << z;
                EXPECT_TRUE(std::isfinite(view.eye_from_room[column][row])) << z;
            }
        EXPECT_NEAR(view.eye_in_room().z, -1.0f + kNearestEye, 1e-4f);
        expect_corners_on_corners(view, screen, 2e-3f);
    }
}

TEST(ScreenProblems, GoodScreensHaveNone) {
    EXPECT_THAT(problems(Screen{}), testing::IsEmpty());
    RandomRoom room(kScreenSeed);
    const glm::vec2 size = size_of(Screen{});
    EXPECT_NEAR(size.x, 1.6f, 1e-6f);
    EXPECT_NEAR(size.y, 0.9f, 1e-6f);
    Screen floor;
    floor.lower_left = {-1.5f, 0, 1.5f};
    floor.upper_left = {-1.5f, 0, -1.5f};
    floor.upper_right = {1.5f, 0, -1.5f};
    EXPECT_THAT(problems(floor), testing::IsEmpty());
}

TEST(ScreenProblems, EveryKindIsNamed) {
    using testing::ElementsAre;
    using testing::HasSubstr;
    Screen skewed;
    skewed.upper_right.y += 0.1f;
    EXPECT_THAT(problems(skewed), ElementsAre(HasSubstr("expected 90")));
    Screen barely = Screen{};
    barely.upper_right.y += 0.02f; // 0.7 degrees
    EXPECT_THAT(problems(barely), ElementsAre());
    Screen flat;
    flat.upper_right = flat.upper_left;
    EXPECT_THAT(problems(flat), ElementsAre(HasSubstr("0 x 0.9 m")));
    Screen mirrored;
    std::swap(mirrored.upper_left.x, mirrored.upper_right.x);
    mirrored.lower_left.x = mirrored.upper_left.x;
    EXPECT_THAT(problems(mirrored), ElementsAre(HasSubstr("mirrored")));
    Screen carried;
    carried.carried_by_head = true; // corners are in the head's frame, ahead of it
    EXPECT_THAT(problems(carried), ElementsAre());
    for (glm::vec3* corner : {&carried.lower_left, &carried.upper_left, &carried.upper_right})
        corner->z = 1.0f;
    EXPECT_THAT(problems(carried), ElementsAre(HasSubstr("the head")));
    Screen overturned;
    std::swap(overturned.lower_left, overturned.upper_left);
    overturned.upper_right.y = overturned.upper_left.y;
    EXPECT_THAT(problems(overturned), ElementsAre(HasSubstr("mirrored"), HasSubstr("upside down")));
    Screen unknown;
    unknown.lower_left.x = std::nanf("");
    EXPECT_THAT(problems(unknown), ElementsAre(HasSubstr("not a number")));
}

/// Equal things are equally large at every depth, to a fraction of a pixel, and rays meet them.
TEST(Screen, AParallelViewKeepsSizesAtAllDepthsAndItsRaysMeetWhatIsSeen) {
    Screen screen;
    screen.lower_left = {-0.5f, -0.5f, -1.2f};
    screen.upper_left = {-0.5f, 0.5f, -1.2f};
    screen.upper_right = {0.5f, 0.5f, -1.2f};
    screen.carried_by_head = screen.fit_aspect = true;
    const interaction::Pose head{{0.3f, 1.6f, -0.4f},
                                 glm::angleAxis(0.8f, glm::normalize(glm::vec3(1, 2, 0)))};
    const glm::ivec2 pixels(800, 600);
    const render::View view = parallel_view_of(screen, head, 1.5f, 50.0f, pixels);
    const auto pixel = [&](const glm::vec3& in_head) {
        const glm::vec3 p = head.position + head.orientation * in_head;
        const glm::vec4 clip = view.clip_from_eye * view.eye_from_room * glm::vec4(p, 1.0f);
        EXPECT_LT(std::abs(clip.z), clip.w) << "within near and far";
        return (glm::vec2(clip) / clip.w * 0.5f + 0.5f) * glm::vec2(pixels);
    };
    for (const float depth : {-0.3f, -1.2f, -2.0f, -3.0f}) {
        const glm::vec2 a = pixel({-0.25f, 0.1f, depth}), b = pixel({0.25f, 0.1f, depth});
        EXPECT_NEAR(glm::distance(a, b), 240.0f, 1.5f) << depth; // as at 1.5 m in perspective
        const interaction::Pose ray =
            parallel_ray_through(screen, head, 1.5f, pixels, a / glm::vec2(pixels));
        const glm::vec3 p = head.position + head.orientation * glm::vec3(-0.25f, 0.1f, depth);
        const glm::vec3 way = ray.orientation * glm::vec3(0, 0, -1);
        const glm::vec3 off = p - ray.position - glm::dot(p - ray.position, way) * way;
        EXPECT_LT(glm::length(off), 1e-3f);
        EXPECT_GT(glm::dot(p - ray.position, way), 0.0f);
    }
}

} // namespace
} // namespace isochron::stereo
