// Eyes, disparity and composition of windows, measured in the pictures.
#include "stereo/display.h"

#include "render/gl/shader.h"
#include "render/gl/srgb.h"
#include "tests/stereo/each_eye.h"
#include "tests/support/drawing/image_compare.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <string>

namespace isochron::stereo {
namespace {

using interaction::Pose;
using render::Image;

/// A context that draws off screen at a size that the test changes, as a user resizes a window.
class ResizableContext final : public GlContext {
  public:
    ResizableContext(ContextKind kind, glm::ivec2 initial)
        : size(initial), context_(make_context(kind, {.size = initial})) {}
    void make_current() override { context_->make_current(); }
    render::GlLoader loader() const override { return context_->loader(); }
    glm::ivec2 framebuffer_size() const override { return size; }
    bool has_window() const override { return false; }
    void present() override {}
    bool should_close() const override { return false; }
    std::vector<interaction::WindowEvent> poll_events() override { return {}; }
    std::string description() const override { return context_->description(); }

    glm::ivec2 size;

  private:
    std::unique_ptr<GlContext> context_;
};

constexpr std::string_view kDotFragment = R"(#version 450 core
uniform mat4 clip_from_room;
uniform vec3 point;
uniform vec2 size;
uniform vec2 corner;
out vec4 color;
void main() {
    const vec4 clip = clip_from_room * vec4(point, 1.0);
    const vec2 from_dot = gl_FragCoord.xy - corner - (0.5 * clip.xy / clip.w + 0.5) * size;
    color = vec4(vec3(exp(-dot(from_dot, from_dot) / 18.0)), 1.0);
}
)";

/// Draws a soft white dot where a point of the room is seen, sharp to a fraction of a pixel.
class Dot {
  public:
    explicit Dot(const render::Gl& gl)
        : program_(render::link_program(
              gl, {render::shader_file("full_screen.vert"), {"dot.frag", kDotFragment}})),
          no_attributes_(gl) {}
    void draw(const render::View& view, glm::vec3 point) const {
        const render::Gl& gl = program_.gl();
        const GLuint program = program_.name();
        const glm::mat4 clip_from_room = view.clip_from_eye * view.eye_from_room;
        gl.Disable(GL_DEPTH_TEST);
        gl.Disable(GL_BLEND);
        gl.UseProgram(program);
        gl.ProgramUniformMatrix4fv(program, gl.GetUniformLocation(program, "clip_from_room"), 1,
                                   GL_FALSE, &clip_from_room[0][0]);
        gl.ProgramUniform3f(program, gl.GetUniformLocation(program, "point"), point.x, point.y,
                            point.z);
        gl.ProgramUniform2f(program, gl.GetUniformLocation(program, "size"),
                            static_cast<float>(view.size.x), static_cast<float>(view.size.y));
        gl.ProgramUniform2f(program, gl.GetUniformLocation(program, "corner"),
                            static_cast<float>(view.corner.x), static_cast<float>(view.corner.y));
        gl.BindVertexArray(no_attributes_.name());
        gl.DrawArrays(GL_TRIANGLES, 0, 3);
    }

