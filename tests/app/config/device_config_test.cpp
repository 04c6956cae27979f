// Trackers in configuration files: all settings are read, and errors are reported.
#include "app/config/tracker_setup.h"
#include "app/frame/device_tracking.h"
#include "interaction/recording/recording.h"
#include "tests/app/config/config_error.h"

#include <fmt/format.h>
#include <glm/trigonometric.hpp>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace isochron::app {
namespace {

using namespace interaction;
using testing::HasSubstr;

constexpr const char* kCave = R"(
[tracking]
held_after_ms = 80
prediction = false

[dtrack]
address = "::1"
port = 5001
position = [0, 0.1, 2]
orientation = [0, -90, 0]
scale = 1.001
latency_ms = 8

[[dtrack.devices]]
name = "head"
body = 3
offset = [0, -0.03, 0.08]
rotation = [0, 90, 0]
prediction = true
fastest = 3

[[dtrack.devices]]
name = "wand"
flystick = 0
buttons = [0, 4]
valuators = [1, 0]
valuator_factors = [1, -1]

[[osc]]
prefix = ""
[[osc.devices]]
name = "box"
source = "tablet"
pose = false

[[osc]]
port = 9001
[[osc.devices]]
name = "wand"

[vrpn]
[[vrpn.devices]]
name = "left"
tracker = "Tracker0@localhost"
sensor = 2
button = "Button0@localhost"

[gamepad]
enabled = false
dead_zone = 0.25

[comfort]
grid = true
fade_when_lost = false
vignette_turn = 90
vignette_fade_ms = 250
)";

TEST(DeviceConfig, EveryValueArrives) {
    const Config config = parse_config(kCave, "cave.toml");
    ASSERT_EQ(config.devices.dtrack.size(), 1u);
    const DTrackOptions& dtrack = config.devices.dtrack[0];
    EXPECT_EQ(dtrack.endpoint, (Endpoint{"::1", 5001}));
    ASSERT_EQ(dtrack.devices.size(), 2u);
    const DTrackDevice& head = dtrack.devices[0];
    EXPECT_EQ(head.kind, DTrackKind::body);
    EXPECT_EQ(head.id, 3);
    EXPECT_EQ(head.device.name, "head");
    EXPECT_EQ(head.device.latency, Seconds(0.008));
    EXPECT_EQ(head.device.limits.held_after, Seconds(0.08));
    EXPECT_EQ(head.device.limits.fastest, 3);
    EXPECT_TRUE(head.device.prediction.on);
    const Calibration& calibration = head.device.calibration;
    EXPECT_EQ(calibration.room_from_tracker.position, glm::vec3(0, 0.1f, 2));
    EXPECT_EQ(calibration.room_from_tracker.orientation,
              rotation_from_angles(glm::radians(glm::vec3(0, -90, 0))));
    EXPECT_EQ(calibration.scale, 1.001);
    EXPECT_EQ(calibration.sensor_from_thing.position, glm::vec3(0, -0.03f, 0.08f));
    const DTrackDevice& wand = dtrack.devices[1];
    EXPECT_EQ(wand.kind, DTrackKind::flystick);
    EXPECT_FALSE(wand.device.prediction.on);
    EXPECT_EQ(wand.device.buttons, (std::vector<std::uint32_t>{0, 4}));
    EXPECT_EQ(wand.device.valuators, (std::vector<std::uint32_t>{1, 0}));
    EXPECT_EQ(wand.device.valuator_factors, (std::vector{1.0f, -1.0f}));
    EXPECT_EQ(wand.device.calibration.sensor_from_thing, Pose{}) << "the head's is its own";

    ASSERT_EQ(config.devices.osc.size(), 2u);
    EXPECT_EQ(config.devices.osc[0].prefix, "");
    EXPECT_EQ(config.devices.osc[0].devices[0].source, "tablet");
    EXPECT_FALSE(config.devices.osc[0].devices[0].device.has_pose);
    EXPECT_EQ(config.devices.osc[1].endpoint, (Endpoint{"127.0.0.1", 9001}));
    EXPECT_EQ(config.devices.osc[1].devices[0].source, "wand");
    ASSERT_EQ(config.devices.vrpn.size(), 1u);
    EXPECT_EQ(config.devices.vrpn[0].devices[0].sensor, 2);
    EXPECT_EQ(config.devices.vrpn[0].devices[0].buttons, "Button0@localhost");
    EXPECT_FALSE(config.emulation.gamepad);
    EXPECT_FLOAT_EQ(config.emulation.dead_zone, 0.25f);
    EXPECT_TRUE(config.start.grid);
    EXPECT_FALSE(config.comfort.fade_when_lost);
    EXPECT_NEAR(config.comfort.vignette_turn, 1.5707963, 1e-6);
    EXPECT_EQ(config.comfort.vignette_fade, Seconds(0.25));
}

