// A camera that circles a room, moved by mouse while a key is held.
#pragma once

#include "interaction/input/window_event.h"
#include "interaction/pose.h"
#include "stereo/installation.h"

#include <optional>
#include <span>
#include <string>
#include <vector>

namespace isochron::app {

inline constexpr float kRoomView = 0.8f; ///< [rad] vertical field of view of the room's picture

/// While C is held: left drag orbits, middle or right drag moves, the wheel comes nearer.
class RoomCamera {
  public:
    /// Starts behind, above and to the right of the viewers; all screens are in view.
    explicit RoomCamera(const stereo::Installation& installation);

    /// Moves the camera by the events that are meant for it.
    /// @return the other events, and all releases
    std::vector<interaction::WindowEvent> feed(std::span<const interaction::WindowEvent> events);

    /// Where the camera is in the room; it looks along its -Z.
    interaction::Pose pose() const;

    /// One line per control, for `--help`.
    static std::vector<std::string> documentation();

  private:
    bool take(const interaction::WindowEvent& event);
    void drag(glm::vec2 by); ///< by a distance in window heights

    glm::vec3 center_{0.0f};    ///< point that it circles, in the room
    float distance_ = 1.0f;     ///< [m]
    float yaw_ = 0.6f;          ///< [rad] to the right of the center
    float pitch_ = 0.5f;        ///< [rad] above it
    bool held_ = false;         ///< the key is pressed
    std::uint32_t buttons_ = 0; ///< buttons of the mouse, by bit, pressed while the key was held
    std::optional<interaction::MouseMoveEvent> cursor_;
};

} // namespace isochron::app
