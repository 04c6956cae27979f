// DTrack over loopback: reading, and the effects of loss, reordering, garbage and silence.
#include "interaction/recording/recording.h"
#include "interaction/trackers/dtrack_input.h"
#include "interaction/trackers/dtrack_protocol.h"

#include "tests/interaction/controls/control_desk.h"
#include "tests/support/test_seed.h"
#include "tests/support/tracker_packets.h"

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>

namespace isochron::interaction {
namespace {

using test_support::dtrack_datagram;
using test_support::PlayedFlystick;
using test_support::UdpSender;

/// The examples of the manual, in one datagram.
constexpr std::string_view kManual =
    "fr 21753\r\n"
    "ts 39596.024831\r\n"
    "6dcal 3\r\n"
    "6d 1 [0 1.000][326.848 -187.216 109.503 -160.4704 -3.6963 -7.0913][-0.940508 -0.339238 "
    "-0.019025 0.333599 -0.932599 0.137735 -0.064467 0.123194 0.990286] \r\n"
    "6df2 1 1 [0 1.000 6 2][261.103 116.520 41.085][-0.241543 0.968868 -0.054332 -0.482366 "
    "-0.168461 -0.859619 -0.842010 -0.181427 0.508039][5 1.00 -0.25] \r\n"
    "6dmt 1 [0 1.000 0][326.848 -187.216 109.503][0.911812 -0.038421 0.408806 0.095040 0.988324 "
    "-0.119094 -0.399457 0.147444 0.904817]\r\n"
    "3d 2 [79 1.000][210.730 -90.669 -108.554] [83 1.000][61.235 -165.625 -119.404]\r\n";

TEST(DTrackProtocol, ReadsTheManualsExamples) {
    const auto frame = parse_dtrack(kManual);
    ASSERT_TRUE(frame);
    EXPECT_EQ(frame->counter, 21753u);
    EXPECT_EQ(frame->time, Seconds(39596.024831));
    EXPECT_EQ(frame->calibrated_bodies, 3);
    EXPECT_EQ(frame->malformed_lines, 0);
    ASSERT_EQ(frame->bodies.size(), 1u);
    const DTrackBody& body = frame->bodies[0];
    EXPECT_TRUE(body.tracked);
    expect_near(body.position, {0.326848, -0.187216, 0.109503});
    // The first three numbers are the first column: where the body's x axis points.
    expect_near(body.rotation * glm::dvec3(1, 0, 0), {-0.940508, -0.339238, -0.019025});
    expect_near(body.rotation * glm::dvec3(0, 0, 1), {-0.064467, 0.123194, 0.990286});
    EXPECT_TRUE(rotation_from(body.rotation));
    ASSERT_EQ(frame->flysticks.size(), 1u);
    EXPECT_EQ(frame->flysticks[0].buttons, 5u);
    EXPECT_EQ(frame->flysticks[0].controllers, (std::vector<float>{1.0f, -0.25f}));
    ASSERT_EQ(frame->markers.size(), 2u);
    EXPECT_EQ(frame->markers[1].id, 83);
    expect_near(frame->markers[1].position, {0.061235, -0.165625, -0.119404});
}

TEST(DTrackProtocol, ReadsTheOldFlystickAndHybridBodies) {
    const auto frame = parse_dtrack(
        "fr 1\n6df 1 [0 1.000 2][261.103 116.520 41.085 19.6522 -57.3530 116.5992][-0.241543 "
        "0.968868 -0.054332 -0.482366 -0.168461 -0.859619 -0.842010 -0.181427 0.508039]\n"
        "6di 2 [0 1 2.135][326.848 -187.216 109.503][-0.940508 -0.339238 -0.019025 0.333599 "
        "-0.932599 0.137735 -0.064467 0.123194 0.990286] [1 0 0.000][0.000 0.000 0.000][0 0 0 0 0 "
        "0 0 0 0]\n");
    ASSERT_TRUE(frame);
    EXPECT_EQ(frame->malformed_lines, 0);
    ASSERT_EQ(frame->flysticks.size(), 1u);
    EXPECT_EQ(frame->flysticks[0].buttons, 2u);
    ASSERT_EQ(frame->bodies.size(), 2u);
    EXPECT_TRUE(frame->bodies[0].tracked);
    EXPECT_FALSE(frame->bodies[1].tracked);
}

TEST(DTrackProtocol, MoreThan32ButtonsTakeTwoNumbers) {
    const auto frame = parse_dtrack("fr 1\n6df2 1 1 [0 -1.000 40 1][0 0 0][0 0 0 0 0 0 0 0 0][1 "
                                    "128 0.5]\n");
    ASSERT_TRUE(frame);
    ASSERT_EQ(frame->flysticks.size(), 1u);
    EXPECT_FALSE(frame->flysticks[0].body.tracked);
    EXPECT_EQ(frame->flysticks[0].buttons, 1u | std::uint64_t{128} << 32);
    EXPECT_EQ(frame->flysticks[0].controllers, std::vector<float>{0.5f});
}

TEST(DTrackProtocol, AMalformedLineIsLeftOutWholeAndTheOthersStay) {
    const std::string good = "3d 1 [1 1.0][1 2 3]\n";
    for (const char* bad : {
             "ts nan", "ts", "6dcal -1",
             "6d 1 [0 1.0][1 2 3][1 0 0 0 1 0 0 0]",                      // eight numbers
             "6d 2 [0 1.0][1 2 3][1 0 0 0 1 0 0 0 1]",                    // one of two
             "6d 1 [0 1.0][1 2 3][1 0 0 0 1 0 0 0 1] [1 1.0]",            // more than one
             "6d 1 [0 1.0][1 2 inf][1 0 0 0 1 0 0 0 1]",                  //
             "6d 1 [0 1.0][1 2 3][1 0 0 0 1 0 0 0 1",                     // cut short
             "6d 1 [-1 1.0][1 2 3][1 0 0 0 1 0 0 0 1]",                   //
             "6d 99999999 [0 1.0][1 2 3][1 0 0 0 1 0 0 0 1]",             //
             "6df2 1 1 [0 1.0 6 2][1 2 3][1 0 0 0 1 0 0 0 1][5 1.0]",     // one controller
             "6df2 1 1 [0 1.0 6 0][1 2 3][1 0 0 0 1 0 0 0 1][-5]",        //
             "6df2 1 1 [0 1.0 1e300 1e300][1 2 3][1 0 0 0 1 0 0 0 1][5]", //
             "6df2 1 [0 1.0 6 2][1 2 3][1 0 0 0 1 0 0 0 1][5 1.0 0.0]",   //
         }) {
        const auto frame = parse_dtrack("fr 7\n" + std::string(bad) + "\n" + good);
        ASSERT_TRUE(frame) << bad;
        EXPECT_EQ(frame->malformed_lines, 1) << bad;
        EXPECT_TRUE(frame->bodies.empty() && frame->flysticks.empty()) << bad;
        EXPECT_EQ(frame->markers.size(), 1u) << bad;
    }
    for (const char* no_frame : {"", "fr", "fr x\n", "fr -1\n", "fr 1e10\n", "6d 0\n", "\r\n\r\n"})
        EXPECT_FALSE(parse_dtrack(no_frame)) << no_frame;
}

/// A head and a Flystick at a loopback port.
class DTrackTest : public testing::TestWithParam<const char*> {
  protected:
    static DTrackOptions options(const std::string& address) {
        DTrackOptions result;
        result.endpoint = {address, 0};
        result.ages = DatagramAges::none; // the looks have a clock of their own
        DTrackDevice head;
        head.device.name = "head";
        head.device.prediction.on = false;
        DTrackDevice wand = head;
        wand.device.name = "wand";
        wand.kind = DTrackKind::flystick;
        DTrackDevice marker = head;
        marker.device.name = "marker";
        marker.kind = DTrackKind::marker;
        marker.id = 2;
        result.devices = {head, wand, marker};
        return result;
    }
    DTrackInput input{options(GetParam())};
    UdpSender sender{input.endpoint()};

