// Which eye has which pixel of a window, for all sizes of windows and viewports.
#include "stereo/display.h"

#include "render/gl/shader.h"
#include "tests/stereo/each_eye.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace isochron::stereo {
namespace {

using render::Image;
using Rgb = std::array<int, 3>;

/// A picture in which every pixel of every eye of every viewport has a color of its own.
Rgb color_of(Eye eye, std::size_t viewport, int x, int y) {
    return {(37 * x + 11 * y) % 256, (5 * x + 53 * y + 90 * static_cast<int>(viewport)) % 256,
            eye == Eye::left ? 40 : 200};
}

constexpr std::string_view kFragment = R"(#version 450 core
uniform int viewport;
uniform float blue;
uniform int height;
uniform ivec2 corner; // corner of the viewport in the target
out vec4 color;
void main() {
    ivec2 at = ivec2(gl_FragCoord.xy) - corner;
    int x = at.x, y = height - 1 - at.y;
    color = vec4((37 * x + 11 * y) % 256 / 255.0, (5 * x + 53 * y + 90 * viewport) % 256 / 255.0,
                 blue / 255.0, 1.0);
}
)";

class MultiplexTest : public testing::TestWithParam<ContextKind> {
  protected:
    /// Draws the window in the mode, with the pattern in each eye of each viewport.
    Image draw(Display& display, StereoMode mode) {
        std::size_t drawn = 0;
        const std::size_t eyes = eyes_of(mode).size();
        draw_each_eye(gl_, display, {}, 0.06f, mode, [&](const render::View& view, Eye eye) {
            const GLuint program = program_.name();
            const auto at = [&](const char* name) { return gl_.GetUniformLocation(program, name); };
            gl_.Disable(GL_DEPTH_TEST);
            gl_.Disable(GL_BLEND);
            gl_.Disable(GL_FRAMEBUFFER_SRGB); // the pattern is made of display values
            gl_.UseProgram(program);
            gl_.ProgramUniform1i(program, at("viewport"), static_cast<GLint>(drawn++ / eyes));
            gl_.ProgramUniform1f(program, at("blue"), eye == Eye::left ? 40.0f : 200.0f);
            gl_.ProgramUniform1i(program, at("height"), view.size.y);
            gl_.ProgramUniform2i(program, at("corner"), view.corner.x, view.corner.y);
            gl_.BindVertexArray(no_attributes_.name());
            gl_.DrawArrays(GL_TRIANGLES, 0, 3);
            gl_.Enable(GL_FRAMEBUFFER_SRGB);
        });
        return display.read_window();
    }
    Display display_of(const Window& window) {
        picture_ = offscreen_beside(*context_, window.size);
        return {gl_, *context_, *picture_, window, {}};
    }

    std::unique_ptr<GlContext> context_ = make_context(GetParam(), {});
    std::unique_ptr<GlContext> picture_; ///< context of the window's size
    render::Gl gl_{context_->loader()};
    render::Program program_ = render::link_program(
        gl_, {render::shader_file("full_screen.vert"), {"pattern.frag", kFragment}});
    render::VertexArray no_attributes_{gl_};
};

/// Windows whose sizes and viewports begin and end on odd and even pixels.
std::vector<Window> odd_windows() {
    std::vector<Window> windows;
    for (const glm::ivec2 size : {glm::ivec2(64, 48), glm::ivec2(63, 47), glm::ivec2(64, 47)}) {
        Window window;
        window.size = size;
        windows.push_back(window);
        window.viewports = {Viewport{}, Viewport{}};
        window.viewports[0].size = {0.4f, 0.9f}; // 26 or 25 pixels, 43 or 42
        window.viewports[1].position = {0.45f, 0.15f};
        window.viewports[1].size = {0.55f, 0.7f};
        windows.push_back(window);
    }
    return windows;
}

/// The pixels of a viewport from the window's top left: [low, high).
std::array<glm::ivec2, 2> pixels_of(const Viewport& viewport, glm::ivec2 window) {
    const auto round = [](float value) { return static_cast<int>(std::lround(value)); };
    const glm::vec2 size(window), end = viewport.position + viewport.size;
    return {glm::ivec2(round(viewport.position.x * size.x), window.y - round(end.y * size.y)),
            glm::ivec2(round(end.x * size.x), window.y - round(viewport.position.y * size.y))};
}

