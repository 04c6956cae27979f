// Opens the trackers of a configuration, and describes them in words.
#include "app/config/tracker_setup.h"

#include "interaction/recording/recording.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>

namespace isochron::app {
namespace {

using namespace interaction;

/// Rounded, and without negative zeros.
float tidy(float value) {
    return std::round(value * 1000.0f) / 1000.0f + 0.0f;
}

std::string in_words(const Pose& pose) {
    const glm::vec3 p = pose.position;
    const glm::vec3 ahead = pose.orientation * glm::vec3(0, 0, -1);
    const glm::vec3 up = pose.orientation * glm::vec3(0, 1, 0);
    return fmt::format("at {:.3f} {:.3f} {:.3f} m, -Z to {:.2f} {:.2f} {:.2f}, "
                       "+Y to {:.2f} {:.2f} {:.2f}",
                       tidy(p.x), tidy(p.y), tidy(p.z), tidy(ahead.x), tidy(ahead.y), tidy(ahead.z),
                       tidy(up.x), tidy(up.y), tidy(up.z));
}

/// Describes where a tracker stands, from the calibration of its devices.
void describe_place(const Calibration& calibration, std::vector<std::string>& lines) {
    lines.push_back(fmt::format("  in the room {}{}", in_words(calibration.room_from_tracker),
                                calibration.scale == 1.0
                                    ? std::string()
                                    : fmt::format(", scaled by {}", calibration.scale)));
}

void describe(const DeviceOptions& device, const std::string& source,
              std::vector<std::string>& lines) {
    lines.push_back(fmt::format("  {}: {}", device.name, source));
    if (!device.has_pose)
        return;
    lines.push_back(fmt::format("    {} in its sensor {}", device.name,
                                in_words(device.calibration.sensor_from_thing)));
    const PoseFilterLimits& limits = device.limits;
    lines.push_back(fmt::format(
        "    held after {:.0f} ms, lost after {:.0f} ms, jumps beyond {} m/s accepted after {:.0f} "
        "ms, {}",
        1e3 * limits.held_after.count(), 1e3 * limits.lost_after.count(), limits.fastest,
        1e3 * limits.accept_jump.count(),
        device.prediction.on
            ? fmt::format("predicted by {:.0f} ms, at most {:.0f} ms",
                          1e3 * (device.prediction.display_delay + device.latency).count(),
                          1e3 * device.prediction.limit.count())
            : "not predicted"));
}

Error missing(const char* tracker, const char* library) {
    return Error(fmt::format("{}: this program was built without {}", tracker, library));
}

#ifdef ISOCHRON_WITH_OSC
constexpr bool kWithOsc = true;
std::unique_ptr<TrackedInput> open_osc(const OscOptions& options) {
    return std::make_unique<OscInput>(options);
}
#else
constexpr bool kWithOsc = false;
std::unique_ptr<TrackedInput> open_osc(const OscOptions&) {
    throw missing("osc", "liblo");
}
#endif

#ifdef ISOCHRON_WITH_VRPN
constexpr bool kWithVrpn = true;
std::unique_ptr<TrackedInput> open_vrpn(const VrpnOptions& options) {
    return std::make_unique<VrpnInput>(options);
}
#else
constexpr bool kWithVrpn = false;
std::unique_ptr<TrackedInput> open_vrpn(const VrpnOptions&) {
    throw missing("vrpn", "VRPN");
}
#endif

/// All devices of all trackers.
std::vector<const DeviceOptions*> all_devices(const DeviceConfig& config) {
    std::vector<const DeviceOptions*> all;
    const auto add = [&](const auto& trackers) {
        for (const auto& tracker : trackers)
            for (const auto& each : tracker.devices)
                all.push_back(&each.device);
    };
    add(config.dtrack);
    add(config.osc);
    add(config.vrpn);
    return all;
}

std::string source_of(const DTrackDevice& device) {
    switch (device.kind) {
    case DTrackKind::body: return fmt::format("body {}", device.id);
    case DTrackKind::flystick: return fmt::format("Flystick {}", device.id);
    case DTrackKind::marker: return fmt::format("marker {}", device.id);
    }
    return {};
}

std::string source_of(const VrpnDevice& device) {
    std::string text;
    if (!device.tracker.empty())
        text += fmt::format("sensor {} of {}, ", device.sensor, device.tracker);
    if (!device.buttons.empty())
        text += fmt::format("buttons of {}, ", device.buttons);
    if (!device.analog.empty())
        text += fmt::format("valuators of {}, ", device.analog);
    text.resize(text.size() - 2);
    return text;
}

} // namespace

void open_trackers(const Config& config, CompositeInput& input) {
    // Errors name the place in the file of the tracker that cannot be opened.
    const auto open_all = [&](const char* kind, const auto& trackers, const std::vector<int>& lines,
                              auto&& open) {
        for (std::size_t i = 0; i < trackers.size(); ++i) {
            try {
                input.add(open(trackers[i]));
            } catch (const Error& error) {
                throw Error(
                    fmt::format("{}:{}: {}: {}", config.name, lines.at(i), kind, error.what()));
            }
        }
    };
    const DeviceConfig& devices = config.devices;
    open_all("dtrack", devices.dtrack, devices.places.dtrack,
             [](const DTrackOptions& options) { return std::make_unique<DTrackInput>(options); });
    open_all("osc", devices.osc, devices.places.osc, open_osc);
    open_all("vrpn", devices.vrpn, devices.places.vrpn, open_vrpn);
}

std::vector<std::string> describe_devices(const Config& config) {
    std::vector<std::string> lines = describe_openxr(config.openxr);
    for (const DTrackOptions& dtrack : config.devices.dtrack) {
        lines.push_back(fmt::format("dtrack: UDP {}", to_string(dtrack.endpoint)));
        describe_place(dtrack.devices.front().device.calibration, lines);
        for (const DTrackDevice& device : dtrack.devices)
            describe(device.device, source_of(device), lines);
    }
    for (const OscOptions& osc : config.devices.osc) {
        lines.push_back(fmt::format("osc: UDP {}", to_string(osc.endpoint)));
        describe_place(osc.devices.front().device.calibration, lines);
        for (const OscDevice& device : osc.devices)
            describe(device.device, fmt::format("{}/{}/...", osc.prefix, device.source), lines);
    }
    for (const VrpnOptions& vrpn : config.devices.vrpn) {
        lines.emplace_back("vrpn:");
        describe_place(vrpn.devices.front().device.calibration, lines);
        for (const VrpnDevice& device : vrpn.devices)
            describe(device.device, source_of(device), lines);
    }
    lines.push_back(fmt::format("mouse and keyboard: head, wand, mouse, keys{}",
                                config.emulation.gamepad ? ", gamepad while there is one" : ""));
    return lines;
}

std::vector<MissingTracker> missing_trackers(const Config& config) {
    std::vector<MissingTracker> lacking;
    const auto add = [&](const std::vector<int>& lines, const char* key, const char* library) {
        lacking.push_back({lines.empty() ? 0 : lines.front(), key, missing(key, library).what()});
    };
    if (!config.devices.osc.empty() && !kWithOsc)
        add(config.devices.places.osc, "osc", "liblo");
    if (!config.devices.vrpn.empty() && !kWithVrpn)
        add(config.devices.places.vrpn, "vrpn", "VRPN");
    if (config.openxr.enabled && !built_with_openxr())
        add({}, "openxr", "OpenXR");
    return lacking;
}

std::vector<std::string> device_warnings(const Config& config) {
    std::vector<std::string> warnings;
    const auto warn = [&](std::string_view text) {
        warnings.push_back(fmt::format("{}: {}", config.name, text));
    };
    const auto devices = all_devices(config.devices);
    const bool head = std::ranges::any_of(
        devices, [](const DeviceOptions* each) { return each->name == "head" && each->has_pose; });
    if (!devices.empty() && !head && !config.openxr.enabled)
        warn("no tracked device is called head: mouse and keyboard move it");
    return warnings;
}

} // namespace isochron::app