  private:
    render::Program program_;
    render::VertexArray no_attributes_;
};

Image part(const Image& image, int x, int y, int width, int height) {
    Image cut{width, height, {}};
    for (int row = y; row < y + height; ++row)
        cut.rgba.insert(cut.rgba.end(), image.at(x, row), image.at(x, row) + 4 * width);
    return cut;
}

/// Where the light of one channel is, pixels from the upper left corner.
glm::dvec2 centroid(const Image& image, int channel) {
    glm::dvec2 sum(0);
    double weight = 0;
    for (int y = 0; y < image.height; ++y)
        for (int x = 0; x < image.width; ++x) {
            const double value = image.at(x, y)[channel];
            sum += value * glm::dvec2(x + 0.5, y + 0.5);
            weight += value;
        }
    EXPECT_GT(weight, 1000.0) << "no dot in the picture";
    return sum / weight;
}

constexpr glm::ivec2 kWindowSize{800, 600};
constexpr float kSeparation = 0.064f;
/// In front of the middle of the default screen: 1.6 m wide, 0.9 m high, 1.0 m ahead.
const Pose kViewerHead{{0.0f, 1.55f, 0.0f}, {1.0f, 0.0f, 0.0f, 0.0f}};

/// The left and the right eye's picture, cut out of a window by what the mode is documented to be.
std::pair<Image, Image> cut_eyes(const Image& window, StereoMode mode) {
    const int w = window.width, h = window.height;
    switch (mode) {
    case StereoMode::side_by_side:
        return {part(window, 0, 0, w / 2, h), part(window, w / 2, 0, w / 2, h)};
    case StereoMode::top_bottom:
        return {part(window, 0, 0, w, h / 2), part(window, 0, h / 2, w, h / 2)};
    default: return {window, window};
    }
}

class DisplayTest : public testing::TestWithParam<ContextKind> {
  protected:
    Display display_of(const Window& window) { return {gl_, context_, window, {}}; }

    /// How far the left eye sees the dot to the right of where the right eye sees it, as a fraction
    /// of the picture's width: crossed disparity is positive.
    double crossed_disparity(Display& display, StereoMode mode, glm::vec3 point, float separation) {
        const auto draw = [&](StereoMode shown) {
            draw_each_eye(gl_, display, kViewerHead, separation, shown,
                          [&](const render::View& view, Eye) { dot_.draw(view, point); });
            return display.read_window();
        };
        if (mode == StereoMode::left || mode == StereoMode::right) {
            const Image left = draw(StereoMode::left), right = draw(StereoMode::right);
            return (centroid(left, 1).x - centroid(right, 1).x) / left.width;
        }
        const auto [left, right] = cut_eyes(draw(mode), mode);
        // Only the anaglyph tells the eyes apart by color; elsewhere every channel will do.
        const int right_channel = mode == StereoMode::anaglyph_red_cyan ? 2 : 0;
        return (centroid(left, 0).x - centroid(right, right_channel).x) / left.width;
    }

