// What is refused of the trackers and their devices.
#include "app/config/config_checks.h"

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include <algorithm>

namespace isochron::app {

using namespace interaction;

namespace {

void expect_in_room(const TomlTable& at, const char* key, const glm::vec3& position) {
    constexpr float kRoom = 1000; // [m] larger than any installation
    if (glm::length(position) > kRoom)
        at.fail(key, fmt::format("expected meters in the room, got {} m", glm::length(position)));
}

void check_device(const TomlTable& at, const Config& config, DeviceOptions& device) {
    expect_in_room(at, "offset", device.calibration.sensor_from_thing.position);
    check(at, config, device.limits);
    if (!device.valuator_factors.empty() &&
        device.valuator_factors.size() != device.valuators.size())
        at.fail("valuator_factors",
                fmt::format("expected one for each of {} valuators, got {}",
                            device.valuators.size(), device.valuator_factors.size()));
}

template <class Tracker>
void check_tracker(const TomlTable& at, const Tracker& tracker) {
    expect_in_room(at, "position", tracker.common.calibration.room_from_tracker.position);
    if (!at.has("devices"))
        at.fail("devices", "missing, a tracker without devices tracks nothing");
    if constexpr (requires { tracker.endpoint; })
        if (!is_address(tracker.endpoint.address))
            at.fail("address", fmt::format("expected a numeric IPv4 or IPv6 address, got '{}'",
                                           tracker.endpoint.address));
}

} // namespace

void check(const TomlTable& at, const Config&, PoseFilterLimits& limits) {
    if (limits.lost_after < limits.held_after || limits.held_after.count() == 0)
        at.fail("lost_after_ms", "expected 0 < held_after_ms <= lost_after_ms");
}

void check(const TomlTable& at, const Config& config, DTrackDevice& device) {
    check_device(at, config, device.device);
    if (std::ranges::count_if(kNames<DTrackKind>, [&](auto key) { return at.has(key); }) != 1)
        at.fail("body", "expected one of body, flystick and marker, with its number");
}

void check(const TomlTable& at, const Config&, DTrackOptions& dtrack) {
    check_tracker(at, dtrack);
}

void check(const TomlTable& at, const Config& config, OscDevice& device) {
    check_device(at, config, device.device);
    if (!at.has("source"))
        device.source = device.device.name;
}

void check(const TomlTable& at, const Config&, OscOptions& osc) {
    check_tracker(at, osc);
    if (!osc.prefix.empty() && (!osc.prefix.starts_with('/') || osc.prefix.ends_with('/')))
        at.fail("prefix",
                fmt::format("expected an address such as /isochron, got '{}'", osc.prefix));
}

void check(const TomlTable& at, const Config& config, VrpnDevice& device) {
    check_device(at, config, device.device);
    device.device.has_pose = at.has("tracker");
    bool any = false;
    for (const auto& [key, name] :
         {std::pair{"tracker", &device.tracker}, std::pair{"button", &device.buttons},
          std::pair{"analog", &device.analog}}) {
        any |= at.has(key);
        if (at.has(key) && name->find('@') == std::string::npos)
            at.fail(key, fmt::format("expected NAME@HOST, got '{}'", *name));
    }
    if (!any)
        at.fail("tracker", "missing, expected tracker, button or analog");
}

void check(const TomlTable& at, const Config&, VrpnOptions& vrpn) {
    check_tracker(at, vrpn);
}

} // namespace isochron::app
