// Moves the room's camera.
#include "app/output/room_camera.h"

#include "stereo/screen.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <variant>

namespace isochron::app {
namespace {

using namespace interaction;

constexpr Key kKey = static_cast<Key>('C');
constexpr float kTurn = 3.0f;                       ///< [rad per window height dragged]
constexpr float kSteepest = 1.5f;                   ///< [rad]
constexpr float kNotch = 1.1f;                      ///< nearer per notch of the wheel
constexpr float kMargin = 1.1f;                     ///< around what the first picture shows
constexpr float kNearest = 0.3f, kFarthest = 60.0f; ///< [m]

} // namespace

RoomCamera::RoomCamera(const stereo::Installation& installation) {
    constexpr float kInfinity = std::numeric_limits<float>::infinity();
    glm::vec3 low(kInfinity), high(-kInfinity);
    const auto include = [&](const glm::vec3& point) {
        low = glm::min(low, point);
        high = glm::max(high, point);
    };
    for (const stereo::Viewer& viewer : installation.viewers)
        include(viewer.position);
    for (const stereo::Window& window : installation.windows)
        for (const stereo::Viewport& viewport : window.viewports) {
            const Pose head{installation.viewers[viewport.viewer].position, {1, 0, 0, 0}};
            for (const glm::vec3& corner : corners_in_room(viewport.screen, head, window.size))
                include(corner);
        }
    center_ = 0.5f * (low + high);
    const float radius = std::max(0.5f * glm::distance(low, high), kNearest);
    distance_ = std::min(kMargin * radius / std::sin(kRoomView / 2), kFarthest);
}

Pose RoomCamera::pose() const {
    const glm::quat turn =
        glm::angleAxis(yaw_, glm::vec3(0, 1, 0)) * glm::angleAxis(-pitch_, glm::vec3(1, 0, 0));
    return {center_ + turn * glm::vec3(0, 0, distance_), glm::normalize(turn)};
}

std::vector<WindowEvent> RoomCamera::feed(std::span<const WindowEvent> events) {
    std::vector<WindowEvent> left;
    for (const WindowEvent& event : events)
        if (!take(event))
            left.push_back(event);
    return left;
}

bool RoomCamera::take(const WindowEvent& event) {
    if (const auto* key = std::get_if<KeyEvent>(&event); key && key->key == kKey) {
        held_ = key->down;
        return true;
    }
    if (const auto* button = std::get_if<MouseButtonEvent>(&event)) {
        const std::uint32_t bit = 1u << static_cast<unsigned>(button->button);
        const bool ours = button->down && held_;
        buttons_ = ours ? buttons_ | bit : buttons_ & ~bit;
        return ours;
    }
    if (const auto* scroll = std::get_if<ScrollEvent>(&event); scroll && held_) {
        distance_ = std::clamp(distance_ * std::pow(kNotch, -scroll->dy), kNearest, kFarthest);
        return true;
    }
    if (const auto* move = std::get_if<MouseMoveEvent>(&event)) {
        const bool sound = std::isfinite(move->x) && std::isfinite(move->y) && move->height > 0;
        const float aspect = sound ? float(move->width) / float(move->height) : 1.0f;
        if (sound && cursor_ && buttons_ != 0)
            drag({(move->x - cursor_->x) * aspect, move->y - cursor_->y});
        if (sound)
            cursor_ = *move;
        return held_ || buttons_ != 0;
    }
    if (const auto* focus = std::get_if<FocusEvent>(&event); focus && !focus->focused) {
        held_ = false;
        buttons_ = 0;
        cursor_.reset();
    }
    return false;
}

void RoomCamera::drag(glm::vec2 by) {
    const auto left = 1u << static_cast<unsigned>(MouseButton::left);
    if (buttons_ & left) {
        yaw_ = std::remainder(yaw_ - kTurn * by.x, 2.0f * 3.14159265f);
        pitch_ = std::clamp(pitch_ + kTurn * by.y, -kSteepest, kSteepest);
        return;
    }
    const float meters = 2.0f * distance_ * std::tan(kRoomView / 2); // for one window height
    center_ += pose().orientation * glm::vec3(-by.x * meters, by.y * meters, 0.0f);
}

std::vector<std::string> RoomCamera::documentation() {
    const auto line = [](const char* keys, const char* effect) {
        return fmt::format("{:<30}{}", keys, effect);
    };
    return {line("C + left drag", "circle round the room"),
            line("C + middle or right drag", "move the room"), line("C + wheel", "come nearer"),
            line("all others", "move head, wand and data as without --emulate")};
}

} // namespace isochron::app
