// Moves the head, and gives commands.
#include "tests/bench/motion/script.h"

#include <glm/gtc/quaternion.hpp>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>

namespace isochron::bench {
namespace {

constexpr double kEyes = 1.6;                               ///< [m] above the floor
constexpr double kAside = 0.03, kUp = 0.01, kTurned = 0.02; ///< [m], [m], [rad], of a swaying head
constexpr double kWayIn = 2.4;                              ///< [m]
constexpr double kSpeed = 1.0;                              ///< [rad/s], of an orbit
constexpr double kDragged = 0.12;                           ///< change of the isovalue
constexpr double kJumps = 4;                                ///< [1/s]

double wave(double hertz, double at) {
    return std::sin(2 * std::numbers::pi * hertz * at);
}

} // namespace

Motion motion_from_name(std::string_view name) {
    const auto found = std::ranges::find(kMotionNames, name);
    assert(found != kMotionNames.end());
    return static_cast<Motion>(found - kMotionNames.begin());
}

interaction::InputState MotionScript::input(double session, double at) const {
    glm::dvec3 place(0, kEyes, 0);
    glm::dquat turned(1, 0, 0, 0);
    if (motion_ == Motion::sway) {
        place += glm::dvec3(kAside * wave(0.5, at), kUp * wave(0.9, at), 0);
        turned = glm::angleAxis(kTurned * wave(0.4, at), glm::dvec3(0, 1, 0));
    } else if (motion_ == Motion::walk_in) {
        place.z -= kWayIn * 0.5 * (1 - std::cos(std::numbers::pi * at / seconds_));
    }
    interaction::InputState input;
    input.time = interaction::Seconds(session);
    interaction::DeviceState head;
    head.name = "head";
    head.pose = interaction::Pose{glm::vec3(place), glm::quat(turned)};
    input.devices.push_back(head);
    return input;
}

interaction::Commands MotionScript::commands(double at) const {
    interaction::Commands commands;
    if (motion_ == Motion::orbit) {
        interaction::Similarity turned = start_.room_from_physical;
        const glm::dvec3 fixed(interaction::matrix(turned) * glm::dvec4(center_, 1));
        const glm::dquat by = glm::angleAxis(kSpeed * at, glm::dvec3(0, 1, 0)) *
                              glm::angleAxis(0.2 * wave(0.3, at), glm::dvec3(1, 0, 0));
        turned.rotation = glm::normalize(by * turned.rotation);
        turned.translation = fixed + by * (turned.translation - fixed);
        commands.room_from_physical = turned;
    } else if (motion_ == Motion::scrub) {
        commands.isovalue = start_.isovalue() * (1 + kDragged * wave(1 / seconds_, at));
    } else if (motion_ == Motion::jump_on) {
        commands.instant = index::Instant(
            static_cast<std::uint32_t>(start_.instant.step + std::floor(kJumps * at) + 0.5) %
            static_cast<std::uint32_t>(steps_));
    }
    return commands;
}

} // namespace isochron::bench