TEST(DeviceConfig, WhatIsWrongIsNamedWithItsPlace) {
    const std::string dtrack = "[dtrack]\n";
    const std::string head = "[[dtrack.devices]]\nname = \"head\"\n";
    const std::string body = head + "body = 0\n";
    const auto expect = [](const std::string& text, const char* complaint) {
        EXPECT_THAT(error_of(text), HasSubstr(complaint)) << text;
    };
    expect(dtrack, "lab.toml:1: dtrack.devices: missing, a tracker without devices");
    expect(dtrack + head, "dtrack.devices.body: expected one of body, flystick and marker");
    expect(dtrack + body + "flystick = 0\n", "expected one of body, flystick and marker");
    expect(dtrack + "[[dtrack.devices]]\nbody = 0\n", "devices.name: a device needs a name");
    expect(dtrack + body + body, "lab.toml:6: dtrack.devices.name: two devices are called 'head'");
    expect(dtrack + body + "offest = [0, 0, 0]\n", "lab.toml:5: unknown key 'offest'");
    expect(dtrack + body + "buttons = [0.5]\n", "buttons: expected whole numbers, got 0.5");
    expect(dtrack + body + "buttons = [64]\n", "expected a number from 0 to 63, got 64");
    expect(dtrack + body + "valuator_factors = [1]\n", "expected one for each of 0 valuators");
    expect(dtrack + body + "held_after_ms = 2000\n", "expected 0 < held_after_ms <= lost_after_ms");
    expect("[dtrack]\nport = 70000\n" + body, "lab.toml:2: dtrack.port");
    expect("[dtrack]\naddress = \"tracker.lab\"\n" + body, "expected a numeric IPv4 or IPv6");
    expect("[dtrack]\nfrom = \"tracker.lab\"\n" + body,
           "lab.toml:2: dtrack.from: expected a numeric address such as 192.168.0.10 or "
           "192.168.0.10:5000, got 'tracker.lab'");
    expect("[dtrack]\nposition = [0, 2000, 0]\n" + body, "expected meters in the room, got 2000 m");
    expect("[dtrack]\nscale = 0\n" + body, "lab.toml:2: dtrack.scale");
    expect("[osc]\nprefix = \"isochron\"\n[[osc.devices]]\nname = \"head\"\n",
           "osc.prefix: expected");
    expect("[vrpn]\n[[vrpn.devices]]\nname = \"head\"\n", "expected tracker, button or analog");
    expect("[vrpn]\n[[vrpn.devices]]\nname = \"a\"\ntracker = \"b\"\n", "expected NAME@HOST");
    expect("[tracking]\nfastest = -1\n", "lab.toml:2: tracking.fastest");
    expect("[gamepad]\ndead_zone = 1\n", "lab.toml:2: gamepad.dead_zone");
    expect("[dtracks]\n", "unknown key 'dtracks'; did you mean 'dtrack'?");
}

TEST(DeviceConfig, EveryDeviceIsDescribed) {
    const Config config = parse_config(kCave, "cave.toml");
    const auto lines = describe_devices(config);
    for (const char* line :
         {"dtrack: UDP [::1]:5001", "  head: body 3", "  wand: Flystick 0",
          "osc: UDP 127.0.0.1:9000", "  box: /tablet/...", "  wand: /isochron/wand/...",
          "  left: sensor 2 of Tracker0@localhost, buttons of Button0@localhost",
          "  in the room at 0.000 0.100 2.000 m, -Z to 0.00 -1.00 0.00, +Y to 0.00 0.00 -1.00, "
          "scaled "
          "by 1.001",
          "    head in its sensor at 0.000 -0.030 0.080 m, -Z to 0.00 1.00 0.00, +Y to 0.00 0.00 "
          "1.00",
          "    held after 80 ms, lost after 1000 ms, jumps beyond 3 m/s accepted after 300 ms, "
          "predicted by 33 ms, at most 50 ms"})
        EXPECT_THAT(lines, testing::Contains(line));
    EXPECT_THAT(describe_devices(parse_config("", "desk.toml")),
                testing::ElementsAre("mouse and keyboard: head, wand, mouse, keys, gamepad while "
                                     "there is one"));
}

