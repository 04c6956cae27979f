// Messages of a cluster are read as they were written, and damaged ones are refused.
#include "app/cluster/cluster_messages.h"

#include "tests/support/test_seed.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <functional>
#include <limits>
#include <random>

namespace isochron::app {
namespace {

FrameOrder rich_order(std::mt19937& random) {
    std::uniform_real_distribution<double> any(-10, 10);
    FrameOrder order;
    order.input.time = interaction::Seconds(any(random) * 1e3);
    interaction::DeviceState head;
    head.name = "head";
    head.pose = interaction::Pose{{float(any(random)), float(any(random)), 1.1f},
                                  glm::normalize(glm::quat(0.3f, float(any(random)), 0.1f, 0.7f))};
    head.buttons = random();
    head.valuators = {float(any(random)), -0.0f, 1e-30f};
    head.velocity = interaction::Velocity{{any(random), 1, 2}, {3, any(random), 5}};
    head.measured = interaction::Seconds(any(random));
    order.input.devices = {
        head,
        {.name = "wand", .pose = {}, .pose_valid = false, .valuators = {}, .pose_lost = true}};
    order.commands.isovalue = any(random);
    order.commands.instant = index::Instant(random() % 1000);
    order.commands.room_from_physical = interaction::Similarity{};
    order.commands.room_from_physical->translation = {any(random), any(random), any(random)};
    order.commands.playback = interaction::PlaybackState{true, true, false, 0.1 + 1.0 / 3};
    order.commands.stamps = {"here", "there"};
    order.commands.quit = random() % 2;
    order.waiting = random() % 2 ? Waiting::for_cells : Waiting::never;
    order.cells = {random(), random(), std::numeric_limits<std::uint64_t>::max()};
    return order;
}

FrameAnswer rich_answer(std::mt19937& random) {
    FrameAnswer answer;
    answer.cells = {random(), random(), random(), random()};
    answer.close = random() % 2;
    answer.failure = random() % 2 ? "step 3: damaged" : "";
    answer.view = {2, 1e6 / 3};
    answer.surface_limit = random();
    answer.parts_whole = random() % 2;
    answer.parts_took = Milliseconds(0.1 * static_cast<double>(random() % 10'000));
    answer.samples = {
        {random(), render::Footprint::surface, {1e5 / 3, 2}, Milliseconds(0.1), {}},
        {random(), render::Footprint::quad, {1, 2}, Milliseconds(1), Milliseconds(3)}};
    return answer;
}

PictureState any_state(std::mt19937& random) {
    while (true)
        if (const auto state =
                PictureState::of(Shown(random() % kShown), Beside(random() % kBeside),
                                 render::Footprint::surface, random() % 2))
            return *state;
}

std::span<const std::byte> view(const MessageBytes& bytes) {
    return std::as_bytes(std::span(bytes));
}

TEST(ClusterMessages, WhatIsSaidIsUnderstoodExactly) {
    std::mt19937 random(test_seed());
    for (int i = 0; i < 100; ++i) {
        const FrameOrder order = rich_order(random);
        EXPECT_EQ(decode_order(view(encoded(order))), order);
        const FrameAnswer answer = rich_answer(random);
        EXPECT_EQ(decode_answer(view(encoded(answer))), answer);
        const FramePlan plan{render::Footprint::gaussian,
                             QualityReason::over_budget,
                             any_state(random),
                             i % 3 == 0,
                             {random() % 1000, i % 5 == 0,
                              std::vector<std::int8_t>(i % 7, static_cast<std::int8_t>(-i % 9))},
                             i % 5 == 1,
                             i % 7 == 1,
                             i % 6 == 1,
                             static_cast<std::size_t>(i % 4),
                             static_cast<std::size_t>(i % 3)};
        EXPECT_EQ(decode_plan(view(encoded(plan))), plan);
    }
    EXPECT_EQ(decode_order(view(encoded_end())), std::nullopt);
}

TEST(ClusterMessages, DamagedBytesAreAnErrorOrAnotherMessageAndNothingElse) {
    std::mt19937 random(test_seed());
    const auto damage = [&](MessageBytes bytes) {
        for (unsigned i = 0; i <= random() % 4; ++i)
            bytes[random() % bytes.size()] = static_cast<std::uint8_t>(random());
        if (random() % 4 == 0)
            bytes.resize(random() % bytes.size());
        return bytes;
    };
    int refused = 0;
    const auto attempt = [&](const std::function<void()>& decode) {
        try {
            decode();
        } catch (const interaction::Error&) {
            ++refused;
        }
    };
    constexpr int kTries = 3000;
    for (int i = 0; i < kTries; ++i) {
        const MessageBytes order = damage(encoded(rich_order(random)));
        attempt([&] { decode_order(view(order)); });
        const MessageBytes answer = damage(encoded(rich_answer(random)));
        attempt([&] { decode_answer(view(answer)); });
        const MessageBytes plan = damage(encoded(FramePlan{}));
        attempt([&] { decode_plan(view(plan)); });
    }
    EXPECT_GT(refused, kTries);
}

TEST(ClusterMessages, OneMessageIsNotTakenForAnother) {
    std::mt19937 random(test_seed());
    EXPECT_THROW(decode_order(view(encoded(rich_answer(random)))), interaction::Error);
    EXPECT_THROW(decode_answer(view(encoded(rich_order(random)))), interaction::Error);
    EXPECT_THROW(decode_plan(view(encoded_end())), interaction::Error);
    EXPECT_THROW(decode_plan({}), interaction::Error);
}

TEST(ClusterMessages, APlanInAStateThatIsNoneIsRefused) {
    nlohmann::json plan = nlohmann::json::from_cbor(encoded(FramePlan{}));
    plan["state"]["shown"] = Shown::stays;
    EXPECT_NO_THROW(decode_plan(view(nlohmann::json::to_cbor(plan))));
    plan["state"]["beside"] = Beside::ahead;
    EXPECT_THROW(decode_plan(view(nlohmann::json::to_cbor(plan))), interaction::Error);
}

TEST(ClusterMessages, WhatNestsWithoutEndIsRefusedBeforeTheStackEnds) {
    // An array of one, a map of one with an empty key, text and bytes in pieces, a tag.
    const std::vector<std::vector<unsigned char>> levels{{0x81}, {0xa1, 0x60}, {0x7f},
                                                         {0x5f}, {0xc0},       {0x9f}};
    for (const std::vector<unsigned char>& level : levels) {
        MessageBytes bytes;
        for (int i = 0; i < 1'000'000; ++i)
            bytes.insert(bytes.end(), level.begin(), level.end());
        EXPECT_THROW(decode_order(view(bytes)), interaction::Error) << int(level[0]);
    }
}

} // namespace
} // namespace isochron::app
