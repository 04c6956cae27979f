// Recorded frames and headers to JSON and back.
#include "interaction/recording/recording_json.h"

#include "interaction/controls/action_table.h"
#include "interaction/error.h"
#include "interaction/navigation/navigation.h"
#include "interaction/recording/commands_json.h"
#include "interaction/recording/json_values.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string_view>

namespace isochron::interaction {
namespace {

using nlohmann::json;

constexpr std::string_view kFormat = "isochron recording";
constexpr std::size_t kMostDevices = 64;
constexpr std::size_t kMostValuatorsOfOne = 64;
constexpr std::size_t kLongestName = 256; ///< [byte]

json velocity_json(const Velocity& velocity) {
    const glm::dvec3& v = velocity.linear;
    const glm::dvec3& w = velocity.angular;
    return {v.x, v.y, v.z, w.x, w.y, w.z};
}

Velocity velocity_from(const json& value) {
    list(value, "velocity", 6, 6);
    Velocity velocity;
    for (int i = 0; i < 3; ++i) {
        velocity.linear[i] = number(value[i], "velocity");
        velocity.angular[i] = number(value[i + 3], "velocity");
    }
    return velocity;
}

json actions_json(const ActionSet& actions) {
    json names = json::array();
    for (std::size_t i = 0; i < actions.size(); ++i)
        if (actions[i])
            names.push_back(name_of(static_cast<Action>(i)));
    return names;
}

ActionSet actions_from(const json& value) {
    ActionSet actions;
    for (const json& name : list(value, "actions", 0, kActions)) {
        const auto action = action_named(text(name, "actions", kLongestName));
        if (!action)
            fail("actions", "names of actions that this program has", name);
        actions |= bit(*action);
    }
    return actions;
}

json device_json(const DeviceState& device) {
    json result{{"name", device.name}};
    if (device.pose)
        result["pose"] = pose_json(*device.pose);
    if (!device.pose_valid)
        result["valid"] = false;
    if (device.buttons != 0)
        result["buttons"] = device.buttons;
    if (device.actions.any())
        result["actions"] = actions_json(device.actions);
    if (!device.valuators.empty())
        result["valuators"] = device.valuators;
    if (device.pose_lost)
        result["lost"] = true;
    if (device.velocity)
        result["velocity"] = velocity_json(*device.velocity);
    if (device.measured)
        result["measured"] = device.measured->count();
    if (device.device_time)
        result["device_time"] = device.device_time->count();
    return result;
}

DeviceState device_from(const json& value) {
    Members members(value, "device");
    DeviceState device;
    device.name = text(members.at("name"), "name", kLongestName);
    if (const json* found = members.find("pose"))
        device.pose = pose_from(*found);
    if (const json* found = members.find("valid"))
        device.pose_valid = boolean(*found, "valid");
    if (const json* found = members.find("buttons"))
        device.buttons = natural(*found, "buttons", std::numeric_limits<std::uint64_t>::max());
    if (const json* found = members.find("actions"))
        device.actions = actions_from(*found);
    if (const json* found = members.find("valuators"))
        for (const json& valuator : list(*found, "valuators", 0, kMostValuatorsOfOne))
            device.valuators.push_back(small_number(valuator, "valuators"));
    if (const json* found = members.find("lost"))
        device.pose_lost = boolean(*found, "lost");
    if (device.pose_lost && device.pose_valid)
        throw Error("lost: the pose of {} is valid", excerpt(json(device.name)));
    if (const json* found = members.find("velocity"))
        device.velocity = velocity_from(*found);
    if (const json* found = members.find("measured"))
        device.measured = Seconds(number(*found, "measured"));
    if (const json* found = members.find("device_time"))
        device.device_time = Seconds(number(*found, "device_time"));
    members.done({"name", "pose", "valid", "buttons", "actions", "valuators", "lost", "velocity",
                  "measured", "device_time"});
    return device;
}

/// Adds the devices of a list. @throws Error when a name occurs twice
void add_devices(const json& value, InputState& input) {
    for (const json& device : list(value, "devices", 0, kMostDevices)) {
        input.devices.push_back(device_from(device));
        if (input.find(input.devices.back().name) != &input.devices.back())
            fail("devices", "every name once", json(input.devices.back().name));
    }
}

json latched_json(const InputState& latched) {
    json devices = json::array();
    for (const DeviceState& device : latched.devices)
        devices.push_back(device_json(device));
    return {{"t", latched.time.count()}, {"devices", std::move(devices)}};
}

InputState latched_from(const json& value, Seconds polled) {
    Members members(value, "latched");
    InputState latched;
    latched.time = Seconds(number(members.at("t"), "t"));
    if (latched.time < polled)
        throw Error("latched: time goes back from {} to {}", polled.count(), latched.time.count());
    add_devices(members.at("devices"), latched);
    members.done({"t", "devices"});
    return latched;
}

bool same_names(const std::vector<DeviceState>& a, const std::vector<DeviceState>& b) {
    return std::ranges::equal(a, b, {}, &DeviceState::name, &DeviceState::name);
}

void change(std::vector<DeviceState>& devices, DeviceState changed) {
    const auto found = std::ranges::find(devices, changed.name, &DeviceState::name);
    if (found == devices.end())
        throw Error("changed: there was no device {} before", excerpt(json(changed.name)));
    *found = std::move(changed);
}

void add_commands(json& to, const char* key, const Commands& commands) {
    if (!commands.empty())
        to[key] = commands_json(commands);
}

} // namespace

json to_json(const RecordingHeader& header) {
    json value{{"format", kFormat},         {"version", kRecordingVersion},
               {"program", header.program}, {"configuration", header.configuration},
               {"data", header.data},       {"data_hash", header.data_hash},
               {"window", header.window},   {"start", commands_json(header.start)}};
    if (header.text > 0)
        value["text"] = header.text;
    if (header.reading != 0)
        value["reading_number"] = header.reading;
    return value;
}

RecordingHeader header_from_json(const json& value) {
    const auto format = value.is_object() ? value.find("format") : value.end();
    if (!value.is_object() || format == value.end() || *format != kFormat)
        throw Error("not a recording: expected \"format\":\"{}\"", kFormat);
    Members members(value, "header");
    members.at("format");
    RecordingHeader header;
    header.version = static_cast<int>(natural(members.at("version"), "version", 1'000'000));
    if (header.version < 1 || header.version > kRecordingVersion)
        throw Error("version: this program reads 1 to {}, the recording has {}", kRecordingVersion,
                    header.version);
    header.program = text(members.at("program"), "program");
    header.configuration = text(members.at("configuration"), "configuration");
    header.data = text(members.at("data"), "data");
    header.data_hash = text(members.at("data_hash"), "data_hash");
    if (const json* window = members.find("window")) {
        constexpr std::uint64_t kWidest = 16384; // pixels
        const json& size = list(*window, "window", 2, 2);
        for (std::size_t i = 0; i < 2; ++i)
            header.window[i] = static_cast<int>(natural(size[i], "window", kWidest));
    }
    if (const json* share = members.find("text"))
        header.text = number(*share, "text", 0, 1);
    if (const json* reading = members.find("reading_number"))
        header.reading = static_cast<std::uint32_t>(
            natural(*reading, "reading_number", std::numeric_limits<std::uint32_t>::max()));
    header.start = commands_from(members.at("start"), "start");
    members.done({"format", "version", "program", "configuration", "data", "data_hash", "window",
                  "text", "reading_number", "start"});
    return header;
}

json to_json(const RecordedFrame& frame, const RecordedFrame* before) {
    json result{{"t", frame.input.time.count()}};
    const std::vector<DeviceState>& devices = frame.input.devices;
    const bool as_before = before && same_names(devices, before->input.devices);
    json stated = json::array();
    for (std::size_t i = 0; i < devices.size(); ++i)
        if (!as_before || devices[i] != before->input.devices[i])
            stated.push_back(device_json(devices[i]));
    if (!as_before)
        result["devices"] = std::move(stated);
    else if (!stated.empty())
        result["changed"] = std::move(stated);
    add_commands(result, "commands", frame.commands);
    add_commands(result, "panel", frame.from_panel);
    if (frame.footprint != (before ? before->footprint : ""))
        result["footprint"] = frame.footprint;
    if (!frame.latched.devices.empty())
        result["latched"] = latched_json(frame.latched);
    return result;
}

RecordedFrame frame_from_json(const json& value, const RecordedFrame* before) {
    Members members(value, "frame");
    RecordedFrame frame;
    frame.input.time = Seconds(number(members.at("t"), "t"));
    if (before && frame.input.time < before->input.time)
        throw Error("time goes back from {} to {}", before->input.time.count(),
                    frame.input.time.count());
    std::vector<DeviceState>& devices = frame.input.devices;
    if (const json* all = members.find("devices")) {
        add_devices(*all, frame.input);
    } else if (before) {
        devices = before->input.devices;
    }
    if (const json* changed = members.find("changed"))
        for (const json& device : list(*changed, "changed", 0, kMostDevices))
            change(devices, device_from(device));
    if (const json* found = members.find("commands"))
        frame.commands = commands_from(*found, "commands");
    if (const json* found = members.find("panel"))
        frame.from_panel = commands_from(*found, "panel");
    if (const json* found = members.find("footprint"))
        frame.footprint = text(*found, "footprint", kLongestName);
    else if (before)
        frame.footprint = before->footprint;
    if (const json* found = members.find("latched"))
        frame.latched = latched_from(*found, frame.input.time);
    members.done({"t", "devices", "changed", "commands", "panel", "footprint", "latched"});
    return frame;
}

void take_old_bits(InputState& input) {
    ActionSet actions;
    int first = 0;
    for (const char* name : {"keys", "more_keys"}) {
        const DeviceState* device = input.find(name);
        for (int i = 0; device && i < 64; ++i)
            if (device->buttons >> i & 1)
                if (const auto action = action_of_old_bit(first + i))
                    actions |= bit(*action);
        first += 64;
    }
    const auto named = [&](const char* name) {
        return std::ranges::find(input.devices, name, &DeviceState::name);
    };
    const auto more = named("more_keys");
    if (named("keys") != input.devices.end() && more != input.devices.end())
        input.devices.erase(more);
    else if (more != input.devices.end())
        more->name = "keys";
    const auto keys = named("keys");
    if (keys == input.devices.end())
        return;
    keys->buttons = 0;
    keys->actions |= actions;
}

void require_finite(const RecordedFrame& frame) {
    const auto require = [](bool finite, std::string_view what) {
        if (!finite)
            throw Error("{}: expected finite numbers", what);
    };
    for (const InputState* input : {&frame.input, &frame.latched}) {
        require(std::isfinite(input->time.count()), "t");
        for (const DeviceState& device : input->devices) {
            require(!device.pose || is_finite(*device.pose), device.name);
            require(!device.velocity || is_finite(*device.velocity), device.name);
            for (const auto& time : {device.measured, device.device_time})
                require(!time || std::isfinite(time->count()), device.name);
            for (const float valuator : device.valuators)
                require(std::isfinite(valuator), device.name);
        }
    }
    for (const Commands* commands : {&frame.commands, &frame.from_panel})
        if (const char* key = unwritable_field(*commands))
            require(false, key);
}

} // namespace isochron::interaction
