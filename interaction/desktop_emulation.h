// Mouse and keyboard play a tracked head and a wand.
#pragma once

#include "interaction/room_panel.h"
#include "interaction/tracked_input.h"
#include "interaction/window_event.h"

#include <functional>
#include <memory>
#include <optional>
#include <span>

namespace isochron::interaction {

struct EmulationOptions {
    Pose head{{0.0f, 1.6f, 0.0f},
              {1.0f, 0.0f, 0.0f, 0.0f}}; ///< where it starts and Home returns to
    float walk_speed = 1.0f;             ///< [m/s], three times with Shift
    float look_speed = 2.0f;             ///< [rad per window height dragged]
    float wand_reach = 0.45f;            ///< [m] wand ahead of the head
    bool gamepad = true;                 ///< false: it is ignored
    float dead_zone = 0.15f;             ///< of a gamepad's axes, below 1
    float vertical_fov = 0.9f; ///< [rad] of the window, to aim the wand's ray at the cursor
};

/// Where the emulated head is: exact, so that a session comes back as it was.
struct StandingPlace {
    glm::vec3 position{0.0f};
    float yaw = 0, pitch = 0; ///< [rad] to the left and up
    bool operator==(const StandingPlace&) const = default;
};

/// Where the eye's ray under the cursor leads, for a head: a pose that looks along -Z. Nothing where
/// no picture of that head's is under the cursor.
using EyeRay = std::function<std::optional<Pose>(const Pose& head, const MouseMoveEvent& cursor)>;

/// Devices of every poll: `head`, `wand`, `mouse`, `keys`, `gamepad` while there is one, and
/// `pointer`, the eye's ray under the cursor, while that is known; their buttons and valuators are those of actions.h. A key that is tapped between two polls is down in
/// one of them, several taps one after the other, so that slow frames lose none. Without focus,
/// nothing is down.
class DesktopEmulation final : public TrackedInput {
  public:
    explicit DesktopEmulation(const EmulationOptions& options);
    ~DesktopEmulation() override;
    /// Events since the last poll, in order. Events that a panel took are not passed on, except
    /// releases: pass those always, so that nothing stays down.
    void feed(std::span<const WindowEvent> events);
    InputState poll(Seconds now) override;

    /// The panel that stands in the room, if any: where the cursor is over it, the wand points
    /// right there, and the left button is the wand's first.
    void set_panel(const RoomPanel& panel, const PanelSize& size);

    StandingPlace standing() const;
    /// A place that is not finite is none.
    void stand(const StandingPlace& place);

    /// What the windows show under the cursor. Without it the wand aims by the field of view.
    void set_eye(EyeRay eye);

  private:
    struct State;
    std::unique_ptr<State> state_;
};

} // namespace isochron::interaction
