// The test pattern: each eye has its letter, and the cross is at its place, in every mode and on
// every wall.
#include "tests/support/drawing/golden_fixture.h"

#include "app/loop/pattern_show.h"

#include <array>
#include <map>
#include <string>

namespace isochron::app {
namespace {

constexpr glm::ivec2 kSize(480, 360);

interaction::InputState head_at(glm::vec3 position) {
    interaction::InputState input = head_at_rest(0);
    input.devices.front().pose->position = position;
    return input;
}

Config pattern_config(StereoMode mode) {
    Config config = one_window(mode, kSize);
    config.installation.viewers.front().position = {0.0f, 1.5f, 0.0f};
    return config;
}

/// Pixels of an eye's picture as a window shows them: channels that belong to another eye are none.
using Channel = std::optional<std::uint8_t>;
struct Shown {
    glm::ivec2 size;
    std::function<Channel(int x, int y, int channel)> at;
};

/// What a window's mode gives to the eye in a place, by what the mode is documented to be.
Shown shown_to(Eye place, const Image& window, StereoMode mode) {
    const bool right = place == Eye::right;
    const glm::ivec2 size(window.width, window.height);
    const auto sieve = [&](auto belongs) {
        return Shown{size, [&window, belongs, right](int x, int y, int channel) -> Channel {
                         if (belongs(x, y, channel) != right)
                             return std::nullopt;
                         return window.at(x, y)[channel];
                     }};
    };
    const auto part = [&](glm::ivec2 corner, glm::ivec2 part_size) {
        return Shown{part_size, [&window, corner](int x, int y, int channel) -> Channel {
                         return window.at(corner.x + x, corner.y + y)[channel];
                     }};
    };
    switch (upright(mode)) {
    case StereoMode::side_by_side: return part({right ? size.x / 2 : 0, 0}, {size.x / 2, size.y});
    case StereoMode::top_bottom: return part({0, right ? size.y / 2 : 0}, {size.x, size.y / 2});
    case StereoMode::anaglyph_red_cyan:
        return sieve([](int, int, int channel) { return channel > 0; });
    case StereoMode::vertical_interlaced: return sieve([](int, int y, int) { return y % 2 == 1; });
    case StereoMode::horizontal_interlaced:
        return sieve([](int x, int, int) { return x % 2 == 1; });
    case StereoMode::checkerboard: return sieve([](int x, int y, int) { return (x + y) % 2 == 1; });
    default: return part({0, 0}, size);
    }
}

/// Share of a part of a letter's box that is as bright as its strokes.
/// @param low, high of the part, in heights of the letter from the letter's lower left
double ink(const Shown& picture, Eye letter, glm::vec2 low, glm::vec2 high) {
    constexpr float kHeight = 0.26f;
    constexpr double kAspect = 1.5; // aspect of the wall
    int bright = 0, seen = 0;
    const glm::vec2 middle = letter_place(letter);
    for (int y = 0; y < picture.size.y; ++y)
        for (int x = 0; x < picture.size.x; ++x) {
            const glm::vec2 from_top = (glm::vec2(x, y) + 0.5f) / glm::vec2(picture.size);
            const glm::vec2 place(from_top.x, 1.0f - from_top.y);
            const glm::vec2 at((place.x - middle.x) / kHeight * kAspect + 0.3,
                               (place.y - middle.y) / kHeight + 0.5);
            if (at.x < low.x || at.x > high.x || at.y < low.y || at.y > high.y)
                continue;
            for (int channel = 0; channel < 3; ++channel)
                if (const Channel value = picture.at(x, y, channel)) {
                    ++seen;
                    bright += *value > 230;
                }
        }
    EXPECT_GT(seen, 20);
    return static_cast<double>(bright) / seen;
}

/// That the picture shows this eye's letter, by its strokes, and nothing of the other's.
void expect_letter(const Shown& picture, Eye eye) {
    EXPECT_GT(ink(picture, eye, {-0.03f, 0.1f}, {0.03f, 0.9f}), 0.9) << "the stem";
    if (eye == Eye::left) {
        EXPECT_GT(ink(picture, eye, {0.1f, -0.04f}, {0.55f, 0.04f}), 0.8) << "the foot";
        EXPECT_LT(ink(picture, eye, {0.2f, 0.3f}, {0.7f, 1.1f}), 0.05);
    } else if (eye == Eye::right) {
        EXPECT_GT(ink(picture, eye, {0.1f, 0.96f}, {0.45f, 1.04f}), 0.8) << "the bow";
        EXPECT_LT(ink(picture, eye, {0.2f, -0.04f}, {0.35f, 0.04f}), 0.2);
    }
    for (const Eye other : {Eye::left, Eye::right})
        if (other != eye) {
            EXPECT_LT(ink(picture, other, {-0.1f, -0.1f}, {0.7f, 1.1f}), 0.02)
                << name_of(other) << " in the " << name_of(eye) << " eye";
        }
}

/// Where the cross is: the middle of all that has its color, of which the label is left out.
glm::dvec2 cross_in(const Image& picture, double lowest) {
    const Coverage found =
        test_support::coverage({picture.width, static_cast<int>(lowest)}, [&](int x, int y) {
            const std::uint8_t* pixel = picture.at(x, y);
            return pixel[0] > 200 && pixel[1] > 150 && pixel[2] < 80;
        });
    EXPECT_GT(found.pixels, 20);
    return found.center;
}

class TestPatterns : public testing::TestWithParam<stereo::ContextKind> {};

INSTANTIATE_TEST_SUITE_P(, TestPatterns,
                         testing::Values(stereo::ContextKind::egl, stereo::ContextKind::osmesa),
                         context_name);

TEST_P(TestPatterns, EveryModeShowsEachEyeItsLetterAndNothingOfTheOthers) {
    const auto context = stereo::make_context(GetParam(), {.size = kSize});
    PatternShow show(pattern_config(StereoMode::mono), *context);
    int checked = 0;
    for (const StereoMode mode : stereo::all_stereo_modes()) {
        if (upright(mode) == StereoMode::anaglyph_dubois)
            continue; // mixes
        SCOPED_TRACE(name_of(mode));
        show.set_stereo(mode);
        show.frame(head_at({0.0f, 1.5f, 0.0f}));
        const Image window = show.outputs().display().read_window();
        for (const Eye eye : eyes_of(mode)) {
            const bool right_buffer =
                upright(mode) == StereoMode::quadbuffer && place_of(eye, mode) == Eye::right;
            const Image buffer =
                right_buffer ? show.outputs().display().read_right_buffer() : window;
            expect_letter(shown_to(place_of(eye, mode), buffer, mode), eye);
            ++checked;
        }
    }
    EXPECT_EQ(checked, 3 + 2 * 14);
}

TEST_P(TestPatterns, TheCrossHasTheDisparityOfItsDepthForAMovingHead) {
    const auto context = stereo::make_context(GetParam(), {.size = kSize});
    const Config config = pattern_config(StereoMode::quadbuffer);
    PatternShow show(config, *context);
    const stereo::Screen& screen = config.installation.windows.front().viewports.front().screen;
    for (const glm::vec3 head : {glm::vec3(0, 1.5, 0), glm::vec3(0.2, 1.6, 0.3)}) {
        const interaction::InputState input = head_at(head);
        show.frame(input);
        const PatternWall wall = pattern_wall(config.installation.windows.front(), 0,
                                              config.installation.viewers.front(),
                                              *input.devices.front().pose, 0.063f, kSize);
        EXPECT_EQ(wall.cross_depth, 0.5f) << "below half of 1.2 m";
        // Before the middle of the wall, wherever the head is.
        EXPECT_NEAR(glm::distance(cross_of(wall), glm::vec3(0.05f, 1.55f, -0.7f)), 0, 1e-5);
        const double distance = head.z + 1.2;
        const double apart = 0.063 * 0.5 / (distance - 0.5);
        EXPECT_NEAR(disparity_on(wall, cross_of(wall)), apart, 1e-6);
        std::map<Eye, glm::dvec2> at;
        for (const Eye eye : {Eye::left, Eye::right}) {
            const test_support::PinholeEye pinhole(screen, *input.devices.front().pose, eye, 0.063,
                                                   kSize);
            const auto expected = pinhole.pixel_of(glm::dvec3(cross_of(wall)));
            ASSERT_TRUE(expected);
            at[eye] = cross_in(show.outputs().display().read_eye(eye), expected->y + 30);
            EXPECT_NEAR(at[eye].x, expected->x, 1.0);
        }
        EXPECT_NEAR(at[Eye::left].x - at[Eye::right].x, apart / 1.5 * kSize.x, 1.0);
    }
}

TEST_P(TestPatterns, EveryWallOfACaveHasItsNameItsLettersAndItsCross) {
    Config config = read_config("cave4");
    config.rendering.samples = 1;
    for (stereo::Window& window : config.installation.windows) {
        window.size = kSize;
        window.viewports.front().position = {0, 0};
        window.viewports.front().size = {1, 1};
    }
    PatternShow show(config, stereo::open_windows(GetParam(), config.installation, {}));
    interaction::InputState input = head_at({0.1f, 1.65f, 0.2f});
    show.frame(input);
    for (std::size_t i = 0; i < show.outputs().displays(); ++i) {
        const stereo::Window& window = config.installation.windows[i];
        SCOPED_TRACE(window.name);
        const PatternWall wall = pattern_wall(window, 0, config.installation.viewers.front(),
                                              *input.devices.front().pose, 0.063f, kSize);
        EXPECT_EQ(wall.name, window.name);
        for (const Eye eye : {Eye::left, Eye::right}) {
            const test_support::PinholeEye pinhole(window.viewports.front().screen,
                                                   *input.devices.front().pose, eye, 0.063, kSize);
            const auto expected = pinhole.pixel_of(glm::dvec3(cross_of(wall)));
            ASSERT_TRUE(expected);
            const Image picture = show.outputs().display(i).read_eye(eye);
            const std::uint8_t* pixel =
                picture.at(static_cast<int>(expected->x), static_cast<int>(expected->y));
            EXPECT_GT(pixel[0], 180);
            EXPECT_LT(pixel[2], 100);
        }
    }
}

} // namespace
} // namespace isochron::app