/// The eye that a mode gives a pixel to, counted from the window's top left.
Eye owner(StereoMode mode, int x, int y) {
    const int count = upright(mode) == StereoMode::vertical_interlaced     ? y
                      : upright(mode) == StereoMode::horizontal_interlaced ? x
                                                                           : x + y;
    return (count % 2 == 0) != is_inverted(mode) ? Eye::left : Eye::right;
}

TEST_P(MultiplexTest, RowsColumnsAndSquaresAlternateFromTheWindowsTopLeftPixel) {
    for (const Window& window : odd_windows()) {
        Display display = display_of(window);
        for (const StereoMode mode :
             {StereoMode::vertical_interlaced, StereoMode::horizontal_interlaced,
              StereoMode::checkerboard, inverted(StereoMode::vertical_interlaced),
              inverted(StereoMode::horizontal_interlaced), inverted(StereoMode::checkerboard)}) {
            SCOPED_TRACE(testing::Message()
                         << name_of(mode) << ", " << window.size.x << " x " << window.size.y);
            const Image picture = draw(display, mode);
            int compared = 0;
            for (std::size_t v = 0; v < window.viewports.size(); ++v) {
                const auto [low, high] = pixels_of(window.viewports[v], window.size);
                for (int y = low.y; y < high.y; ++y)
                    for (int x = low.x; x < high.x; ++x, ++compared) {
                        const Rgb expected = color_of(owner(mode, x, y), v, x - low.x, y - low.y);
                        const std::uint8_t* pixel = picture.at(x, y);
                        ASSERT_EQ((Rgb{pixel[0], pixel[1], pixel[2]}), expected) << x << ' ' << y;
                    }
            }
            EXPECT_GT(compared, window.size.x * window.size.y / 2);
        }
    }
}

double linear(double srgb) {
    return srgb <= 0.04045 ? srgb / 12.92 : std::pow((srgb + 0.055) / 1.055, 2.4);
}
double srgb(double linear) {
    return linear <= 0.0031308 ? 12.92 * linear : 1.055 * std::pow(linear, 1 / 2.4) - 0.055;
}

/// Row by row, as Dubois prints them.
constexpr double kDubois[2][3][3] = {
    {{0.437, 0.449, 0.164}, {-0.062, -0.062, -0.024}, {-0.048, -0.050, -0.017}},
    {{-0.011, -0.032, -0.007}, {0.377, 0.761, 0.009}, {-0.026, -0.093, 1.234}}};

TEST_P(MultiplexTest, DuboisAnaglyphIsHisMatricesInLinearLight) {
    Window window;
    window.size = {63, 47};
    Display display = display_of(window);
    for (const StereoMode mode :
         {StereoMode::anaglyph_dubois, inverted(StereoMode::anaglyph_dubois)}) {
        const Image picture = draw(display, mode);
        for (int y = 0; y < window.size.y; ++y)
            for (int x = 0; x < window.size.x; ++x)
                for (int channel = 0; channel < 3; ++channel) {
                    double sum = 0;
                    for (const int place : {0, 1}) {
                        const bool left = (place == 0) != is_inverted(mode);
                        const Rgb from = color_of(left ? Eye::left : Eye::right, 0, x, y);
                        for (int k = 0; k < 3; ++k)
                            sum += kDubois[place][channel][k] * linear(from[k] / 255.0);
                    }
                    const double expected = 255.0 * srgb(std::clamp(sum, 0.0, 1.0));
                    // Mesa's curve is off by more than half a step where it is dark.
                    ASSERT_NEAR(picture.at(x, y)[channel], expected, 2.0)
                        << name_of(mode) << ' ' << x << ' ' << y << ' ' << channel;
                }
    }
}

TEST(Dubois, AnaglyphOfTwoWhitePicturesIsWhite) {
    for (int channel = 0; channel < 3; ++channel) {
        double sum = 0;
        for (const int eye : {0, 1})
            for (int k = 0; k < 3; ++k)
                sum += kDubois[eye][channel][k];
        EXPECT_NEAR(sum, 1.0, 0.01) << "a slip in a matrix";
    }
}