    ResizableContext context_{GetParam(), kWindowSize};
    render::Gl gl_{context_.loader()};
    Dot dot_{gl_};
};

const std::vector<StereoMode> kTwoEyedModes{StereoMode::left, StereoMode::side_by_side,
                                            StereoMode::top_bottom, StereoMode::anaglyph_red_cyan};

/// By similar triangles a point at distance d from the eyes, seen through a screen at distance D,
/// has the disparity separation * (D - d) / d on the screen: crossed before it, none on it,
/// uncrossed behind it.
TEST_P(DisplayTest, DisparityHasTheSignAndSizeOfSimilarTriangles) {
    Display display = display_of({});
    for (const StereoMode mode : kTwoEyedModes)
        for (const float distance : {0.5f, 0.8f, 1.0f, 1.5f, 3.0f, 20.0f}) {
            const glm::vec3 point(0.05f, 1.6f, -distance);
            const double meters = kSeparation * (1.0 - distance) / distance;
            const double fraction = crossed_disparity(display, mode, point, kSeparation);
            const double pixels =
                mode == StereoMode::side_by_side ? kWindowSize.x / 2 : kWindowSize.x;
            EXPECT_NEAR(fraction * pixels, meters / 1.6 * pixels, 0.5)
                << name_of(mode) << ", point at " << distance << " m";
            if (distance < 0.9f) {
                EXPECT_GT(fraction * pixels, 2) << "crossed before the screen";
            } else if (distance > 1.1f) {
                EXPECT_LT(fraction * pixels, -2) << "uncrossed behind the screen";
            }
        }
}

TEST_P(DisplayTest, DisparityOfAFittedScreenFollowsItsFittedWidth) {
    Window window;
    window.viewports.front().screen.fit_aspect = true;
    Display display = display_of(window);
    for (const StereoMode mode : kTwoEyedModes) {
        const glm::dvec2 pixels = mode == StereoMode::side_by_side ? glm::dvec2(400, 600)
                                  : mode == StereoMode::top_bottom ? glm::dvec2(800, 300)
                                                                   : glm::dvec2(800, 600);
        // The screen of 1.6 m x 0.9 m grows to the picture's aspect.
        const double width = std::max(1.6, 0.9 * pixels.x / pixels.y); // meters
        const double fraction = crossed_disparity(display, mode, {0.0f, 1.55f, -2.0f}, kSeparation);
        EXPECT_NEAR(fraction * pixels.x, -kSeparation / 2.0 / width * pixels.x, 0.5)
            << name_of(mode);
    }
}

TEST_P(DisplayTest, WithoutSeparationBothEyesSeeTheSame) {
    Display display = display_of({});
    for (const StereoMode mode : {StereoMode::side_by_side, StereoMode::top_bottom}) {
        draw_each_eye(gl_, display, kViewerHead, 0.0f, mode,
                      [&](const render::View& view, Eye) { dot_.draw(view, {0.3f, 1.7f, -2.0f}); });
        const auto [left, right] = cut_eyes(display.read_window(), mode);
        EXPECT_EQ(left.rgba, right.rgba);
        EXPECT_EQ(display.read_eye(Eye::left).rgba, left.rgba);
    }
}

/// Fills each eye's picture with a color of its own.
void fill(const render::Gl& gl, Eye eye) {
    const std::map<Eye, glm::vec4> colors{
        {Eye::center, {1, 1, 1, 1}}, {Eye::left, {1, 0.2, 0.4, 1}}, {Eye::right, {0.6, 0.8, 0, 1}}};
    // What shaders write, and clears fill in, is light.
    const glm::vec3 light = render::linear_from_srgb(glm::vec3(colors.at(eye)));
    gl.ClearColor(light.x, light.y, light.z, 1.0f);
    gl.Clear(GL_COLOR_BUFFER_BIT);
}
using Rgb = std::array<int, 3>;
constexpr Rgb kLeft{255, 51, 102}, kRight{153, 204, 0}, kCenter{255, 255, 255};

Rgb rgb(const Image& image, int x, int y) {
    const std::uint8_t* pixel = image.at(x, y);
    return {pixel[0], pixel[1], pixel[2]};
}

TEST_P(DisplayTest, EachEyeLandsWhereTheModeSays) {
    Display display = display_of({});
    const auto corners = [&](StereoMode mode) -> std::array<Rgb, 4> {
        draw_each_eye(gl_, display, kViewerHead, kSeparation, mode,
                      [&](const render::View&, Eye eye) { fill(gl_, eye); });
        const Image window = display.read_window();
        EXPECT_EQ(window.width, kWindowSize.x);
        EXPECT_EQ(window.height, kWindowSize.y);
        return {rgb(window, 0, 0), rgb(window, kWindowSize.x - 1, 0),
                rgb(window, 0, kWindowSize.y - 1),
                rgb(window, kWindowSize.x - 1, kWindowSize.y - 1)};
    };
    using testing::ElementsAre;
    EXPECT_THAT(corners(StereoMode::mono), ElementsAre(kCenter, kCenter, kCenter, kCenter));
    EXPECT_THAT(corners(StereoMode::left), ElementsAre(kLeft, kLeft, kLeft, kLeft));
    EXPECT_THAT(corners(StereoMode::right), ElementsAre(kRight, kRight, kRight, kRight));
    EXPECT_THAT(corners(StereoMode::side_by_side), ElementsAre(kLeft, kRight, kLeft, kRight));
    EXPECT_THAT(corners(StereoMode::top_bottom), ElementsAre(kLeft, kLeft, kRight, kRight));
    const Rgb mixed{kLeft[0], kRight[1], kRight[2]};
    EXPECT_THAT(corners(StereoMode::anaglyph_red_cyan), ElementsAre(mixed, mixed, mixed, mixed));
}

TEST_P(DisplayTest, TheAnaglyphHoldsTheLeftPictureInRedAndTheRightOneInGreenAndBlue) {
    Window window;
    window.viewports.front().position = {0.25f, 0.1f}; // its corner is not the window's
    window.viewports.front().size = {0.5f, 0.5f};
    Display display = display_of(window);
    draw_each_eye(gl_, display, kViewerHead, kSeparation, StereoMode::anaglyph_red_cyan,
                  [&](const render::View& view, Eye) { dot_.draw(view, {0.1f, 1.5f, -3.0f}); });
    const Image left = display.read_eye(Eye::left), right = display.read_eye(Eye::right);
    const Image both = part(display.read_window(), 200, 240, 400, 300);
    EXPECT_NE(left.rgba, right.rgba);
    for (std::size_t i = 0; i < both.rgba.size(); i += 4) {
        ASSERT_EQ(both.rgba[i], left.rgba[i]);
        ASSERT_EQ(both.rgba[i + 1], right.rgba[i + 1]);
        ASSERT_EQ(both.rgba[i + 2], right.rgba[i + 2]);
        ASSERT_EQ(both.rgba[i + 3], 255);
    }
}

TEST_P(DisplayTest, DrawsEachEyeOfEachViewportOnceAndTheOverlayOnceOverAll) {
    Window window;
    window.viewports.resize(2);
    window.viewports[0].size = {0.5f, 1.0f};
    window.viewports[1].position = {0.5f, 0.0f};
    window.viewports[1].size = {0.5f, 0.5f};
    Display display = display_of(window);
    for (const StereoMode mode : all_stereo_modes()) {
        std::vector<Eye> eyes;
        int overlays = 0;
        draw_each_eye(
            gl_, display, kViewerHead, kSeparation, mode,
            [&](const render::View& view, Eye eye) {
                eyes.push_back(eye);
                GLint viewport[4];
                gl_.GetIntegerv(GL_VIEWPORT, viewport);
                EXPECT_EQ(glm::ivec2(viewport[0], viewport[1]), view.corner);
                EXPECT_EQ(glm::ivec2(viewport[2], viewport[3]), view.size);
                fill(gl_, eye);
            },
            [&](glm::ivec2 size) {
                ++overlays;
                EXPECT_EQ(size, kWindowSize);
                gl_.Enable(GL_SCISSOR_TEST);
                gl_.Scissor(0, size.y - 10, 10, 10);
                gl_.ClearColor(0, 0, 1, 1);
                gl_.Clear(GL_COLOR_BUFFER_BIT);
            });
        std::vector<Eye> expected = eyes_of(mode);
        expected.insert(expected.end(), expected.begin(), expected.end());
        EXPECT_EQ(eyes, expected) << name_of(mode);
        EXPECT_EQ(overlays, upright(mode) == StereoMode::quadbuffer ? 2 : 1) << "one per buffer";
        const Image picture = display.read_window();
        EXPECT_EQ(rgb(picture, 9, 9), (Rgb{0, 0, 255}));
        EXPECT_NE(rgb(picture, 10, 10), (Rgb{0, 0, 255}));
        EXPECT_EQ(rgb(picture, kWindowSize.x - 1, 0), (Rgb{0, 0, 0})) << "no viewport is there";
        EXPECT_NE(rgb(picture, kWindowSize.x - 1, kWindowSize.y - 1), (Rgb{0, 0, 0}));
    }
}

TEST_P(DisplayTest, NothingOfAnEarlierFrameRemains) {
    Display display = display_of({});
    const auto draw = [&](glm::ivec2 size, const Display::Overlay& overlay) {
        context_.size = size;
        draw_each_eye(
            gl_, display, kViewerHead, kSeparation, StereoMode::side_by_side,
            [&](const render::View&, Eye eye) { fill(gl_, eye); }, overlay);
        return display.read_window();
    };
    const auto paint_all = [&](glm::ivec2) {
        gl_.ClearColor(0, 0, 1, 1);
        gl_.Clear(GL_COLOR_BUFFER_BIT);
    };
    for (const glm::ivec2 size : {glm::ivec2(64, 32), glm::ivec2(65, 33)}) {
        const Image clean = draw(size, {});
        draw(size, paint_all);
        EXPECT_EQ(draw(size, {}).rgba, clean.rgba);
        EXPECT_EQ(rgb(clean, size.x / 2, 0), size.x % 2 ? (Rgb{0, 0, 0}) : kRight);
    }
}

TEST_P(DisplayTest, FollowsTheSizeOfTheWindowAndDrawsNothingWhenMinimized) {
    Display display = display_of({});
    int drawn = 0;
    const auto draw = [&] {
        draw_each_eye(gl_, display, kViewerHead, kSeparation, StereoMode::side_by_side,
                      [&](const render::View&, Eye eye) {
                          ++drawn;
                          fill(gl_, eye);
                      });
        return display.read_window();
    };
    for (const glm::ivec2 size :
         {kWindowSize, glm::ivec2(333, 97), glm::ivec2(2, 1), kWindowSize}) {
        context_.size = size;
        const Image window = draw();
        EXPECT_EQ(glm::ivec2(window.width, window.height), size);
        EXPECT_EQ(display.size(), size);
        EXPECT_EQ(rgb(window, size.x - 1, 0), kRight);
        // Both eyes' pictures are of one size; an odd window keeps a column between them.
        EXPECT_EQ(display.read_eye(Eye::left).width, size.x / 2);
        EXPECT_EQ(display.read_eye(Eye::right).width, size.x / 2);
    }
    context_.size = {1, 1}; // too small for two eyes, yet no error
    EXPECT_EQ(draw().width, 1);
    drawn = 0;
    context_.size = {0, 0};
    EXPECT_EQ(draw().width, 1) << "the last picture stays";
    EXPECT_EQ(drawn, 0);
}

TEST_P(DisplayTest, TheBackgroundIsSeenWhereNothingIsDrawn) {
    Display display(gl_, context_, {}, {.background = {0.2f, 0.4f, 0.6f}});
    gl_.Enable(GL_SCISSOR_TEST); // what others leave behind does not matter
    gl_.Scissor(0, 0, 1, 1);
    gl_.ColorMask(GL_FALSE, GL_FALSE, GL_FALSE, GL_FALSE);
    draw_each_eye(gl_, display, kViewerHead, kSeparation, StereoMode::anaglyph_red_cyan,
                  [](const auto&, Eye) {});
    const Image window = display.read_window();
    EXPECT_EQ(rgb(window, 0, 0), (Rgb{51, 102, 153}));
    EXPECT_EQ(rgb(window, kWindowSize.x - 1, kWindowSize.y - 1), (Rgb{51, 102, 153}));
    EXPECT_EQ(gl_.GetError(), GLenum{GL_NO_ERROR});
}

TEST_P(DisplayTest, AnEyeThatWasNotDrawnCannotBeRead) {
    Display display = display_of({});
    draw_each_eye(gl_, display, kViewerHead, kSeparation, StereoMode::side_by_side,
                  [](const auto&, Eye) {});
    draw_each_eye(gl_, display, kViewerHead, kSeparation, StereoMode::mono,
                  [](const auto&, Eye) {});
    EXPECT_NO_THROW(display.read_eye(Eye::center));
    EXPECT_THROW(display.read_eye(Eye::left), render::Error);
    EXPECT_THROW(display.read_eye(Eye::center, 1), render::Error);
}

INSTANTIATE_TEST_SUITE_P(, DisplayTest, testing::Values(ContextKind::egl, ContextKind::osmesa),
                         [](const auto& kind) { return std::string(name_of(kind.param)); });

} // namespace
} // namespace isochron::stereo
