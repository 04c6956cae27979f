// Checks of trackers and their devices.
#include "app/config/check/check.h"

#include "app/config/tracker_setup.h"
#include "app/text.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/gtc/constants.hpp>
#include <glm/gtc/quaternion.hpp>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <string>

namespace isochron::app {
namespace {

using interaction::DTrackKind;

/// Every device of every tracker, in one form.
struct ListedDevice {
    const interaction::DeviceOptions& options;
    std::string key;    ///< key of the tracker's table
    std::string source; ///< the tracked body, sensor or channel that it reads
    int line;           ///< line of the tracker
    bool has_buttons;   ///< whether its source can have buttons, and is there for them
};

std::string source_read_by(const interaction::DTrackOptions& dtrack,
                           const interaction::DTrackDevice& device) {
    return fmt::format("{} {} of {}", name_of(device.kind), device.id, to_string(dtrack.endpoint));
}
std::string source_read_by(const interaction::OscOptions& osc,
                           const interaction::OscDevice& device) {
    return fmt::format("{}/{} of {}", osc.prefix, device.source, to_string(osc.endpoint));
}
std::string source_read_by(const interaction::VrpnOptions&, const interaction::VrpnDevice& device) {
    return device.tracker.empty() ? ""
                                  : fmt::format("sensor {} of {}", device.sensor, device.tracker);
}

bool is_for_buttons(const interaction::DTrackDevice& device) {
    return device.kind == DTrackKind::flystick;
}
bool is_for_buttons(const interaction::OscDevice& device) {
    return !device.device.buttons.empty() || !device.device.valuators.empty();
}
bool is_for_buttons(const interaction::VrpnDevice& device) {
    return !device.buttons.empty() || !device.analog.empty();
}

std::vector<ListedDevice> listed(const CheckedRoom& room) {
    std::vector<ListedDevice> all;
    each_tracker(room.config().devices, [&](const char* key, const auto& tracker) {
        for (const auto& each : tracker.devices)
            all.push_back({each.device, key, source_read_by(tracker, each), tracker.line,
                           is_for_buttons(each)});
    });
    return all;
}

/// Whether a viewer's head is what a device tracks.
bool is_head(const CheckedRoom& room, const std::string& device) {
    return std::ranges::count(room.installation().viewers, device, &stereo::Viewer::head) > 0;
}

/// Mouse, keyboard and a headset provide `head`; any other name needs a tracker.
void heads_without_tracker(const CheckedRoom& room, const Tell& tell) {
    const auto devices = listed(room);
    for (const stereo::Viewer& viewer : room.installation().viewers) {
        const std::string& head = viewer.head;
        const bool tracked =
            head == "head" || std::ranges::any_of(devices, [&](const ListedDevice& device) {
                return device.options.name == head && device.options.has_pose;
            });
        if (!tracked)
            tell(viewer.line.number, "no tracker provides device {}, which tracks viewer {}", head,
                 viewer.name);
    }
}

/// A tracker that tracks no head.
void trackers_without_head(const CheckedRoom& room, const Tell& tell) {
    const auto devices = listed(room);
    if (!devices.empty() && !room.config().openxr.enabled && is_head(room, "head") &&
        std::ranges::none_of(devices, [&](const ListedDevice& device) {
            return device.options.has_pose && is_head(room, device.options.name);
        }))
        tell.of(devices.front().key)(
            devices.front().line, "no tracked device is called head: mouse and keyboard move it");
}

/// Buttons of a device with a name that nothing acts on, and names with a slip.
void names_without_effect(const CheckedRoom& room, const Tell& tell) {
    const auto devices = listed(room);
    const std::vector<std::string> known{"head", "wand", "wand2"};
    const auto acts = [&](const std::string& name) {
        return is_head(room, name) || std::ranges::count(known, name) > 0;
    };
    const bool hand = std::ranges::any_of(devices, [](const ListedDevice& device) {
        return device.options.name == "wand" || device.options.name == "wand2";
    });
    for (const ListedDevice& device : devices) {
        const std::string& name = device.options.name;
        if (acts(name))
            continue;
        const bool letters = std::ranges::all_of(
            name, [](char c) { return std::isalpha(static_cast<unsigned char>(c)); });
        const std::string near = letters ? nearest_word(name, known) : "";
        const bool taken = std::ranges::any_of(
            devices, [&](const ListedDevice& other) { return other.options.name == near; });
        if (!near.empty() && !taken)
            tell.of(device.key)(
                device.line, "nothing acts on a device called {}; did you mean '{}'?", name, near);
        else if (device.has_buttons && !hand)
            tell.of(device.key)(
                device.line,
                "nothing acts on a device called {}: the hand with the buttons is called wand",
                name);
    }
}

/// The left hand without a right one.
void hands_without_wand(const CheckedRoom& room, const Tell& tell) {
    const auto devices = listed(room);
    const auto named = [&](const char* name) {
        return std::ranges::find_if(devices, [&](const ListedDevice& each) {
            return each.options.name == name && each.options.has_pose;
        });
    };
    if (const auto other = named("wand2"); other != devices.end() && named("wand") == devices.end())
        tell.of(other->key)(other->line, "wand2 is the other hand, and none is called wand");
}

void eyes_on_hands(const CheckedRoom& room, const Tell& tell) {
    for (const stereo::Viewer& viewer : room.installation().viewers)
        if (viewer.head == "wand" || viewer.head == "wand2")
            tell(viewer.line.number, "the eyes of {} follow {}, a hand", viewer.name, viewer.head);
}

/// `source = "/isochron/wand"` where `wand` is meant, or a prefix with the name of a device.
void osc_names(const CheckedRoom& room, const Tell& tell) {
    for (const interaction::OscOptions& tracker : room.config().devices.osc)
        for (const interaction::OscDevice& each : tracker.devices) {
            const char* why = each.source.starts_with('/') ? "a name has no slash"
                              : tracker.prefix.ends_with("/" + each.source)
                                  ? "the prefix stands before the device's name"
                                  : nullptr;
            if (why)
                tell(tracker.line, "'{}': poses would come to {}/{}/pose: {}", each.source,
                     tracker.prefix, each.source, why);
        }
}

void sources_read_twice(const CheckedRoom& room, const Tell& tell) {
    std::map<std::string, std::string> first;
    for (const ListedDevice& device : listed(room)) {
        if (device.source.empty())
            continue;
        const auto [known, is_new] = first.emplace(device.source, device.options.name);
        if (!is_new)
            tell.of(device.key)(device.line, "{} and {} are both {}", known->second,
                                device.options.name, device.source);
    }
}

/// Two trackers that both give a device its pose: only the first one counts.
void poses_given_twice(const CheckedRoom& room, const Tell& tell) {
    const auto devices = listed(room);
    for (std::size_t i = 0; i < devices.size(); ++i)
        for (std::size_t j = 0; j < i; ++j)
            if (const auto &a = devices[j], &b = devices[i];
                a.options.name == b.options.name && a.options.has_pose && b.options.has_pose)
                tell.of(b.key)(b.line, "{} has its pose from the tracker of line {} already{}",
                               b.options.name, a.line,
                               b.key == "osc" ? ": pose = false for a box of buttons" : "");
    if (room.config().openxr.enabled)
        for (const ListedDevice& device : devices)
            if (device.options.name == "head" && device.options.has_pose)
                tell.of(device.key)(device.line, "a headset tracks head, too: openxr.enabled");
}

/// Calls `visit(endpoint, key, tracker)` for each tracker that listens on a port.
template <class Visit>
void each_listener(const CheckedRoom& room, Visit&& visit) {
    each_tracker(room.config().devices, [&](const char* key, const auto& tracker) {
        if constexpr (requires { tracker.endpoint; })
            visit(tracker.endpoint, std::string(key), tracker);
    });
}

/// Whether one of two addresses also receives what is sent to the other.
bool overlap(const interaction::Endpoint& a, const interaction::Endpoint& b) {
    const auto any = [](const std::string& address) {
        return address == "0.0.0.0" || address == "::";
    };
    return a.port == b.port && (a.address == b.address || any(a.address) || any(b.address));
}

void ports_taken_twice(const CheckedRoom& room, const Tell& tell) {
    struct Listener {
        interaction::Endpoint endpoint;
        std::string key;
        int line;
    };
    std::vector<Listener> before;
    each_listener(room, [&](const interaction::Endpoint& endpoint, const std::string& key,
                            const auto& tracker) {
        for (const Listener& other : before)
            if (overlap(endpoint, other.endpoint))
                tell.of(key)(tracker.line, "{} is the {} tracker's of line {} already",
                             to_string(endpoint), other.key, other.line);
        before.push_back({endpoint, key, tracker.line});
    });
}

void unlikely_ports(const CheckedRoom& room, const Tell& tell) {
    constexpr int kFirstFree = 1024, kVrpn = 3883;
    constexpr int kOfDTrack[]{50105, 50110}; // on which the controller takes commands
    each_listener(room, [&](const interaction::Endpoint& endpoint, const std::string& key,
                            const auto& tracker) {
        const int port = endpoint.port;
        const char* why = port < kFirstFree ? "only the administrator may listen there"
                          : port == kVrpn   ? "it is VRPN's"
                          : std::ranges::count(kOfDTrack, port) > 0
                              ? "DTrack takes commands there; data go to the port of its output "
                                "settings"
                              : nullptr;
        if (why)
            tell.of(key)(tracker.line, "{}: {}", port, why);
    });
}

bool is_this_machine(const std::string& address) {
    return address.starts_with("127.") || address == "::1";
}

/// Whether an address is that of a group of machines, of a whole network, or of any machine.
bool is_of_many(const std::string& address) {
    const int first = std::atoi(address.c_str());
    return address.find('.') != address.npos &&
           ((first >= 224 && first < 240) || address.ends_with(".255") || address == "0.0.0.0");
}

/// Addresses at which nothing arrives.
void unlikely_addresses(const CheckedRoom& room, const Tell& tell) {
    each_listener(room, [&](const interaction::Endpoint& endpoint, const std::string& key,
                            const auto& tracker) {
        const std::string& own = endpoint.address;
        std::string why;
        if (is_of_many(own) && own != "0.0.0.0")
            why = "is an address of many machines; expected this machine's";
        if constexpr (requires { tracker.from; })
            if (tracker.from && !is_this_machine(tracker.from->address)) {
                if (is_of_many(tracker.from->address))
                    why = fmt::format("would hear {} alone, which is no sender: from is the "
                                      "tracker's own address",
                                      tracker.from->address);
                else if (is_this_machine(own))
                    why = fmt::format("hears this machine alone, and from is {}",
                                      tracker.from->address);
                else if (own == tracker.from->address)
                    why = "is from, the sender: address is this machine's";
            }
        if (!why.empty())
            tell.of(key)(tracker.line, "{} {}", own, why);
    });
}

void trackers_not_built_in(const CheckedRoom& room, const Tell& tell) {
    for (const ConfigProblem& missing : missing_trackers(room.config()))
        tell.of(missing.key)(missing.line, "{}", missing.text);
}

/// Whether a rotation turns by amounts that are round in radians when they are read as degrees.
bool looks_like_radians(const glm::quat& rotation) {
    const glm::quat q = rotation.w < 0 ? -rotation : rotation;
    const glm::vec3 axis(q.x, q.y, q.z);
    const float sine = glm::length(axis);
    if (sine <= 0)
        return false;
    // Rotations as small as these add up axis by axis.
    const glm::vec3 degrees = axis * (glm::degrees(2 * std::atan2(sine, q.w)) / sine);
    constexpr float kRound = glm::quarter_pi<float>(), kNear = 0.02f, kFull = 6.4f;
    bool turns = false;
    for (int i = 0; i < 3; ++i) {
        const float turn = std::abs(degrees[i]);
        const float whole = kRound * std::round(turn / kRound);
        if (turn > kFull || std::abs(turn - whole) > kNear)
            return false;
        turns |= whole > 0;
    }
    return turns;
}

/// DTrack sends millimeters, which are read as such; other sources say nothing of their unit.
void scales(const CheckedRoom& room, const Tell& tell) {
    each_tracker(room.config().devices, [&]<class T>(const char* key, const T& tracker) {
        constexpr bool kKnown = std::same_as<T, interaction::DTrackOptions>;
        const double scale = tracker.common.calibration.scale;
        if (scale < (kKnown ? 0.5 : 0.9e-3) || scale > 2)
            tell.of(key)(tracker.line,
                         "{:.4g}: meters for each meter that the tracker reports, expected 1{}",
                         scale,
                         kKnown ? ", as DTrack's millimeters are read as such"
                                : ", or 0.001 where it takes millimeters for meters");
    });
}

void places_of_trackers(const CheckedRoom& room, const Tell& tell) {
    constexpr float kBeside = 5;    // [m] from walls and viewers
    constexpr float kUnder = 0.75f; // [m]
    std::vector<const Wall*> walls;
    for (const Wall& wall : room.walls())
        walls.push_back(&wall);
    const glm::vec3 eyes = room.installation().viewers.front().position;
    Box box{glm::min(eyes, glm::vec3(0)), glm::max(eyes, glm::vec3(0))};
    if (!walls.empty())
        box = {glm::min(box.low, CheckedRoom::box_of(walls).low),
               glm::max(box.high, CheckedRoom::box_of(walls).high)};
    each_tracker(room.config().devices, [&](const char* key, const auto& tracker) {
        const glm::vec3 at = tracker.common.calibration.room_from_tracker.position;
        const float away = glm::distance(at, glm::clamp(at, box.low, box.high));
        const float under = floor_level(walls) - at.y;
        if (away > kBeside)
            tell.of(key)(
                tracker.line,
                "the tracker's origin is {:.4g} m from walls and viewer: meters in the room{}",
                away, other_unit(glm::length(at), 0.3f, 5));
        else if (under > kUnder)
            tell.of(key)(tracker.line,
                         "the tracker's origin is {:.4g} m under the floor: y points up", under);
    });
}

void orientations_of_trackers(const CheckedRoom& room, const Tell& tell) {
    each_tracker(room.config().devices, [&](const char* key, const auto& tracker) {
        if (looks_like_radians(tracker.common.calibration.room_from_tracker.orientation))
            tell.of(key)(tracker.line, "its angles are round in radians, and are read as degrees");
    });
}

/// DTrack's frame is calibrated with y or z up.
void tilted_trackers(const CheckedRoom& room, const Tell& tell) {
    constexpr float kLevel = 0.9945f; // cosine of 6 degrees
    for (const interaction::DTrackOptions& tracker : room.config().devices.dtrack) {
        const glm::quat turn = tracker.common.calibration.room_from_tracker.orientation;
        const glm::vec3 up = glm::inverse(turn) * glm::vec3(0, 1, 0); // in the tracker's axes
        if (std::max(up.y, up.z) < kLevel && !looks_like_radians(turn))
            tell.of("dtrack")(
                tracker.line,
                "the room's up is ({:.2f} {:.2f} {:.2f}) in the tracker's axes, expected +Y, or +Z "
                "as with [0, -90, 0]: heading, pitch, roll in degrees",
                up.x + 0.0f, up.y + 0.0f, up.z + 0.0f);
    }
}

void offsets(const CheckedRoom& room, const Tell& tell) {
    constexpr float kOnHead = 0.35f, kInHand = 0.6f, kElsewhere = 1.5f; // [m] from a sensor
    for (const ListedDevice& device : listed(room)) {
        const std::string& name = device.options.name;
        const float arm = glm::length(device.options.calibration.sensor_from_thing.position);
        const bool head = is_head(room, name);
        const float most = head ? kOnHead : name.starts_with("wand") ? kInHand : kElsewhere;
        if (arm > most)
            tell.of(device.key)(device.line,
                                "{}: {:.4g} m from its sensor{}: offsets are in meters", name, arm,
                                head ? " to between the eyes" : "");
    }
}

void rotations(const CheckedRoom& room, const Tell& tell) {
    for (const ListedDevice& device : listed(room))
        if (looks_like_radians(device.options.calibration.sensor_from_thing.orientation))
            tell.of(device.key)(device.line,
                                "{}: its angles are round in radians, and are read as degrees",
                                device.options.name);
}

/// A marker has no orientation: the eyes would not turn with the head.
void markers_as_heads(const CheckedRoom& room, const Tell& tell) {
    const auto& walls = room.walls();
    const bool around = std::ranges::any_of(walls, [&](const Wall& wall) {
        return glm::dot(wall.normal, walls.front().normal) < 0.3f;
    });
    for (const interaction::DTrackOptions& tracker : room.config().devices.dtrack)
        for (const interaction::DTrackDevice& each : tracker.devices)
            if (each.kind == DTrackKind::marker && is_head(room, each.device.name) && around)
                tell.of("dtrack")(tracker.line,
                                  "{}: a marker has no orientation, so the eyes do not turn to the "
                                  "walls at the side: expected a body",
                                  each.device.name);
}

/// A ray cannot be pointed by a marker, and a flystick is no thing to wear.
void kinds_of_devices(const CheckedRoom& room, const Tell& tell) {
    for (const interaction::DTrackOptions& tracker : room.config().devices.dtrack)
        for (const interaction::DTrackDevice& each : tracker.devices) {
            const std::string& name = each.device.name;
            const char* why = each.kind == DTrackKind::flystick && is_head(room, name)
                                  ? "a flystick is held in a hand, heads are bodies: are the two "
                                    "exchanged?"
                              : each.kind == DTrackKind::marker && name.starts_with("wand")
                                  ? "a marker has no orientation, so that nothing can be pointed "
                                    "at: expected a flystick or a body"
                                  : nullptr;
            if (why)
                tell.of("dtrack")(tracker.line, "{}: {}", name, why);
        }
}

/// DTrack's own pages count from 1, its datagrams from 0.
void numbers_from_one(const CheckedRoom& room, const Tell& tell) {
    for (const interaction::DTrackOptions& tracker : room.config().devices.dtrack) {
        std::map<DTrackKind, int> least;
        for (const interaction::DTrackDevice& each : tracker.devices)
            if (each.kind != DTrackKind::marker) {
                const auto known = least.emplace(each.kind, each.id).first;
                known->second = std::min(known->second, each.id);
            }
        if (least.size() > 1 &&
            std::ranges::all_of(least, [](const auto& kind) { return kind.second == 1; }))
            tell.of("dtrack")(tracker.line, "the first body and the first flystick are number 1: "
                                            "DTrack's datagrams count both from 0");
    }
}

/// Buttons of one box for two hands: each press is one of both.
void shared_buttons(const CheckedRoom& room, const Tell& tell) {
    for (const interaction::VrpnOptions& tracker : room.config().devices.vrpn)
        for (std::size_t i = 0; i < tracker.devices.size(); ++i)
            for (std::size_t j = 0; j < i; ++j)
                if (const auto &a = tracker.devices[j], &b = tracker.devices[i];
                    !b.buttons.empty() && a.buttons == b.buttons &&
                    a.device.buttons == b.device.buttons && a.device.name != b.device.name)
                    tell.of("vrpn")(tracker.line,
                                    "{} and {} both have the buttons of {}: buttons = [...] says "
                                    "which are whose",
                                    a.device.name, b.device.name, b.buttons);
}

/// Text that says which number a list has twice; empty: none.
template <class T>
std::string twice(const std::vector<T>& numbers) {
    std::set<T> before;
    for (const T number : numbers)
        if (!before.insert(number).second)
            return fmt::format("{} is in it twice", number);
    return {};
}

void button_lists(const CheckedRoom& room, const Tell& tell) {
    constexpr std::uint32_t kMost = 15; // buttons of a Flystick, with room for those to come
    each_tracker(room.config().devices, [&](const char* key, const auto& tracker) {
        for (const auto& each : tracker.devices) {
            const auto& buttons = each.device.buttons;
            std::string why = twice(buttons);
            bool powers = buttons.size() >= 4;
            for (std::size_t i = 0; i < buttons.size(); ++i)
                powers = powers && buttons[i] == 1u << std::min<std::size_t>(i, 31);
            bool from_one = buttons.size() >= 3;
            for (std::size_t i = 0; i < buttons.size(); ++i)
                from_one = from_one && buttons[i] == i + 1;
            if (powers)
                why = "buttons have numbers from 0, no bits";
            if constexpr (requires { each.kind; }) {
                if (!buttons.empty() && each.kind != DTrackKind::flystick)
                    why = fmt::format("a {} has no buttons, a flystick has", name_of(each.kind));
                else if (from_one)
                    why = "a Flystick's buttons are counted from 0, which is the trigger";
                else if (!buttons.empty() && std::ranges::max(buttons) > kMost)
                    why = fmt::format("{} is no button of a Flystick, they are counted from 0",
                                      std::ranges::max(buttons));
            } else if constexpr (requires { each.tracker; }) {
                if (!buttons.empty() && each.buttons.empty())
                    why = "without button = NAME@HOST there are none";
            }
            if (!why.empty())
                tell.of(key)(tracker.line, "{}: [{}]: {}", each.device.name,
                             fmt::join(buttons, ", "), why);
        }
    });
}

void valuator_lists(const CheckedRoom& room, const Tell& tell) {
    each_tracker(room.config().devices, [&](const char* key, const auto& tracker) {
        for (const auto& each : tracker.devices) {
            const auto& valuators = each.device.valuators;
            std::string why = twice(valuators);
            if constexpr (requires { each.kind; }) {
                if (!valuators.empty() && each.kind != DTrackKind::flystick)
                    why = fmt::format("a {} has no valuators, a flystick has", name_of(each.kind));
                else if (!valuators.empty() && std::ranges::max(valuators) > 7)
                    why = fmt::format("{} is no valuator of a Flystick, they are counted from 0",
                                      std::ranges::max(valuators));
            } else if constexpr (requires { each.tracker; }) {
                if (!valuators.empty() && each.analog.empty())
                    why = "without analog = NAME@HOST there are none";
            }
            if (!why.empty())
                tell.of(key)(tracker.line, "{}: [{}]: {}", each.device.name,
                             fmt::join(valuators, ", "), why);
        }
    });
}

void valuator_factors(const CheckedRoom& room, const Tell& tell) {
    constexpr float kLeast = 0.05f, kMost = 20;
    for (const ListedDevice& device : listed(room))
        for (const float factor : device.options.valuator_factors)
            if (std::abs(factor) < kLeast || std::abs(factor) > kMost)
                tell.of(device.key)(
                    device.line, "{}: {:g} {}; 1 leaves a valuator as it is, from -1 to 1",
                    device.options.name, factor,
                    factor == 0                 ? "makes a valuator stand still"
                    : std::abs(factor) < kLeast ? "hardly moves it"
                                                : "moves it at the slightest touch");
}

void limits_of_prediction(const CheckedRoom& room, const Tell& tell) {
    for (const ListedDevice& device : listed(room)) {
        const interaction::PredictionOptions& prediction = device.options.prediction;
        const interaction::Seconds wanted = prediction.display_delay + device.options.latency;
        if (prediction.on && device.options.has_pose && wanted > 2 * prediction.limit)
            tell.of(device.key)(
                device.line,
                "{}: {:.4g} ms are to be predicted, of which the limit lets through {:.4g} ms",
                device.options.name, 1e3 * wanted.count(), 1e3 * prediction.limit.count());
    }
}

/// `Tracker0@host`, not `host@Tracker0`, and not the buttons' name for the tracker's.
void names_of_vrpn(const CheckedRoom& room, const Tell& tell) {
    for (const interaction::VrpnOptions& tracker : room.config().devices.vrpn)
        for (const interaction::VrpnDevice& each : tracker.devices)
            for (const auto& [name, kind] :
                 {std::pair(each.tracker, "Tracker"), std::pair(each.buttons, "Button"),
                  std::pair(each.analog, "Analog")}) {
                const std::size_t at = std::min(name.find('@'), name.size());
                const auto of_kind = [&](const char* word) { return name.starts_with(word); };
                if (!of_kind(kind) && (of_kind("Tracker") || of_kind("Button")))
                    tell.of("vrpn")(tracker.line, "{}: '{}' is named as {}", each.device.name, name,
                                    of_kind("Tracker") ? "a tracker is" : "buttons are");
                else if (!name.empty() && (at == 0 || at + 1 >= name.size() ||
                                           interaction::is_address(name.substr(0, at))))
                    tell.of("vrpn")(tracker.line, "{}: '{}': expected NAME@HOST", each.device.name,
                                    name);
            }
}

constexpr Check kOfDevices[]{
    {"viewers.head", Check::wrong, heads_without_tracker},
    {"*.devices", Check::odd, sources_read_twice},
    {"*.port", Check::wrong, ports_taken_twice},
    {"*", Check::wrong, trackers_not_built_in},
    {"*.devices.name", Check::odd, trackers_without_head},
    {"*.devices.name", Check::odd, names_without_effect},
    {"*.devices.name", Check::odd, hands_without_wand},
    {"viewers.head", Check::odd, eyes_on_hands},
    {"osc.devices.source", Check::odd, osc_names},
    {"*.devices.name", Check::odd, poses_given_twice},
    {"*.port", Check::odd, unlikely_ports},
    {"*.address", Check::odd, unlikely_addresses},
    {"*.scale", Check::odd, scales},
    {"*.position", Check::odd, places_of_trackers},
    {"*.orientation", Check::odd, orientations_of_trackers},
    {"*.orientation", Check::odd, tilted_trackers},
    {"*.devices.offset", Check::odd, offsets},
    {"*.devices.rotation", Check::odd, rotations},
    {"*.devices.marker", Check::odd, markers_as_heads},
    {"*.devices", Check::odd, kinds_of_devices},
    {"*.devices", Check::odd, numbers_from_one},
    {"*.devices.button", Check::odd, shared_buttons},
    {"*.devices.buttons", Check::odd, button_lists},
    {"*.devices.valuators", Check::odd, valuator_lists},
    {"*.devices.valuator_factors", Check::odd, valuator_factors},
    {"*.prediction_limit_ms", Check::odd, limits_of_prediction},
    {"*.devices.tracker", Check::odd, names_of_vrpn},
};

} // namespace

std::span<const Check> checks_of_devices() {
    return kOfDevices;
}

} // namespace isochron::app