TEST_P(MultiplexTest, RedAndCyanChangePlacesWhenInverted) {
    Window window;
    window.size = {63, 47};
    Display display = display_of(window);
    const Image usual = draw(display, StereoMode::anaglyph_red_cyan);
    const Image inverted = draw(display, stereo::inverted(StereoMode::anaglyph_red_cyan));
    EXPECT_EQ(usual.at(5, 5)[2], 200) << "blue is the right eye's";
    EXPECT_EQ(inverted.at(5, 5)[2], 40);
}

TEST_P(MultiplexTest, AQuadBufferedWindowHoldsEachEyeInABufferOfItsOwn) {
    for (const Window& window : odd_windows()) {
        Display display = display_of(window);
        for (const StereoMode mode : {StereoMode::quadbuffer, inverted(StereoMode::quadbuffer)}) {
            const Image left = draw(display, mode), right = display.read_right_buffer();
            for (std::size_t v = 0; v < window.viewports.size(); ++v) {
                const auto [low, high] = pixels_of(window.viewports[v], window.size);
                for (const bool at_left : {true, false}) {
                    const Eye eye = at_left != is_inverted(mode) ? Eye::left : Eye::right;
                    const Rgb expected = color_of(eye, v, 3, 4);
                    const std::uint8_t* pixel = (at_left ? left : right).at(low.x + 3, low.y + 4);
                    EXPECT_EQ((Rgb{pixel[0], pixel[1], pixel[2]}), expected) << name_of(mode);
                    EXPECT_EQ(display.read_eye(Eye::left, v).width, high.x - low.x);
                }
            }
        }
        draw(display, StereoMode::mono);
        EXPECT_THROW(display.read_right_buffer(), render::Error);
    }
}

TEST_P(MultiplexTest, InvertedHalvesHoldTheOtherEye) {
    Window window;
    window.size = {64, 48};
    Display display = display_of(window);
    const auto blue = [&](StereoMode mode, int x, int y) {
        return int(draw(display, mode).at(x, y)[2]);
    };
    EXPECT_EQ(blue(StereoMode::side_by_side, 5, 5), 40);
    EXPECT_EQ(blue(inverted(StereoMode::side_by_side), 5, 5), 200);
    EXPECT_EQ(blue(inverted(StereoMode::side_by_side), 60, 5), 40);
    EXPECT_EQ(blue(StereoMode::top_bottom, 5, 5), 40);
    EXPECT_EQ(blue(inverted(StereoMode::top_bottom), 5, 5), 200);
    EXPECT_EQ(blue(inverted(StereoMode::top_bottom), 5, 40), 40);
}

/// Every pixel of every eye's picture is where the same pixel of an upright display would be, turned
/// about the middle of its place; rows, columns and squares stay those of the window.
TEST_P(MultiplexTest, ADisplayThatHangsUpsideDownShowsEachEyesPictureTurnedInItsPlace) {
    for (Window window : odd_windows()) {
        for (Viewport& viewport : window.viewports)
            viewport.upside_down = true;
        Display display = display_of(window);
        for (const StereoMode mode :
             {StereoMode::mono, StereoMode::vertical_interlaced, StereoMode::horizontal_interlaced,
              StereoMode::checkerboard}) {
            SCOPED_TRACE(testing::Message()
                         << name_of(mode) << ", " << window.size.x << " x " << window.size.y);
            const Image picture = draw(display, mode);
            for (std::size_t v = 0; v < window.viewports.size(); ++v) {
                const auto [low, high] = pixels_of(window.viewports[v], window.size);
                for (int y = low.y; y < high.y; ++y)
                    for (int x = low.x; x < high.x; ++x) {
                        const Eye eye = mode == StereoMode::mono ? Eye::center : owner(mode, x, y);
                        const Rgb expected = color_of(eye, v, high.x - 1 - x, high.y - 1 - y);
                        const std::uint8_t* pixel = picture.at(x, y);
                        ASSERT_EQ((Rgb{pixel[0], pixel[1], pixel[2]}), expected) << x << ' ' << y;
                    }
            }
        }
    }
}

INSTANTIATE_TEST_SUITE_P(, MultiplexTest, testing::Values(ContextKind::egl, ContextKind::osmesa),
                         [](const auto& kind) { return std::string(name_of(kind.param)); });

} // namespace
} // namespace isochron::stereo
