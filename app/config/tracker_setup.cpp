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
    return Error("{}: this program was built without {}", tracker, library);
}

#ifdef ISOCHRON_WITH_OSC
constexpr bool kWithOsc = true;
std::unique_ptr<TrackedInput> opened(const OscOptions& options) {
    return std::make_unique<OscInput>(options);
}
#else
constexpr bool kWithOsc = false;
std::unique_ptr<TrackedInput> opened(const OscOptions&) {
    throw missing("osc", "liblo");
}
#endif

#ifdef ISOCHRON_WITH_VRPN
constexpr bool kWithVrpn = true;
std::unique_ptr<TrackedInput> opened(const VrpnOptions& options) {
    return std::make_unique<VrpnInput>(options);
}
#else
constexpr bool kWithVrpn = false;
std::unique_ptr<TrackedInput> opened(const VrpnOptions&) {
    throw missing("vrpn", "VRPN");
}
#endif

std::unique_ptr<TrackedInput> opened(const DTrackOptions& options) {
    return std::make_unique<DTrackInput>(options);
}

std::string source_of(const DTrackOptions&, const DTrackDevice& device) {
    return fmt::format("{} {}",
                       device.kind == DTrackKind::flystick ? "Flystick" : name_of(device.kind),
                       device.id);
}

std::string source_of(const OscOptions& osc, const OscDevice& device) {
    return fmt::format("{}/{}/...", osc.prefix, device.source);
}

std::string source_of(const VrpnOptions&, const VrpnDevice& device) {
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
    each_tracker(config.devices, [&](const char* key, const auto& tracker) {
        try {
            input.add(opened(tracker));
        } catch (const Error& error) {
            throw Error("{}:{}: {}: {}", config.name, tracker.line, key, error.what());
        }
    });
}

std::vector<std::string> describe_devices(const Config& config) {
    std::vector<std::string> lines = describe_openxr(config.openxr);
    each_tracker(config.devices, [&](const char* key, const auto& tracker) {
        if constexpr (requires { tracker.endpoint; })
            lines.push_back(fmt::format("{}: UDP {}", key, to_string(tracker.endpoint)));
        else
            lines.push_back(fmt::format("{}:", key));
        describe_place(tracker.common.calibration, lines);
        for (const auto& each : tracker.devices)
            describe(each.device, source_of(tracker, each), lines);
    });
    lines.push_back(fmt::format("mouse and keyboard: head, wand, mouse, keys{}",
                                config.emulation.gamepad ? ", gamepad while there is one" : ""));
    return lines;
}

std::vector<ConfigProblem> missing_trackers(const Config& config) {
    std::vector<ConfigProblem> lacking;
    const auto add = [&](int line, const char* key, const char* library) {
        lacking.push_back({line, key, missing(key, library).what()});
    };
    if (!config.devices.osc.empty() && !kWithOsc)
        add(config.devices.osc.front().line, "osc", "liblo");
    if (!config.devices.vrpn.empty() && !kWithVrpn)
        add(config.devices.vrpn.front().line, "vrpn", "VRPN");
    if (config.openxr.enabled && !built_with_openxr())
        add(0, "openxr", "OpenXR");
    return lacking;
}

} // namespace isochron::app
