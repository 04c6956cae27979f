// The one interface behind which all input lives: emulation, replay, trackers.
#pragma once

#include "interaction/input/actions.h"
#include "interaction/pose.h"

#include <algorithm>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace isochron::interaction {

/// How far a device's pose can be trusted.
enum class Tracking : std::uint8_t {
    tracked, ///< measured a moment ago
    held,    ///< the last good pose, kept through a gap
    lost     ///< the last good pose, too old to say where the device is; or no pose at all
};

/// State of one device at one time. Well-known names: `head`, `wand`, `wand2`, `mouse`, `keys`,
/// `gamepad`, `pointer`, `camera`.
struct DeviceState {
    std::string name;
    std::optional<Pose> pose;     ///< last good pose in the room; empty for devices without one
    bool pose_valid = true;       ///< false while `pose` is only held from before
    std::uint64_t buttons = 0;    ///< bit i: button i is down
    std::vector<float> valuators; ///< 0 at rest; meaning and range by device (actions.h)
    bool pose_lost = false;       ///< `pose` is not valid and too old to be used
    std::optional<Velocity> velocity = std::nullopt;   ///< velocity of the pose, if it is known
    std::optional<Seconds> measured = std::nullopt;    ///< session time when the pose was measured
    std::optional<Seconds> device_time = std::nullopt; ///< this moment by the device's clock
    ActionSet actions = {}; ///< device `keys`: actions whose keys are down
    Tracking tracking() const;
    bool operator==(const DeviceState&) const = default;
};

/// All devices as of one moment.
struct InputState {
    Seconds time{0};
    std::vector<DeviceState> devices;
    const DeviceState* find(std::string_view name) const;
    bool operator==(const InputState&) const = default;
};

/// Whether a key or button is down or a valuator is not at rest.
inline bool is_held(const InputState& input) {
    return std::ranges::any_of(input.devices, [](const DeviceState& device) {
        return device.buttons != 0 || device.actions.any() ||
               std::ranges::any_of(device.valuators, [](float value) { return value != 0.0f; });
    });
}

/// A source of device states. Polling is the one call that advances it; the state it returns is a
/// value.
class TrackedInput {
  public:
    virtual ~TrackedInput() = default;
    /// @param now session time of the frame, never decreasing
    virtual InputState poll(Seconds now) = 0;
    /// Poses that include what has arrived since the last poll, for the same display time as that
    /// poll. Called right before drawing. States poses only; buttons and valuators wait for the
    /// next poll. Devices that learn nothing between polls are left out.
    /// @param now session time, not before the last poll's
    virtual InputState latch(Seconds now) { return {now, {}}; }
    /// Throws away what has arrived so far, so that a session begins with what arrives from now on.
    virtual void begin() {}
    /// What has been received and refused so far, in lines for people.
    virtual std::vector<std::string> status() const { return {}; }
};

/// `tracked`, `held`, `lost`.
std::string_view name_of(Tracking tracking);

} // namespace isochron::interaction
