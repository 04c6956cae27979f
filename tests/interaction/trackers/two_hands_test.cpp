// Two hands that move at once, and a tracker that has been sending for a while: poses are those
// sent, for the time of their measurement.
#include "interaction/trackers/dtrack_input.h"

#include "tests/interaction/controls/control_desk.h"
#include "tests/support/tracker_packets.h"

#include <gmock/gmock.h>

#include <cmath>

namespace isochron::interaction {
namespace {

using test_support::dtrack_datagram;
using test_support::PlayedFlystick;
using test_support::UdpSender;

constexpr double kRadius = 0.25, kTurns = 6.0; ///< [m], [rad/s] of a hand that draws circles

/// Where a hand is at a time [s]; the hands move against each other.
glm::dvec3 hand_at(int hand, double time) {
    const double angle = kTurns * time * (hand == 0 ? 1 : -1);
    return {(hand == 0 ? 0.3 : -0.3) + kRadius * std::cos(angle), 1.2 + kRadius * std::sin(angle),
            -0.4 + 0.1 * std::sin(2 * angle)};
}

DTrackOptions two_hands(bool predicted) {
    DTrackOptions options;
    options.endpoint = {"127.0.0.1", 0};
    options.ages = DatagramAges::none; // the looks have a clock of their own
    for (int hand = 0; hand < 2; ++hand) {
        DTrackDevice flystick;
        flystick.kind = DTrackKind::flystick;
        flystick.id = hand;
        flystick.device.name = hand == 0 ? "wand" : "wand2";
        flystick.device.prediction.on = predicted;
        options.devices.push_back(flystick);
    }
    return options;
}

std::string both_hands(std::uint32_t frame, double time) {
    return dtrack_datagram(frame, 100 + time, {},
                           {PlayedFlystick{{0, hand_at(0, time)}, 0, {}},
                            PlayedFlystick{{1, hand_at(1, time)}, 0, {}}});
}

/// Sends at 150 Hz and looks at 60 Hz. @return the farthest that a hand is stated from where it is
/// when it was measured, or, if it is predicted, when the picture is seen [m]
double farthest(bool predicted) {
    DTrackInput input(two_hands(predicted));
    const UdpSender sender(input.endpoint());
    double most = 0;
    std::uint32_t frame = 0;
    for (int look = 1; look <= 300; ++look) {
        const double now = look / 60.0;
        for (; frame / 150.0 <= now; ++frame)
            EXPECT_TRUE(sender.send(both_hands(frame, frame / 150.0)));
        const InputState state = input.poll(Seconds(now));
        for (int hand = 0; hand < 2; ++hand) {
            const DeviceState* device = state.find(hand == 0 ? "wand" : "wand2");
            if (!device || !device->pose) {
                ADD_FAILURE() << "no hand " << hand;
                return 0;
            }
            // By the device's own clock, which no network delays.
            const double sent = device->device_time->count() - 100;
            const double age = now - device->measured->count();
            const PredictionOptions prediction;
            const double seen = predicted ? sent + std::min(age + prediction.display_delay.count(),
                                                            prediction.limit.count())
                                          : sent;
            if (look > 30) // a velocity takes a few samples
                most = std::max(
                    most, glm::distance(glm::dvec3(device->pose->position), hand_at(hand, seen)));
        }
    }
    return most;
}

TEST(TwoHands, AreStatedAsSentWithoutPrediction) {
    EXPECT_LT(farthest(false), 2e-6) << "DTrack sends thousandths of a millimeter";
}

/// The velocity is that of the last 50 ms, so a hand in a curve is stated on its tangent: off by
/// the acceleration times the way ahead times half of both times.
TEST(TwoHands, ArePredictedAsFarAsTheirCurveAllows) {
    const PredictionOptions prediction;
    const double acceleration = kRadius * kTurns * kTurns + 0.1 * 4 * kTurns * kTurns;
    const double ahead = prediction.display_delay.count() + 1 / 60.0;
    const double off = farthest(true);
    EXPECT_LT(off, acceleration * ahead * (ahead + prediction.smoothing.count()) / 2);
    EXPECT_GT(off, 1e-4) << "what is predicted is not what was sent";
}

/// A second of poses waits when the session begins; the tracker has moved since.
TEST(TwoHands, WhatWasQueuedBeforeTheStartDoesNotMakeGoodPosesJumps) {
    DTrackInput input(two_hands(false));
    const UdpSender sender(input.endpoint());
    const auto at = [](std::uint32_t frame, double x) {
        return dtrack_datagram(frame, frame / 60.0, {}, {PlayedFlystick{{0, {x, 1.2, 0}}, 0, {}}});
    };
    for (std::uint32_t frame = 0; frame < 60; ++frame)
        ASSERT_TRUE(sender.send(at(frame, 0.0)));
    input.begin();
    for (std::uint32_t frame = 60; frame < 90; ++frame) {
        ASSERT_TRUE(sender.send(at(frame, 2.0)));
        const InputState state = input.poll(Seconds((frame - 60) / 60.0));
        ASSERT_TRUE(state.find("wand")->pose);
        expect_near(state.find("wand")->pose->position, {2.0, 1.2, 0}, 1e-6);
    }
    EXPECT_THAT(input.status()[1],
                testing::HasSubstr("30 poses, 0 refused as none, 0 late, 0 jum"));
}

} // namespace
} // namespace isochron::interaction
