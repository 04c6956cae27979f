// The one interface behind which all input lives: emulation, replay, trackers.
#pragma once

#include "interaction/pose.h"

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace isochron::interaction {

/// What a device's pose is worth.
enum class Tracking : std::uint8_t {
    tracked, ///< measured a moment ago
    held,    ///< the last good pose, kept through a gap
    lost     ///< the last good pose, too old to say where the thing is; or none at all
};

/// State of one device at one time. Well-known names: `head`, `wand`, `mouse`, `keys`, `gamepad`.
struct DeviceState {
    std::string name;
    std::optional<Pose> pose;     ///< last good pose in the room; empty for devices without one
    bool pose_valid = true;       ///< false while `pose` is only held from before
    std::uint64_t buttons = 0;    ///< bit i: button i is down
    std::vector<float> valuators; ///< 0 at rest; meaning and range by device (actions.h)
    bool pose_lost = false;       ///< not valid, and no longer worth to be acted on
    std::optional<Velocity> velocity = std::nullopt;   ///< of the pose, where it is known
    std::optional<Seconds> measured = std::nullopt;    ///< session time when the pose was measured
    std::optional<Seconds> device_time = std::nullopt; ///< the same moment by the device's clock
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

/// A source of device states. Polling is the one call that advances it; the state it returns is a
/// value.
class TrackedInput {
  public:
    virtual ~TrackedInput() = default;
    /// @param now session time of the frame, never decreasing
    virtual InputState poll(Seconds now) = 0;
    /// Where things are with what has come since the last poll: asked right before drawing, for the
    /// same display time. States poses only; buttons and valuators stay for the next poll. Devices
    /// of which nothing can be learned between polls are left out.
    /// @param now session time, not before that of the last poll
    virtual InputState latch(Seconds now) { return {now, {}}; }
    /// Throws away what has come so far: a session begins with what comes from now on.
    virtual void begin() {}
    /// What has been received and refused so far, a line per source; for people.
    virtual std::vector<std::string> status() const { return {}; }
};

/// `tracked`, `held`, `lost`.
std::string_view name_of(Tracking tracking);

} // namespace isochron::interaction
