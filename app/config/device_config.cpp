// The trackers and other devices of an installation: the only file that knows their keys.
#include "app/config/device_config.h"

#include <glm/trigonometric.hpp>

#include <fmt/format.h>

#include <functional>
#include <set>
#include <utility>

namespace isochron::app {
namespace {

using namespace interaction;

constexpr double kRoom = 1000; ///< [m] larger than any installation
constexpr double kDegree = 0.01745329252;

void milliseconds(TomlReader& reader, std::string_view key, double high, Seconds& into) {
    double value = into.count() * 1e3;
    reader.number(key, 0.0, high, value);
    into = Seconds(value / 1e3);
}

/// Position and orientation, the latter as heading, pitch and roll in degrees.
void pose(TomlReader& reader, std::string_view position, std::string_view orientation, Pose& into) {
    reader.vector(position, into.position);
    glm::vec3 degrees(0);
    reader.vector(orientation, degrees);
    if (reader.has(orientation))
        into.orientation = rotation_from_angles(glm::radians(degrees));
    if (glm::length(into.position) > kRoom)
        reader.fail(position, fmt::format("expected meters in the room, got {} m",
                                          glm::length(into.position)));
}

/// `[tracking]`: the defaults of every device.
void read_filter(TomlReader& reader, PoseFilterLimits& limits, PredictionOptions& prediction) {
    double turn = limits.fastest_turn / kDegree;
    reader.number("fastest", 0.1, 1000.0, limits.fastest);
    reader.number("fastest_turn", 1.0, 1e5, turn);
    limits.fastest_turn = turn * kDegree;
    milliseconds(reader, "accept_jump_ms", 60e3, limits.accept_jump);
    milliseconds(reader, "held_after_ms", 60e3, limits.held_after);
    milliseconds(reader, "lost_after_ms", 600e3, limits.lost_after);
    if (limits.lost_after < limits.held_after || limits.held_after.count() == 0)
        reader.fail("lost_after_ms", "expected 0 < held_after_ms <= lost_after_ms");
    reader.flag("prediction", prediction.on);
    milliseconds(reader, "display_delay_ms", 200, prediction.display_delay);
    milliseconds(reader, "prediction_limit_ms", 200, prediction.limit);
    milliseconds(reader, "smoothing_ms", 500, prediction.smoothing);
}

/// Reads the settings that all devices of a tracker share.
void read_tracker(TomlReader& reader, DeviceOptions& common) {
    pose(reader, "position", "orientation", common.calibration.room_from_tracker);
    reader.number("scale", 1e-6, 1e6, common.calibration.scale);
    milliseconds(reader, "latency_ms", 500, common.latency);
}

void read_device(TomlReader& reader, DeviceOptions& device) {
    reader.text("name", device.name);
    if (device.name.empty())
        reader.fail("name", "expected a device's name, such as head or wand");
    pose(reader, "offset", "rotation", device.calibration.sensor_from_thing);
    read_filter(reader, device.limits, device.prediction);
    std::vector<double> buttons, valuators, factors;
    reader.list("buttons", 0, TrackedDevice::kMostButtons - 1, TrackedDevice::kMostButtons,
                buttons);
    reader.list("valuators", 0, TrackedDevice::kMostValuators - 1, TrackedDevice::kMostValuators,
                valuators);
    reader.list("valuator_factors", -1000, 1000, TrackedDevice::kMostValuators, factors);
    const auto index = [&](std::string_view key, double value) {
        if (value != static_cast<double>(static_cast<std::size_t>(value)))
            reader.fail(key, fmt::format("expected whole numbers, got {}", value));
        return static_cast<std::size_t>(value);
    };
    for (const double button : buttons)
        device.buttons.push_back(index("buttons", button));
    if (!factors.empty() && factors.size() != valuators.size())
        reader.fail("valuator_factors", fmt::format("expected one for each of {} valuators, got {}",
                                                    valuators.size(), factors.size()));
    for (std::size_t i = 0; i < valuators.size(); ++i)
        device.valuators.push_back({index("valuators", valuators[i]),
                                    factors.empty() ? 1.0f : static_cast<float>(factors[i])});
}

/// Reads the devices of one tracker, each starting from the shared settings. Names must differ.
template <typename Device>
void read_devices_of(TomlReader& reader, const DeviceOptions& common, std::vector<Device>& into,
                     const std::function<void(TomlReader&, Device&)>& read_rest) {
    std::set<std::string> names;
    const bool any = reader.tables("devices", [&](TomlReader& inner) {
        Device& device = into.emplace_back();
        device.device = common;
        read_device(inner, device.device);
        read_rest(inner, device);
        if (!names.insert(device.device.name).second)
            inner.fail("name", fmt::format("there is a device '{}' already", device.device.name));
    });
    if (!any)
        reader.fail("devices", "missing, a tracker without devices tracks nothing");
}

void read_endpoint(TomlReader& reader, Endpoint& endpoint) {
    reader.text("address", endpoint.address);
    if (!is_address(endpoint.address))
        reader.fail("address", fmt::format("expected a numeric IPv4 or IPv6 address, got '{}'",
                                           endpoint.address));
    reader.integer("port", 1, 65535, endpoint.port);
}

/// `from`: the only sender whose datagrams are accepted.
void read_sender(TomlReader& reader, std::optional<Endpoint>& from) {
    std::string text;
    reader.text("from", text);
    if (!reader.has("from"))
        return;
    from = endpoint_from(text);
    if (!from)
        reader.fail("from", fmt::format("expected a numeric address such as 192.168.0.10 or "
                                        "192.168.0.10:5000, got '{}'",
                                        text));
}

void read_dtrack(TomlReader& reader, DeviceOptions common, DTrackOptions& dtrack) {
    read_endpoint(reader, dtrack.endpoint);
    read_sender(reader, dtrack.from);
    read_tracker(reader, common);
    read_devices_of<DTrackDevice>(
        reader, common, dtrack.devices, [](TomlReader& inner, DTrackDevice& device) {
            int given = 0;
            for (const auto& [key, kind] :
                 {std::pair{"body", DTrackKind::body}, std::pair{"flystick", DTrackKind::flystick},
                  std::pair{"marker", DTrackKind::marker}}) {
                inner.integer(key, 0, 65535, device.id);
                if (!inner.has(key))
                    continue;
                device.kind = kind;
                ++given;
            }
            if (given != 1)
                inner.fail("body", "expected one of body, flystick and marker, with its number");
        });
}

void read_osc(TomlReader& reader, DeviceOptions common, OscOptions& osc) {
    read_endpoint(reader, osc.endpoint);
    read_tracker(reader, common);
    reader.text("prefix", osc.prefix);
    if (!osc.prefix.empty() && (!osc.prefix.starts_with('/') || osc.prefix.ends_with('/')))
        reader.fail("prefix",
                    fmt::format("expected an address such as /isochron, got '{}'", osc.prefix));
    read_devices_of<OscDevice>(reader, common, osc.devices,
                               [](TomlReader& inner, OscDevice& device) {
                                   device.source = device.device.name;
                                   inner.text("source", device.source);
                                   inner.flag("pose", device.device.has_pose);
                               });
}

void read_vrpn(TomlReader& reader, DeviceOptions common, VrpnOptions& vrpn) {
    read_tracker(reader, common);
    read_devices_of<VrpnDevice>(
        reader, common, vrpn.devices, [](TomlReader& inner, VrpnDevice& device) {
            for (const auto& [key, name] :
                 {std::pair{"tracker", &device.tracker}, std::pair{"button", &device.buttons},
                  std::pair{"analog", &device.analog}}) {
                inner.text(key, *name);
                if (inner.has(key) && name->find('@') == std::string::npos)
                    inner.fail(key, fmt::format("expected NAME@HOST, got '{}'", *name));
            }
            inner.integer("sensor", 0, 1023, device.sensor);
            device.device.has_pose = inner.has("tracker");
            if (!inner.has("tracker") && !inner.has("button") && !inner.has("analog"))
                inner.fail("tracker", "missing, expected tracker, button or analog");
        });
}

void read_gamepad(TomlReader& reader, EmulationOptions& emulation) {
    reader.flag("enabled", emulation.gamepad);
    reader.number("dead_zone", 0.0, 0.9, emulation.dead_zone);
}

} // namespace

void read_devices(TomlReader& root, DeviceConfig& devices, EmulationOptions& emulation) {
    DeviceOptions common;
    root.table("tracking",
               [&](TomlReader& reader) { read_filter(reader, common.limits, common.prediction); });
    root.table_or_tables("dtrack", [&](TomlReader& reader) {
        devices.places.dtrack.push_back(reader.line());
        read_dtrack(reader, common, devices.dtrack.emplace_back());
    });
    root.table_or_tables("osc", [&](TomlReader& reader) {
        devices.places.osc.push_back(reader.line());
        read_osc(reader, common, devices.osc.emplace_back());
    });
    root.table_or_tables("vrpn", [&](TomlReader& reader) {
        devices.places.vrpn.push_back(reader.line());
        read_vrpn(reader, common, devices.vrpn.emplace_back());
    });
    root.table("gamepad", [&](TomlReader& reader) { read_gamepad(reader, emulation); });
}

void read_comfort(TomlReader& root, ComfortOptions& comfort, bool& grid) {
    root.table("comfort", [&](TomlReader& reader) {
        reader.flag("grid", grid);
        reader.flag("fade_when_lost", comfort.fade_when_lost);
        milliseconds(reader, "lost_fade_ms", 60e3, comfort.lost_fade);
        reader.flag("vignette", comfort.vignette);
        reader.number("vignette_speed", 0.0, 100.0, comfort.vignette_speed);
        reader.number("vignette_full", 0.0, 100.0, comfort.vignette_full);
        glm::vec2 near(comfort.near_gone, comfort.near_whole);
        reader.vector("near_fade", near);
        if (reader.has("near_fade") && !(near.x >= 0 && near.x < near.y && near.y <= 10))
            reader.fail(
                "near_fade",
                fmt::format("expected two ascending distances from 0 to 10 m, got {} and {}",
                            near.x, near.y));
        comfort.near_gone = near.x;
        comfort.near_whole = near.y;
        double turn = comfort.vignette_turn / kDegree, full = comfort.vignette_turn_full / kDegree;
        reader.number("vignette_turn", 0.0, 3600.0, turn);
        reader.number("vignette_turn_full", 0.0, 3600.0, full);
        comfort.vignette_turn = turn * kDegree;
        comfort.vignette_turn_full = full * kDegree;
        milliseconds(reader, "vignette_fade_ms", 60e3, comfort.vignette_fade);
    });
}

} // namespace isochron::app
