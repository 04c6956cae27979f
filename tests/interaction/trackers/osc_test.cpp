// Open Sound Control over loopback: addresses, types, bundles, garbage.
#include "interaction/trackers/osc_input.h"

#include "tests/interaction/controls/control_desk.h"
#include "tests/support/test_seed.h"
#include "tests/support/tracker_packets.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>

namespace isochron::interaction {
namespace {

using test_support::osc_bundle;
using test_support::osc_message;
using test_support::osc_pose;
using test_support::UdpSender;

class OscTest : public testing::TestWithParam<const char*> {
  protected:
    static OscOptions options(const std::string& address) {
        OscOptions result;
        result.endpoint = {address, 0};
        OscDevice head;
        head.device.name = "head";
        head.device.prediction.on = false;
        head.source = "glasses";
        OscDevice wand = head;
        wand.device.name = wand.source = "wand";
        OscDevice box = wand;
        box.device.name = box.source = "box";
        box.device.has_pose = false;
        result.devices = {head, wand, box};
        result.ages = DatagramAges::none; // the polls have a clock of their own
        return result;
    }
    OscInput input{options(GetParam())};
    UdpSender sender{input.endpoint()};

    DeviceState after(const std::string& bytes, const char* device, double now = 1) {
        EXPECT_TRUE(sender.send(bytes));
        return *input.poll(Seconds(now)).find(device);
    }
    std::string status() { return input.status().front(); }
};

INSTANTIATE_TEST_SUITE_P(Addresses, OscTest, testing::Values("127.0.0.1", "::1"));

const Pose kLeaning{{0.5f, 1.5f, -0.25f}, glm::quat(0.8f, 0.0f, 0.6f, 0.0f)};

TEST_P(OscTest, PosesArriveUnderTheirSourcesName) {
    const DeviceState head = after(osc_pose("/isochron/glasses/pose", kLeaning), "head");
    ASSERT_TRUE(head.pose);
    EXPECT_EQ(head.tracking(), Tracking::tracked);
    expect_near(head.pose->position, kLeaning.position, 1e-6);
    EXPECT_LT(glm::length(rotation_between(head.pose->orientation, kLeaning.orientation)), 1e-5);
}

TEST_P(OscTest, ButtonsAndValuatorsArriveWithAnyNumbers) {
    EXPECT_EQ(after(osc_message("/isochron/wand/button", {{'i', 1}, {'i', 1}}), "wand").buttons,
              2u);
    EXPECT_EQ(after(osc_message("/isochron/wand/button", {{'f', 0}, {'f', 1}}), "wand").buttons,
              3u);
    EXPECT_EQ(after(osc_message("/isochron/wand/button", {{'i', 1}, {'i', 0}}), "wand").buttons,
              1u);
    EXPECT_EQ(
        after(osc_message("/isochron/wand/valuator", {{'i', 1}, {'f', -0.5}}), "wand").valuators,
        (std::vector<float>{0.0f, -0.5f}));
    const DeviceState box = after(osc_message("/isochron/box/button", {{'i', 5}, {'i', 1}}), "box");
    EXPECT_EQ(box.buttons, 32u);
    EXPECT_FALSE(box.pose);
    EXPECT_EQ(box.tracking(), Tracking::tracked) << "a box of buttons has no pose to lose";
}

/// 64-bit values lie at multiples of 4 bytes.
TEST_P(OscTest, PosesMayBeDoubles) {
    std::vector<test_support::OscArgument> arguments;
    for (const double value : {0.5, 1.5, -0.25, 0.0, 0.6, 0.0, 0.8})
        arguments.push_back({'d', value});
    const DeviceState head = after(osc_message("/isochron/glasses/pose", arguments), "head");
    ASSERT_TRUE(head.pose);
    expect_near(head.pose->position, kLeaning.position, 1e-6);
}

TEST_P(OscTest, ABundlesTimeTagDatesItsPose) {
    constexpr double kSince1900 = 3.9e9;
    for (int i = 0; i <= 10; ++i) {
        Pose pose = kLeaning;
        pose.position.x = 0.01f * static_cast<float>(i);
        const DeviceState head =
            after(osc_bundle(kSince1900 + 0.01 * i,
                             {osc_message("/isochron/wand/button", {{'i', 0}, {'i', i % 2 * 1.0}}),
                              osc_bundle(kSince1900 + 0.01 * i,
                                         {osc_pose("/isochron/glasses/pose", pose)})}),
                  "head", 1 + 0.01 * i);
        ASSERT_TRUE(head.device_time);
        EXPECT_NEAR(head.device_time->count(), kSince1900 + 0.01 * i, 1e-6);
        EXPECT_NEAR(head.measured->count(), 1 + 0.01 * i, 0.5);
        if (i == 10) {
            EXPECT_NEAR(head.velocity->linear.x, 1.0, 0.01);
        }
    }
    EXPECT_FALSE(after(osc_bundle(0, {osc_pose("/isochron/wand/pose", kLeaning)}), "wand", 1.11)
                     .device_time.has_value())
        << "`immediately` is no time";
}

TEST_P(OscTest, AVelocityGoesWithTheNextPose) {
    ASSERT_TRUE(sender.send(osc_message(
        "/isochron/wand/velocity", {{'f', 1}, {'f', 2}, {'f', 0}, {'f', 0}, {'f', 3}, {'f', 0}})));
    const DeviceState wand = after(osc_pose("/isochron/wand/pose", kLeaning), "wand");
    ASSERT_TRUE(wand.velocity);
    expect_near(wand.velocity->linear, {1, 2, 0}, 1e-6);
    expect_near(wand.velocity->angular, {0, 3, 0}, 1e-6);
}

TEST_P(OscTest, WrongTypesUnknownAddressesAndNonsenseAreCounted) {
    after(osc_pose("/isochron/wand/pose", kLeaning), "wand");
    const DeviceState before = *input.poll(Seconds(1)).find("wand");
    std::string text = osc_message("/isochron/wand/button", {{'i', 0}, {'i', 0}});
    text[text.find(",ii") + 2] = 's'; // an empty text where a number should be
    for (const std::string& wrong : {osc_message("/isochron/wand/pose", {{'f', 1}, {'f', 2}}),
                                     osc_message("/isochron/wand/button", {{'i', -1}, {'i', 1}}),
                                     osc_message("/isochron/wand/valuator", {{'f', 0.5}, {'f', 1}}),
                                     osc_message("/isochron/wand/button", {}), text})
        ASSERT_TRUE(sender.send(wrong));
    ASSERT_TRUE(sender.send(osc_message("/isochron/wand/color", {{'i', 1}})));
    ASSERT_TRUE(sender.send(osc_pose("/other/wand/pose", kLeaning)));
    ASSERT_TRUE(sender.send(osc_pose("/isochron/wandpose", kLeaning)));
    ASSERT_TRUE(sender.send("no message at all"));
    ASSERT_TRUE(sender.send(osc_bundle(1e9, {"short"}).substr(0, 23)));
    const DeviceState after_all = *input.poll(Seconds(1)).find("wand");
    EXPECT_EQ(after_all.pose, before.pose);
    EXPECT_EQ(after_all.buttons, 0u);
    EXPECT_THAT(status(), testing::HasSubstr("5 of wrong types, 3 to unknown addresses, 2 malf"));
}

TEST_P(OscTest, NaNAndNonUnitQuaternionsAreRefused) {
    after(osc_pose("/isochron/glasses/pose", kLeaning), "head");
    Pose nan = kLeaning, long_one = kLeaning;
    nan.position.y = NAN;
    long_one.orientation = long_one.orientation * 1.5f;
    ASSERT_TRUE(sender.send(osc_pose("/isochron/glasses/pose", nan)));
    const DeviceState head = after(osc_pose("/isochron/glasses/pose", long_one), "head");
    expect_near(head.pose->position, kLeaning.position, 1e-6);
    EXPECT_THAT(input.status()[1], testing::HasSubstr("2 refused as none"));
}

/// Each hand has a message of its own: a frame may begin between the two. The hand whose message
/// comes later is then stated where it was one message ago, and says so by its time.
TEST_P(OscTest, AFrameBetweenTwoHandsMessagesStatesEachAsItWasSent) {
    const auto at = [](double x, double time) {
        return Pose{{static_cast<float>(x + 0.1 * time), 1.2f, 0.0f}, {1, 0, 0, 0}};
    };
    for (int i = 0; i <= 20; ++i) {
        const double now = 1 + i / 150.0;
        ASSERT_TRUE(sender.send(osc_pose("/isochron/wand/pose", at(0.3, now))));
        const InputState state = input.poll(Seconds(now)); // a frame begins here
        ASSERT_TRUE(sender.send(osc_pose("/isochron/glasses/pose", at(-0.3, now))));
        expect_near(state.find("wand")->pose->position, at(0.3, now).position, 1e-6);
        const DeviceState* other = state.find("head");
        if (i == 0) {
            EXPECT_FALSE(other->pose);
            continue;
        }
        // One message at 150 Hz and 0.1 m/s: 0.7 mm.
        const double before = 1 + (i - 1) / 150.0;
        expect_near(other->pose->position, at(-0.3, before).position, 1e-6);
        EXPECT_LE(other->measured->count(), now);
    }
}

TEST_P(OscTest, WhatWasQueuedBeforeTheStartDoesNotMakeGoodPosesJumps) {
    for (int i = 0; i < 60; ++i)
        ASSERT_TRUE(sender.send(osc_pose("/isochron/glasses/pose", kLeaning)));
    input.begin();
    Pose moved = kLeaning;
    moved.position.x += 2;
    for (int i = 0; i < 30; ++i)
        expect_near(
            after(osc_pose("/isochron/glasses/pose", moved), "head", i / 60.0).pose->position,
            moved.position, 1e-6);
    EXPECT_THAT(input.status()[1],
                testing::HasSubstr("30 poses, 0 refused as none, 0 late, 0 jum"));
}

TEST_P(OscTest, BundlesInBundlesEnd) {
    std::string nested = osc_pose("/isochron/glasses/pose", kLeaning);
    for (int i = 0; i < 100; ++i)
        nested = osc_bundle(0, {nested});
    EXPECT_FALSE(after(nested, "head").pose);
    EXPECT_THAT(status(), testing::HasSubstr("1 malformed"));
}

/// Valid messages, some of them damaged anywhere: what happens to read well is believed only where
/// the head can have gone since it was last seen.
TEST_P(OscTest, GarbageMovesTheHeadNoFartherThanItCanHaveGone) {
    Random random(test_seed());
    const PoseFilterLimits limits;
    after(osc_pose("/isochron/glasses/pose", kLeaning), "head", 0);
    double seen = 0, longest = 0;
    int astray = 0;
    constexpr int kFrames = 10000;
    for (int frame = 1; frame < kFrames; ++frame) {
        const double now = frame / 60.0;
        std::string bytes = osc_bundle(
            3.9e9 + now, {osc_pose("/isochron/glasses/pose", kLeaning),
                          osc_message("/isochron/wand/valuator", {{'i', 0}, {'f', 0.5}})});
        const unsigned damage = random() % 6;
        if (damage == 0) {
            for (unsigned i = 1 + random() % 8; i > 0; --i)
                bytes[random() % bytes.size()] = static_cast<char>(random() % 256);
        } else if (damage == 1) {
            bytes.resize(random() % bytes.size());
        } else {
            longest = std::max(longest, now - seen);
            seen = now;
        }
        ASSERT_TRUE(sender.send(bytes));
        const InputState state = input.poll(Seconds(now));
        const Pose& head = *state.find("head")->pose;
        ASSERT_TRUE(is_finite(head));
        const float off = glm::length(head.position - kLeaning.position);
        // A time tag may be wrong too, by as much as a clock is believed.
        ASSERT_LT(off, limits.slack + limits.fastest * (longest + 0.15)) << "frame " << frame;
        astray += off > 0.001f;
        for (const float valuator : state.find("wand")->valuators)
            ASSERT_TRUE(std::isfinite(valuator));
    }
    EXPECT_LT(astray, kFrames / 50);
    EXPECT_EQ(status().find(" 0 malformed"), std::string::npos) << status();
}

} // namespace
} // namespace isochron::interaction
