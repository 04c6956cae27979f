// The camera of an emulated room: its start, the events that move it, and those that it ignores.
#include "app/output/room_camera.h"

#include "app/config/config.h"
#include "stereo/screen.h"

#include <gtest/gtest.h>

namespace isochron::app {
namespace {

using namespace interaction;

constexpr Key kKey = static_cast<Key>('C');

/// A point of the room as the camera sees it: x and y as fractions of half the height, z ahead.
glm::vec3 seen(const RoomCamera& camera, glm::vec3 point) {
    const Pose pose = camera.pose();
    const glm::vec3 p = glm::inverse(pose.orientation) * (point - pose.position);
    const float scale = -p.z * std::tan(kRoomView / 2);
    return {p.x / scale, p.y / scale, -p.z};
}

std::size_t feed(RoomCamera& camera, const std::vector<WindowEvent>& events) {
    return camera.feed(events).size();
}

TEST(RoomCamera, StartsWithEveryScreenInSight) {
    for (const char* name : {"cave4", "desk", "hmd", "powerwall", "desktop"}) {
        const Config config = read_config(name);
        const RoomCamera camera(config.installation);
        for (const stereo::Window& window : config.installation.windows)
            for (const stereo::Viewport& viewport : window.viewports)
                for (const glm::vec3& corner :
                     corners_in_room(viewport.screen, config.emulation.head, window.size)) {
                    const glm::vec3 at = seen(camera, corner);
                    EXPECT_LT(std::abs(at.x), 1.0f) << name;
                    EXPECT_LT(std::abs(at.y), 1.0f) << name;
                    EXPECT_GT(at.z, 0.05f) << name;
                }
    }
}

TEST(RoomCamera, MovesOnlyWhileItsKeyIsHeld) {
    RoomCamera camera({});
    const Pose start = camera.pose();
    const std::vector<WindowEvent> drag{
        MouseMoveEvent{0.5f, 0.5f, 640, 480}, MouseButtonEvent{MouseButton::left, true},
        MouseMoveEvent{0.6f, 0.5f, 640, 480}, MouseButtonEvent{MouseButton::left, false},
        ScrollEvent{0, 1}};
    EXPECT_EQ(feed(camera, drag), drag.size()) << "all of it is for the emulated devices";
    EXPECT_EQ(camera.pose(), start);
    EXPECT_EQ(feed(camera, {KeyEvent{kKey, true}}), 0u);
    EXPECT_EQ(feed(camera, drag), 1u) << "but for the release, which always passes";
    EXPECT_NE(camera.pose(), start);
    EXPECT_EQ(feed(camera, {KeyEvent{kKey, false}}), 0u);
    const Pose moved = camera.pose();
    feed(camera, drag);
    EXPECT_EQ(camera.pose(), moved);
}

TEST(RoomCamera, OrbitsAboutTheMiddleMovesAndComesNearer) {
    const stereo::Installation cave = read_config("cave4").installation;
    const glm::vec3 middle(0.0f, 1.5f, 0.0f);
    RoomCamera camera(cave);
    const float distance = glm::distance(camera.pose().position, middle);
    EXPECT_NEAR(glm::length(glm::vec2(seen(camera, middle))), 0.0f, 1e-4f);
    const auto drag = [&](MouseButton button, float x, float y) {
        feed(camera, {KeyEvent{kKey, true}, MouseMoveEvent{0.5f, 0.5f, 480, 480},
                      MouseButtonEvent{button, true}, MouseMoveEvent{0.5f + x, 0.5f + y, 480, 480},
                      MouseButtonEvent{button, false}, KeyEvent{kKey, false}});
    };
    drag(MouseButton::left, 0.2f, 0.1f);
    EXPECT_NEAR(glm::distance(camera.pose().position, middle), distance, 1e-4f);
    EXPECT_NEAR(glm::length(glm::vec2(seen(camera, middle))), 0.0f, 1e-4f);
    // Dragged by a tenth of the window, what was in the middle follows the cursor.
    drag(MouseButton::middle, 0.1f, -0.1f);
    EXPECT_NEAR(seen(camera, middle).x, 0.2f, 1e-4f);
    EXPECT_NEAR(seen(camera, middle).y, 0.2f, 1e-4f);
    const float before = seen(camera, middle).z;
    feed(camera, {KeyEvent{kKey, true}, ScrollEvent{0, 3}, KeyEvent{kKey, false}});
    EXPECT_LT(seen(camera, middle).z, before);
    for (int i = 0; i < 1000; ++i)
        feed(camera, {KeyEvent{kKey, true}, ScrollEvent{0, 50}});
    EXPECT_TRUE(is_finite(camera.pose()));
    EXPECT_GT(seen(camera, middle).z, -100.0f);
}

TEST(RoomCamera, LetsGoWhenTheWindowLosesFocus) {
    RoomCamera camera({});
    feed(camera, {KeyEvent{kKey, true}, MouseButtonEvent{MouseButton::left, true},
                  MouseMoveEvent{0.5f, 0.5f, 640, 480}});
    EXPECT_EQ(feed(camera, {FocusEvent{false}}), 1u) << "others must hear of it";
    const Pose pose = camera.pose();
    EXPECT_EQ(feed(camera, {MouseMoveEvent{0.9f, 0.9f, 640, 480}}), 1u);
    EXPECT_EQ(camera.pose(), pose);
}

} // namespace
} // namespace isochron::app
