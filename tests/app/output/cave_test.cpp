// A CAVE of four walls: each wall shows its part, pictures match at their edges, and an emulation
// shows the room.
#include "tests/support/session_fixture.h"

#include "app/output/room_camera.h"
#include "app/output/room_view.h"
#include "render/gl/srgb.h"
#include "stereo/windows.h"
#include "tests/support/drawing/image_compare.h"

#include <gmock/gmock.h>

#include <array>
#include <cmath>
#include <deque>

namespace isochron::app {
namespace {

using interaction::Pose;
using render::Image;
using stereo::Eye;
using stereo::StereoMode;

/// The shipped CAVE with windows as small as tests like them, and a mode that draws both eyes.
Config small_cave(glm::ivec2 size) {
    Config config = read_config("cave4");
    for (stereo::Window& window : config.installation.windows) {
        window.size = size;
        window.viewports.front().position = {0, 0};
        window.viewports.front().size = {1, 1};
    }
    return config;
}

class CaveTest : public testing::TestWithParam<stereo::ContextKind> {
  protected:
    /// The displays of an installation, all in one context.
    std::deque<stereo::Display> displays_of(const stereo::Installation& installation) {
        std::deque<stereo::Display> displays;
        for (const stereo::Window& window : installation.windows) {
            pictures_.push_back(offscreen_beside(*context_, window.size));
            displays.emplace_back(gl_, *context_, *pictures_.back(), window,
                                  stereo::DisplayOptions{});
        }
        return displays;
    }

