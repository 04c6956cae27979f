// Plays a tracker: sends a visitor's head and wand as DTrack or Open Sound Control packets, to try
// out an installation's configuration without one.
//
//     build/release/tests/tracker_sender dtrack 127.0.0.1 5000 60
//     build/release/tests/tracker_sender osc 127.0.0.1 9000 60
#include "tests/support/tracker_packets.h"

#include <glm/gtc/quaternion.hpp>

#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <thread>

namespace {

using namespace isochron;
using namespace isochron::test_support;

constexpr int kRate = 60; ///< frames per second

/// Leaning from side to side and looking about, in the room frame.
interaction::Pose head_at(double t) {
    return {glm::vec3(0.3 * std::sin(0.9 * t), 1.7 + 0.03 * std::sin(1.7 * t), 0.0),
            glm::angleAxis(static_cast<float>(0.3 * std::sin(0.6 * t)), glm::vec3(0, 1, 0))};
}

/// A hand that draws a circle.
interaction::Pose wand_at(double t) {
    return {glm::vec3(0.3 + 0.15 * std::cos(t), 1.2 + 0.15 * std::sin(t), -0.4),
            glm::angleAxis(static_cast<float>(0.2 * std::sin(t)), glm::vec3(1, 0, 0))};
}

/// The button is down for a second in every four.
bool pressed_at(double t) {
    return std::fmod(t, 4.0) < 1.0;
}

PlayedBody body_of(const interaction::Pose& pose) {
    return {0, glm::dvec3(pose.position), glm::mat3_cast(glm::dquat(pose.orientation))};
}

std::string dtrack_frame(int frame, double t) {
    return dtrack_datagram(static_cast<std::uint32_t>(frame), t, {body_of(head_at(t))},
                           {{body_of(wand_at(t)), pressed_at(t) ? 1u : 0u, {0.0, 0.0}}});
}

std::string osc_frame(double t) {
    return osc_bundle(
        0,
        {osc_pose("/isochron/head/pose", head_at(t)), osc_pose("/isochron/wand/pose", wand_at(t)),
         osc_message("/isochron/wand/button", {{'i', 0}, {'i', pressed_at(t) ? 1.0 : 0.0}})});
}

} // namespace

int main(int argc, char** argv) {
    const std::string protocol = argc == 5 ? argv[1] : "";
    if (protocol != "dtrack" && protocol != "osc") {
        std::fprintf(stderr, "usage: tracker_sender dtrack|osc ADDRESS PORT SECONDS\n");
        return 2;
    }
    const UdpSender sender({argv[2], std::atoi(argv[3])});
    const int frames = static_cast<int>(std::atof(argv[4]) * kRate);
    const auto start = std::chrono::steady_clock::now();
    int refused = 0;
    for (int frame = 0; frame < frames; ++frame) {
        std::this_thread::sleep_until(start + frame * std::chrono::microseconds(1000000 / kRate));
        const double t = frame / static_cast<double>(kRate);
        refused += !sender.send(protocol == "dtrack" ? dtrack_frame(frame, t) : osc_frame(t));
    }
    std::printf("%d frames sent, %d refused by the network\n", frames - refused, refused);
    return 0;
}