TEST(DeviceConfig, APortThatIsTakenIsNamed) {
    UdpSocket taken({"127.0.0.1", 0});
    const Config config =
        parse_config(fmt::format("version = 1\n[dtrack]\nport = {}\n[[dtrack.devices]]\nname = "
                                 "\"head\"\nbody = 0\n",
                                 taken.endpoint().port),
                     "lab.toml");
    CompositeInput input;
    try {
        open_trackers(config, input);
        ADD_FAILURE();
    } catch (const Error& error) {
        EXPECT_EQ(error.what(), "lab.toml:2: dtrack: udp " + to_string(taken.endpoint()) +
                                    ": Address already in use");
    }
}

TEST(DeviceTracking, IsToldInWords) {
    InputState input{Seconds(10), {{"keys", std::nullopt, true, 0, {}}}};
    DeviceState device{"head", Pose{}, true, 0, {}};
    device.measured = Seconds(9.996);
    input.devices.push_back(device);
    device.pose_valid = false;
    device.measured = Seconds(9.7);
    input.devices.push_back(device);
    device.pose_lost = true;
    device.measured = Seconds(1);
    input.devices.push_back(device);
    device.measured.reset();
    input.devices.push_back(device);
    std::vector<std::string> lines;
    for (const DeviceTracking& each : tracking_of(input))
        lines.push_back(in_words(each));
    EXPECT_THAT(lines, testing::ElementsAre("head: tracked, 4 ms old", "head: held for 0.3 s",
                                            "head: lost for 9.0 s", "head: not seen yet"));
}

TEST(PanelConfig, HoldsTheRoomsPanelAndTheConsole) {
    const Config plain = parse_config("", "lab.toml");
    EXPECT_FALSE(plain.start.room_panel.shown);
    EXPECT_FALSE(plain.panel.console);
    const Config config = parse_config("[panel]\nroom = true\nwidth = 0.6\ndistance = 0.7\n"
                                       "[console]\nsize = [500, 700]\nposition = [10, 20]\n",
                                       "lab.toml");
    EXPECT_TRUE(config.start.room_panel.shown);
    EXPECT_EQ(config.panel.width, 0.6f);
    EXPECT_EQ(config.panel.distance, 0.7f);
    ASSERT_TRUE(config.panel.console);
    EXPECT_EQ(config.panel.console->size, glm::ivec2(500, 700));
    EXPECT_EQ(config.panel.console->position, glm::ivec2(10, 20));
    EXPECT_TRUE(parse_config("[console]\n", "lab.toml").panel.console);
    EXPECT_THAT(error_of("[panel]\nwidth = 3\n"), HasSubstr("lab.toml:2: panel.width"));
    EXPECT_THAT(error_of("[console]\nsise = [1, 2]\n"), HasSubstr("did you mean 'size'"));
    EXPECT_THAT(error_of("[console]\nsize = [10, 700]\n"), HasSubstr("lab.toml:2: console.size"));
}

TEST(ComfortConfig, FadesNearByBetweenTwoAscendingDistances) {
    EXPECT_EQ(parse_config("", "lab.toml").comfort.near_fade, glm::vec2(0));
    const Config config = parse_config("[comfort]\nnear_fade = [0.1, 0.4]\n", "lab.toml");
    EXPECT_EQ(config.comfort.near_fade, glm::vec2(0.1f, 0.4f));
    for (const char* wrong : {"[0.4, 0.1]", "[0.2, 0.2]", "[-0.1, 0.2]", "[0.1, 11]"})
        EXPECT_THAT(error_of(std::string("[comfort]\nnear_fade = ") + wrong),
                    HasSubstr("lab.toml:2: comfort.near_fade"))
            << wrong;
}

} // namespace
} // namespace isochron::app