    std::unique_ptr<stereo::GlContext> context_ = stereo::make_context(GetParam(), {});
    std::vector<std::unique_ptr<stereo::GlContext>> pictures_;
    render::Gl gl_{context_->loader()};
};

INSTANTIATE_TEST_SUITE_P(, CaveTest,
                         testing::Values(stereo::ContextKind::egl, stereo::ContextKind::osmesa),
                         [](const auto& kind) { return std::string(stereo::name_of(kind.param)); });

/// Row of the middle of what is drawn in a column, from the top; nothing where it is empty.
std::optional<double> row_of_light(const Image& image, int column) {
    double sum = 0, weight = 0;
    for (int y = 0; y < image.height; ++y) {
        const double light = render::linear_from_srgb(float(image.at(column, y)[0]) / 255.0f);
        sum += light * (y + 0.5);
        weight += light;
    }
    return weight > 0.4 ? std::optional(sum / weight) : std::nullopt;
}

/// The edges of a cube that stands in the corner between front and right wall cross from one wall
/// to the other, whatever the head does, without a step.
TEST_P(CaveTest, ACubesEdgesCrossFromWallToWallWithoutAStepForAMovingHead) {
    constexpr int kSide = 300; // pixels, 1 cm each
    const Config config = small_cave({kSide, kSide});
    std::deque<stereo::Display> walls = displays_of(config.installation);
    ASSERT_EQ(walls[0].window().name, "front");
    ASSERT_EQ(walls[2].window().name, "right");
    render::LinePass lines(gl_);
    // The cube's edges along x and z that meet at its corner towards the viewer; y is their height.
    const std::array<std::array<glm::vec3, 2>, 4> edges{
        {{{{0.2f, 1.0f, -0.9f}, {2.6f, 1.0f, -0.9f}}},
         {{{0.2f, 2.2f, -0.9f}, {2.6f, 2.2f, -0.9f}}},
         {{{0.9f, 1.3f, -3.0f}, {0.9f, 1.3f, -0.3f}}},
         {{{2.4f, 0.8f, -3.2f}, {2.4f, 2.0f, -0.5f}}}}};
    int crossings = 0;
    for (int step = 0; step < 12; ++step) {
        const auto t = static_cast<float>(step) / 12.0f;
        const Pose head{{0.6f * std::sin(6.28f * t), 1.5f + 0.3f * std::cos(9.0f * t), 0.7f * t},
                        glm::angleAxis(0.8f * std::sin(5.0f * t), glm::vec3(0, 1, 0))};
        for (const auto& edge : edges) {
            const render::Line line{edge[0], edge[1], glm::vec4(1)};
            for (const std::size_t wall : {0, 2})
                walls[wall].draw(
                    head, 0.065f, StereoMode::quadbuffer, [&](std::span<const render::View> eyes) {
                        for (const render::View& view : eyes)
                            lines.draw(view, glm::mat4(1.0f), std::span(&line, 1), 3.0f);
                    });
            for (const Eye eye : {Eye::left, Eye::right}) {
                // Where the plane of eye and edge cuts the common edge of the walls.
                const glm::vec3 from = stereo::eye_position(head, eye, 0.065f);
                const glm::vec3 normal = glm::cross(edge[0] - from, edge[1] - from);
                const glm::vec3 foot(1.5f, 0.0f, -1.5f);
                const float height = glm::dot(normal, from - foot) / normal.y;
                const auto front = row_of_light(walls[0].read_eye(eye), kSide - 1);
                const auto right = row_of_light(walls[2].read_eye(eye), 0);
                if (!front || !right) // the edge ends before it reaches the walls' edge
                    continue;
                ++crossings;
                const double expected = kSide * (1.0 - height / 3.0);
                EXPECT_NEAR(*front, expected, 1.0) << "head " << step;
                EXPECT_NEAR(*right, expected, 1.0) << "head " << step;
            }
        }
    }
    EXPECT_GT(crossings, 50);
}

TEST_P(CaveTest, ASessionDrawsOnEveryWallWhatAWindowOfItsOwnWouldShow) {
    const TestFolder folder;
    const auto file = build_sphere(folder.path());
    const Config cave = small_cave({96, 96});
    const interaction::InputState input = head_at_rest(0);
    const auto open = [&](const Config& config) {
        return stereo::open_windows(GetParam(), config.installation, {});
    };
    // The other sessions below take the thread over, so that this one's pictures are read first.
    Session session(cave, file, open(cave));
    session.frame(input, {}, Waiting::for_cells);
    ASSERT_EQ(session.outputs().displays(), 4u);
    std::vector<std::array<Image, 2>> walls;
    for (std::size_t i = 0; i < session.outputs().displays(); ++i)
        walls.push_back({session.outputs().display(i).read_eye(Eye::left),
                         session.outputs().display(i).read_eye(Eye::right)});
    for (std::size_t i = 0; i < session.outputs().displays(); ++i) {
        Config alone = cave;
        alone.installation.windows = {cave.installation.windows[i]};
        Session one(alone, file, open(alone));
        one.frame(input, {}, Waiting::for_cells);
        EXPECT_EQ(walls[i][0].rgba, one.outputs().display().read_eye(Eye::left).rgba);
        EXPECT_EQ(walls[i][1].rgba, one.outputs().display().read_eye(Eye::right).rgba);
    }
    EXPECT_NE(walls[0][0].rgba, walls[0][1].rgba) << "the front wall's eyes";
    EXPECT_NE(walls[0][0].rgba, walls[3][0].rgba) << "front wall and floor";
}

TEST_P(CaveTest, EveryViewerSeesFromTheirOwnHead) {
    const TestFolder folder;
    const auto file = build_sphere(folder.path());
    Config config = small_cave({64, 64});
    stereo::Installation& cave = config.installation;
    cave.windows = {cave.windows[0], cave.windows[0]};
    cave.windows[1].name = "guest's";
    cave.viewers.push_back({"guest", "guest's head", {0.4f, 1.2f, 0.3f}, 0.03f});
    cave.windows[1].viewports.front().viewer = 1;
    Session session(config, file, stereo::open_windows(GetParam(), cave, {}));
    const auto picture = [&](std::size_t window) {
        return session.outputs().display(window).read_eye(Eye::left).rgba;
    };
    interaction::InputState input = head_at_rest(0);
    session.frame(input, {}, Waiting::for_cells);
    const auto guide = picture(0), guest = picture(1);
    EXPECT_NE(guide, guest) << "the guest stands where the configuration says";
    input.devices.push_back({"guest's head", Pose{{0.1f, 1.5f, 0.1f}, {1, 0, 0, 0}}, true, 0, {}});
    input.time = interaction::Seconds(0.01);
    session.frame(input, {}, Waiting::for_cells);
    EXPECT_EQ(picture(0), guide);
    EXPECT_NE(picture(1), guest) << "and moves with a tracker";
    // In the guide's place, with the guide's eyes, the guest sees the same.
    cave.viewers[1].eye_separation = cave.viewers[0].eye_separation;
    Session twins(config, file, stereo::open_windows(GetParam(), cave, {}));
    input.devices[1].pose = input.devices[0].pose;
    twins.frame(input, {}, Waiting::for_cells);
    EXPECT_EQ(twins.outputs().display(0).read_eye(Eye::left).rgba,
              twins.outputs().display(1).read_eye(Eye::left).rgba);
}

/// Pixel of a room's point in the picture of a camera, from the top left.
glm::ivec2 pixel_of(const Pose& camera, glm::vec3 point, glm::ivec2 size) {
    const glm::vec3 p = glm::inverse(camera.orientation) * (point - camera.position);
    const glm::vec2 half(0.5f * glm::vec2(size));
    const float scale = half.y / (-p.z * std::tan(kRoomView / 2));
    return {static_cast<int>(half.x + p.x * scale), static_cast<int>(half.y - p.y * scale)};
}

TEST_P(CaveTest, TheRoomShowsEveryWallsPictureWhereTheWallIs) {
    const Config config = small_cave({64, 64});
    const glm::ivec2 size(600, 400);
    std::deque<stereo::Display> walls = displays_of(config.installation);
    const auto window = offscreen_beside(*context_, size);
    RoomView room(gl_, *window, config.installation);
    const stereo::ViewerPose viewer{{{0.0f, 1.7f, 0.0f}, {1, 0, 0, 0}}, 0.06f};
    const auto paint = [&](std::size_t wall, glm::vec3 upper, glm::vec3 lower) {
        walls[wall].draw(std::span(&viewer, 1), StereoMode::left,
                         [&](std::span<const render::View> eyes) {
                             const glm::ivec2 wall_size = eyes.front().size;
                             gl_.ClearColor(upper.x, upper.y, upper.z, 1);
                             gl_.Clear(GL_COLOR_BUFFER_BIT);
                             gl_.Enable(GL_SCISSOR_TEST);
                             gl_.Scissor(0, 0, wall_size.x, wall_size.y / 2);
                             gl_.ClearColor(lower.x, lower.y, lower.z, 1);
                             gl_.Clear(GL_COLOR_BUFFER_BIT);
                             gl_.Disable(GL_SCISSOR_TEST);
                         });
    };
    paint(0, {1, 0, 0}, {0, 1, 0}); // front
    paint(1, {0, 0, 1}, {1, 1, 0}); // left
    paint(2, {1, 1, 1}, {1, 1, 1}); // right
    paint(3, {1, 0, 1}, {0, 1, 1}); // floor
    interaction::InputState input;
    const auto draw = [&] {
        room.draw(walls, std::span(&viewer, 1), std::nullopt, input, {});
        return room.read();
    };
    const Pose camera{glm::vec3(0.3f, 2.8f, 6.0f), glm::angleAxis(-0.2f, glm::vec3(1, 0, 0))};
    const Image before = draw();
    input.devices.push_back({kRoomCamera, camera, true, 0, {}});
    const Image picture = draw();
    EXPECT_NE(before.rgba, picture.rgba) << "the camera of the input";
    const auto rgb = [&](glm::vec3 point) {
        const glm::ivec2 at = pixel_of(camera, point, size);
        const std::uint8_t* pixel = picture.at(at.x, at.y);
        return std::array<int, 3>{pixel[0], pixel[1], pixel[2]};
    };
    using Rgb = std::array<int, 3>;
    EXPECT_EQ(rgb({0.7f, 2.7f, -1.5f}), (Rgb{255, 0, 0})) << "front, upper half";
    EXPECT_EQ(rgb({0.7f, 0.4f, -1.5f}), (Rgb{0, 255, 0})) << "front, lower half";
    EXPECT_EQ(rgb({-1.5f, 2.3f, 0.2f}), (Rgb{0, 0, 255})) << "left, upper half";
    EXPECT_EQ(rgb({-1.5f, 0.9f, 0.2f}), (Rgb{255, 255, 0})) << "left, lower half";
    EXPECT_EQ(rgb({0.6f, 0.0f, -0.9f}), (Rgb{255, 0, 255})) << "floor, towards the front wall";
    EXPECT_EQ(rgb({0.6f, 0.0f, 0.9f}), (Rgb{0, 255, 255})) << "floor, towards the viewer";
    const Rgb head = rgb(viewer.head.position + glm::vec3(0, 0, 0.1f));
    EXPECT_GT(head[0], head[2] + 20) << "skin, before a wall of another color";
    EXPECT_EQ(gl_.GetError(), GLenum{GL_NO_ERROR});
}

TEST_P(CaveTest, AnEmulatedSessionShowsTheRoomAndOneEyeOfEveryWall) {
    const TestFolder folder;
    const auto file = build_sphere(folder.path());
    const Config cave = small_cave({64, 64});
    Session session(cave, file,
                    stereo::open_room(GetParam(), cave.installation, {.size = {320, 200}}));
    interaction::InputState input = head_at_rest(0);
    session.frame(input, {}, Waiting::for_cells);
    ASSERT_NE(session.outputs().room(), nullptr);
    const Image room = session.outputs().room()->read();
    EXPECT_EQ(room.width, 320);
    EXPECT_EQ(session.outputs().display(0).mode(), StereoMode::left) << "half the work";
    input.devices[0].pose->position.x += 0.5f;
    input.time = interaction::Seconds(0.1);
    session.frame(input, {}, Waiting::for_cells);
    EXPECT_NE(session.outputs().room()->read().rgba, room.rgba)
        << "the head and its frusta have moved";
}

TEST_P(CaveTest, FramesOfWallsAreSeenAllAlongThem) {
    const TestFolder folder;
    const Config cave = small_cave({64, 64});
    constexpr glm::ivec2 kRoom(480, 360);
    Session session(cave, build_sphere(folder.path()),
                    stereo::open_room(GetParam(), cave.installation, {.size = kRoom}));
    session.frame(head_at_rest(0), {}, Waiting::for_cells);
    const Image room = session.outputs().room()->read();
    const Pose camera = RoomCamera(cave.installation).pose();
    int seen = 0, missing = 0;
    for (const stereo::Window& window : cave.installation.windows) {
        const auto corners = corners_in_room(window.viewports.front().screen,
                                             head_at_rest(0).devices[0].pose.value(), window.size);
        for (std::size_t i = 0; i < 4; ++i)
            for (int step = 1; step < 40; ++step) {
                const glm::vec3 at =
                    glm::inverse(camera.orientation) *
                    (glm::mix(corners[i], corners[(i + 1) % 4], static_cast<float>(step) / 40) -
                     camera.position);
                const float pixels = 0.5f * kRoom.y / std::tan(kRoomView / 2) / -at.z;
                const glm::ivec2 pixel(glm::vec2(kRoom) / 2.0f + glm::vec2(at.x, -at.y) * pixels);
                int brightest = 0; // brightest of the neighborhood: the line may run between pixels
                for (int y = pixel.y - 1; y <= pixel.y + 1; ++y)
                    for (int x = pixel.x - 1; x <= pixel.x + 1; ++x)
                        if (x >= 0 && y >= 0 && x < room.width && y < room.height)
                            brightest = std::max<int>(brightest, room.at(x, y)[2]);
                ++seen;
                missing += brightest < 110;
            }
    }
    EXPECT_EQ(seen, 4 * 4 * 39);
    EXPECT_LT(missing, seen / 50) << "behind a head, perhaps";
}

} // namespace
} // namespace isochron::app