    void send(const std::string& bytes) { ASSERT_TRUE(sender.send(bytes)); }
    std::string status() { return input.status().front(); }
};

INSTANTIATE_TEST_SUITE_P(Addresses, DTrackTest, testing::Values("127.0.0.1", "::1"));

TEST_P(DTrackTest, PosesButtonsAndTimesArrive) {
    const glm::dmat3 turned = glm::mat3_cast(glm::angleAxis(0.5, glm::dvec3(0, 1, 0)));
    send(dtrack_datagram(1, 100.0, {{0, {0.1, 1.7, -0.2}, turned}, {1, {9, 9, 9}}},
                         {{{0, {0.3, 1.2, -0.5}}, 3, {0.5, -1.0}}}, {{0, 0, 0}, {1, 2, 3}}));
    const InputState state = input.poll(Seconds(5));
    const DeviceState* head = state.find("head");
    ASSERT_TRUE(head && head->pose);
    EXPECT_EQ(head->tracking(), Tracking::tracked);
    expect_near(head->pose->position, {0.1, 1.7, -0.2}, 1e-6);
    EXPECT_LT(glm::length(rotation_between(head->pose->orientation,
                                           glm::angleAxis(0.5f, glm::vec3(0, 1, 0)))),
              1e-5);
    EXPECT_EQ(head->device_time, Seconds(100));
    EXPECT_NEAR(head->measured->count(), 5, 0.5);
    const DeviceState* wand = state.find("wand");
    ASSERT_TRUE(wand && wand->pose);
    expect_near(wand->pose->position, {0.3, 1.2, -0.5}, 1e-6);
    EXPECT_EQ(wand->buttons, 3u);
    EXPECT_EQ(wand->valuators, (std::vector<float>{0.5f, -1.0f}));
    expect_near(state.find("marker")->pose->position, {1, 2, 3}, 1e-6);
}

TEST_P(DTrackTest, ALatchTakesWhatCameSinceThePollAndLeavesItsButtons) {
    send(dtrack_datagram(1, 100.0, {{0, {0.1, 1.7, 0}}}, {{{0, {0, 1, 0}}, 0, {}}}));
    input.poll(Seconds(5));
    send(dtrack_datagram(2, 100.01, {{0, {0.11, 1.7, 0}}}, {{{0, {0, 1, 0}}, 1, {}}}));
    send(dtrack_datagram(3, 100.012, {{0, {0.12, 1.7, 0}}}, {{{0, {0, 1, 0}}, 0, {}}}));
    const InputState latched = input.latch(Seconds(5.02));
    expect_near(latched.find("head")->pose->position, {0.12, 1.7, 0}, 1e-6);
    EXPECT_EQ(latched.find("wand")->buttons, 0u);
    EXPECT_EQ(input.poll(Seconds(5.03)).find("wand")->buttons, 1u) << "pressed in between";
}

TEST_P(DTrackTest, AFlystickOutOfSightKeepsItsPoseAndItsButtons) {
    send(dtrack_datagram(1, 0.0, {}, {{{0, {0, 1, 0}}, 0, {}}}));
    input.poll(Seconds(0));
    for (int frame = 1; frame <= 30; ++frame) {
        PlayedFlystick hidden{{0, {}, glm::dmat3(1), false}, 1, {}};
        send(dtrack_datagram(static_cast<std::uint32_t>(frame + 1), frame / 60.0, {}, {hidden}));
        const InputState state = input.poll(Seconds(frame / 60.0));
        const DeviceState* wand = state.find("wand");
        EXPECT_EQ(wand->buttons, 1u);
        expect_near(wand->pose->position, {0, 1, 0}, 1e-6);
        if (frame != 6) { // 0.1 s after it was last seen
            EXPECT_EQ(wand->tracking(), frame < 6 ? Tracking::tracked : Tracking::held) << frame;
        }
    }
}

TEST_P(DTrackTest, LossAndReorderingNeverMoveTheHeadBack) {
    Random random(test_seed());
    const auto place = [](int frame) { return glm::dvec3(0.01 * frame, 1.7, 0); };
    std::vector<std::pair<double, int>> deliveries; // when a frame comes in, and which
    int lost = 0;
    for (int frame = 0; frame < 600; ++frame) {
        if (random() % 5 == 0 && frame != 0 && frame != 599)
            ++lost;
        else
            deliveries.emplace_back(frame + (random() % 4 == 0 ? uniform(random, 0, 4) : 0), frame);
    }
    std::ranges::sort(deliveries);
    int newest = -1, late = 0;
    for (const auto& [when, frame] : deliveries) {
        send(dtrack_datagram(static_cast<std::uint32_t>(frame), 50 + frame / 60.0,
                             {{0, place(frame)}}));
        late += frame < newest;
        newest = std::max(newest, frame);
        const InputState state = input.poll(Seconds(when / 60.0));
        ASSERT_TRUE(state.find("head")->pose);
        expect_near(state.find("head")->pose->position, place(newest), 1e-5);
    }
    EXPECT_GT(late, 50);
    EXPECT_THAT(status(), testing::HasSubstr(fmt::format("{} frames, {} missing, {} late, 0 malf",
                                                         600 - lost - late, lost + late, late)));
}

TEST_P(DTrackTest, TheNewestOfManyFramesWins) {
    for (std::uint32_t frame = 0; frame < 200; ++frame)
        send(dtrack_datagram(frame, frame / 300.0, {{0, {0.001 * frame, 1.7, 0}}}));
    const InputState state = input.poll(Seconds(1));
    expect_near(state.find("head")->pose->position, {0.199, 1.7, 0}, 1e-5);
}

TEST_P(DTrackTest, ZeroAndShearedMatricesAreRefused) {
    send(dtrack_datagram(1, 0.0, {{0, {0, 1.7, 0}}}));
    input.poll(Seconds(0));
    const glm::dmat3 sheared(1, 0, 0, 0.5, 1, 0, 0, 0, 1);
    for (const glm::dmat3& bad : {glm::dmat3(0), sheared, glm::dmat3(-1)})
        send(dtrack_datagram(2, 0.01, {{0, {0, 0, 0}, bad}}));
    const InputState state = input.poll(Seconds(0.01));
    expect_near(state.find("head")->pose->position, {0, 1.7, 0}, 1e-6);
    EXPECT_THAT(input.status()[1], testing::HasSubstr("1 refused as none"));
}

/// Valid frames, some of them damaged anywhere, and noise. What happens to read well is believed
/// only where the head can have gone since it was last seen.
TEST_P(DTrackTest, GarbageMovesTheHeadNoFartherThanItCanHaveGone) {
    Random random(test_seed());
    const PoseFilterLimits limits;
    double seen = 0, longest = 0;
    int astray = 0;
    constexpr int kFrames = 5000;
    for (int frame = 0; frame < kFrames; ++frame) {
        const double now = frame / 60.0;
        std::string bytes = dtrack_datagram(static_cast<std::uint32_t>(frame), 100 + now,
                                            {{0, {0, 1.7, 0}}}, {{{0, {0.2, 1.2, 0}}, 1, {0.5}}});
        const unsigned damage = frame == 0 ? 9 : random() % 9;
        if (damage == 0) {
            for (unsigned i = 1 + random() % 8; i > 0; --i)
                bytes[random() % bytes.size()] = static_cast<char>(random() % 256);
        } else if (damage == 1) {
            bytes.resize(random() % bytes.size());
        } else if (damage == 2) {
            bytes.resize(random() % 300);
            std::ranges::generate(bytes, [&] { return static_cast<char>(random() % 256); });
        } else {
            longest = std::max(longest, now - seen);
            seen = now;
        }
        send(bytes);
        const InputState state = input.poll(Seconds(now));
        for (const DeviceState& device : state.devices) {
            ASSERT_TRUE(!device.pose || is_finite(*device.pose));
            for (const float valuator : device.valuators)
                ASSERT_TRUE(std::isfinite(valuator));
        }
        const float off = glm::length(state.find("head")->pose->position - glm::vec3(0, 1.7f, 0));
        ASSERT_LT(off, limits.slack + limits.fastest * (longest + 0.05)) << "frame " << frame;
        astray += off > 0.001f;
    }
    EXPECT_LT(astray, kFrames / 50);
    EXPECT_EQ(status().find(" 0 malformed"), std::string::npos) << status();
}

/// Frame numbers a little ahead would otherwise make the tracker's own frames late.
TEST_P(DTrackTest, AnotherSenderCannotPushTheTrackerAside) {
    const auto head_at = [](std::uint32_t counter, double x) {
        return dtrack_datagram(counter, std::nullopt, {{0, {x, 1.7, 0}}});
    };
    const UdpSender other(input.endpoint());
    for (std::uint32_t frame = 0; frame < 300; ++frame) {
        send(head_at(frame, 0.001 * frame));
        for (std::uint32_t ahead : {1u, 500u, 999u, 5000u})
            for (int copy = 0; copy < 20; ++copy) // more than one poll keeps
                other.send(head_at(frame + ahead, -1));
        expect_near(input.poll(Seconds(frame / 60.0)).find("head")->pose->position,
                    {0.001 * frame, 1.7, 0}, 0.05); // one that waited long may count as old
    }
    EXPECT_THAT(status(), testing::HasSubstr("300 frames, 0 missing, 0 late"));
    EXPECT_THAT(status(), testing::HasSubstr(", 24000 from others ("));
}

TEST_P(DTrackTest, NoiseThatComesFirstIsNotTakenForTheTracker) {
    const UdpSender noise(input.endpoint());
    for (std::uint32_t frame = 0; frame < 100; ++frame) {
        for (int copy = 0; copy < 50; ++copy)
            noise.send("no frame");
        send(dtrack_datagram(frame, std::nullopt, {{0, {0, 1.7, 0}}}));
        EXPECT_EQ(input.poll(Seconds(frame / 60.0)).find("head")->pose.has_value(), frame > 0);
    }
}

TEST_P(DTrackTest, ATrackerThatStartsAgainIsTakenUpAfterASecond) {
    send(dtrack_datagram(7000, std::nullopt, {{0, {0, 1.7, 0}}}));
    input.poll(Seconds(0));
    const UdpSender again(input.endpoint());
    again.send(dtrack_datagram(1, std::nullopt, {{0, {0.1, 1.7, 0}}}));
    expect_near(input.poll(Seconds(0.5)).find("head")->pose->position, {0, 1.7, 0}, 1e-6);
    again.send(dtrack_datagram(2, std::nullopt, {{0, {0.1, 1.7, 0}}}));
    expect_near(input.poll(Seconds(2)).find("head")->pose->position, {0.1, 1.7, 0}, 1e-6);
}

TEST_P(DTrackTest, OnlyTheConfiguredSenderCounts) {
    DTrackOptions narrow = options(GetParam());
    const UdpSocket nobody({GetParam(), 0});
    narrow.from = nobody.endpoint();
    DTrackInput deaf(narrow);
    const UdpSender stranger(deaf.endpoint());
    stranger.send(dtrack_datagram(1, std::nullopt, {{0, {0, 1.7, 0}}}));
    EXPECT_FALSE(deaf.poll(Seconds(0)).find("head")->pose);
    narrow.from->port = 0; // any of this machine
    DTrackInput hearing(narrow);
    const UdpSender tracker(hearing.endpoint());
    tracker.send(dtrack_datagram(1, std::nullopt, {{0, {0, 1.7, 0}}}));
    EXPECT_TRUE(hearing.poll(Seconds(0)).find("head")->pose);
}

TEST(Endpoints, AreReadInEverySpelling) {
    EXPECT_EQ(endpoint_from("192.168.0.10"), (Endpoint{"192.168.0.10", 0}));
    EXPECT_EQ(endpoint_from("192.168.0.10:5000"), (Endpoint{"192.168.0.10", 5000}));
    EXPECT_EQ(endpoint_from("0:0:0::1"), (Endpoint{"::1", 0}));
    EXPECT_EQ(endpoint_from("[::1]"), (Endpoint{"::1", 0}));
    EXPECT_EQ(endpoint_from("[::1]:5000"), (Endpoint{"::1", 5000}));
    for (const char* bad : {"", ":", ":5000", "[]", "[::1", "[::1]5", "tracker.lab", "10.0.0.1:",
                            "10.0.0.1:x", "10.0.0.1:65536", "10.0.0.1:-1", "10.0.0.1:5 "})
        EXPECT_FALSE(endpoint_from(bad)) << bad;
}

TEST(DTrackInput, AnAddressThatCannotBeBoundIsNamed) {
    UdpSocket taken({"127.0.0.1", 0});
    const auto message = [](const Endpoint& endpoint) -> std::string {
        try {
            DTrackInput input({endpoint, {}, {}});
        } catch (const Error& error) {
            return error.what();
        }
        return "bound";
    };
    EXPECT_EQ(message(taken.endpoint()),
              fmt::format("udp {}: Address already in use", to_string(taken.endpoint())));
    EXPECT_EQ(message({"203.0.113.7", 5000}),
              "udp 203.0.113.7:5000: Cannot assign requested address");
    EXPECT_THAT(message({"tracker.lab", 5000}), testing::HasSubstr("expected a numeric"));
}

TEST(UdpSocket, ListensOnItsAddressOnly) {
    UdpSocket socket({"127.0.0.1", 0});
    const UdpSender elsewhere({"127.0.0.2", socket.endpoint().port});
    elsewhere.send("not for you");
    EXPECT_TRUE(socket.take(8).empty());
    const UdpSender right(socket.endpoint());
    ASSERT_TRUE(right.send("for you"));
    EXPECT_EQ(socket.take(8).size(), 1u);
}

TEST(UdpSocket, TakesABoundedNumberAndKeepsTheNewest) {
    UdpSocket socket({"127.0.0.1", 0});
    const UdpSender sender(socket.endpoint());
    for (int i = 0; i < 100; ++i)
        ASSERT_TRUE(sender.send(std::to_string(i)));
    const auto kept = socket.take(3);
    ASSERT_EQ(kept.size(), 3u);
    EXPECT_EQ(kept[0].bytes, "97");
    EXPECT_EQ(kept[2].bytes, "99");
    EXPECT_EQ(socket.thrown_away(), 97u);
    EXPECT_TRUE(socket.take(3).empty());
}

} // namespace
} // namespace isochron::interaction
