// Mouse and keyboard play a tracked head and a wand.
#pragma once

#include "interaction/controls/room_panel.h"
#include "interaction/input/tracked_input.h"
#include "interaction/input/window_event.h"

#include <functional>
#include <memory>
#include <optional>
#include <span>

namespace isochron::interaction {

struct EmulationOptions {
    Pose head{{0.0f, 1.6f, 0.0f},
              {1.0f, 0.0f, 0.0f, 0.0f}}; ///< where the head starts; Home returns to it
    float walk_speed = 1.0f;             ///< [m/s], three times with Shift
    float look_speed = 2.0f;             ///< [rad per window height dragged]
    float wand_reach = 0.45f;            ///< [m] wand ahead of the head
    bool gamepad = true;                 ///< false: gamepads are ignored
    float dead_zone = 0.15f;   ///< deflection of a gamepad's axes that counts as none, below 1
    float vertical_fov = 0.9f; ///< [rad] of the window, to aim the wand's ray at the cursor
};

/// Where the emulated head is. Exact, so that a saved session is restored as it was.
struct StandingPlace {
    glm::vec3 position{0.0f};
    float yaw = 0, pitch = 0; ///< [rad] to the left and up
    bool operator==(const StandingPlace&) const = default;
};

/// The ray from the eye through the cursor, for a head: a pose whose -Z is the ray's direction.
/// Nothing if the picture under the cursor is not of that head.
using EyeRay = std::function<std::optional<Pose>(const Pose& head, const MouseMoveEvent& cursor)>;

/// Every poll states `head`, `wand`, `mouse` and `keys`, `gamepad` while there is one, and
/// `pointer` (the eye's ray through the cursor) while that is known. Buttons and valuators are as
/// in actions.h. A key that is tapped between two polls is down in the next poll; several taps are
/// shown in several polls, so that slow frames lose none. Without focus, no key or mouse button is
/// down.
class DesktopEmulation final : public TrackedInput {
  public:
    explicit DesktopEmulation(const EmulationOptions& options);
    ~DesktopEmulation() override;
    /// Takes the events since the last poll, in order. Leave out the events that a panel took, but
    /// always pass releases, so that nothing stays down.
    void feed(std::span<const WindowEvent> events);
    InputState poll(Seconds now) override;

    /// Sets the panel that stands in the room. While the cursor is over it, the wand points to the
    /// cursor's place on it, and the left mouse button is the wand's first button.
    void set_panel(const RoomPanel& panel, const PanelSize& size);

    StandingPlace standing() const;
    /// Puts the head there; a place that is not finite is ignored.
    void stand(const StandingPlace& place);

    /// Sets the function that gives the eye's ray through the cursor. Without it the wand aims by
    /// `vertical_fov`.
    void set_eye(EyeRay eye);

  private:
    struct State;
    std::unique_ptr<State> state_;
};

} // namespace isochron::interaction
