// Key frames become recorded frames that move smoothly: the claims are tried on random keys.
#include "interaction/error.h"
#include "interaction/navigation/key_motion.h"
#include "interaction/navigation/navigation.h"
#include "interaction/recording/key_film.h"
#include "tests/interaction/input_builders.h"
#include "tests/interaction/obeyed.h"
#include "tests/support/test_seed.h"

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <string>

namespace isochron::interaction {
namespace {

const StepTimes kEvenSteps{{0, 1, 2, 3, 4, 5, 6, 7, 8, 9}};

KeyFrame key_at(double time, const Similarity& view = {}) {
    KeyFrame key;
    key.time = time;
    key.room_from_physical = view;
    return key;
}

Similarity any_view(Random& random) {
    return {{uniform(random, -2, 2), uniform(random, -2, 2), uniform(random, -2, 2)},
            glm::normalize(glm::dquat(random_rotation(random))),
            std::exp(uniform(random, -2, 2)),
            1};
}

/// Keys at random times, some of which hold.
KeyTimes any_times(Random& random, std::size_t count) {
    KeyTimes times;
    double time = 0;
    for (std::size_t i = 0; i < count; ++i) {
        const double hold = random() % 4 == 0 ? uniform(random, 0.1, 1) : 0;
        times.at.push_back({time, time + hold});
        time += hold + uniform(random, 0.3, 3);
    }
    return times;
}

double end_of(const KeyTimes& times) {
    return times.at.back().leaves;
}

/// The largest change of a velocity within `kMoment`, as a share of the highest speed.
/// @param at the place at a time
double largest_jump(const KeyTimes& times, const std::function<glm::dvec3(double)>& at) {
    constexpr double kMoment = 1e-5;
    constexpr int kLooks = 400;
    double fastest = 0, jump = 0;
    for (int i = 0; i <= kLooks; ++i) {
        const double time = end_of(times) * i / kLooks;
        fastest = std::max(fastest, glm::length(at(time + kMoment) - at(time)) / kMoment);
    }
    for (const KeyTime& key : times.at)
        for (const double time : {key.arrives, key.leaves}) {
            const glm::dvec3 before = (at(time) - at(time - kMoment)) / kMoment;
            const glm::dvec3 after = (at(time + kMoment) - at(time)) / kMoment;
            jump = std::max(jump, glm::length(after - before));
        }
    return fastest > 0 ? jump / fastest : 0;
}

TEST(KeyMotion, TheCamerasVelocityDoesNotJumpAtRandomKeys) {
    Random random(test_seed());
    double worst = 0;
    for (int round = 0; round < tries(600); ++round) {
        const KeyTimes times = any_times(random, 2 + random() % 6);
        std::vector<Similarity> views;
        for (std::size_t i = 0; i < times.at.size(); ++i)
            views.push_back(any_view(random));
        const KeyedSimilarity motion(times, views, {0.5, 0.5, 0.5});
        const glm::dvec3 eye(0.1, 1.6, 1.2);
        worst = std::max(worst, largest_jump(times, [&](double time) {
                             return in_physical(motion.at(times.place(time)), eye);
                         }));
    }
    RecordProperty("jump", std::to_string(worst));
    EXPECT_LT(worst, 0.01);
}

TEST(KeyMotion, NumbersPassEachKeyAndNeverOvershoot) {
    Random random(test_seed());
    for (int round = 0; round < tries(3000); ++round) {
        const KeyTimes times = any_times(random, 2 + random() % 6);
        std::vector<double> values, growth;
        for (std::size_t i = 0; i < times.at.size(); ++i)
            values.push_back(random() % 4 ? uniform(random, -5, 5) : 0.0);
        for (std::size_t i = 1; i < times.at.size(); ++i)
            growth.push_back(uniform(random, -8, 8));
        const KeyedNumber number(times, values, false, round % 2 ? growth : std::vector<double>());
        for (std::size_t i = 0; i < values.size(); ++i) {
            EXPECT_EQ(number.at(times.place(times.at[i].arrives)), values[i]);
            EXPECT_EQ(number.at(times.place(times.at[i].leaves)), values[i]);
        }
        for (std::size_t i = 0; i + 1 < values.size(); ++i) {
            double last = values[i];
            for (int part = 1; part < 50; ++part) {
                const double now = number.at({i, part / 50.0});
                // Towards the next value all the time: no overshoot, no turn on the way.
                ASSERT_GE((now - last) * (values[i + 1] - values[i]), 0) << "move " << i;
                ASSERT_LE(std::abs(now - values[i]), std::abs(values[i + 1] - values[i]));
                last = now;
            }
        }
    }
}

TEST(KeyMotion, PeakAccelerationIsAtMostThreeTimesThatOfOneEasedMove) {
    Random random(test_seed());
    double worst = 0, worst_turn = 0;
    for (int round = 0; round < tries(1500); ++round) {
        const KeyTimes times = any_times(random, 3 + random() % 5);
        std::vector<double> values;
        std::vector<glm::dquat> turns;
        for (std::size_t i = 0; i < times.at.size(); ++i) {
            // To and fro, or on and on with long and short moves, which keys pass at speed.
            const bool on = round % 2 && i > 0;
            values.push_back(on ? values.back() + std::exp(uniform(random, -4, 4))
                                : uniform(random, -5, 5));
            turns.push_back(glm::normalize(glm::dquat(random_rotation(random))));
        }
        const KeyedNumber number(times, values);
        const KeyedTurn turn(times, turns);
        constexpr double kPart = 1e-3;
        for (std::size_t i = 0; i + 1 < values.size(); ++i)
            for (double share = 2 * kPart; share < 1 - 2 * kPart; share += 0.01) {
                const auto at = [&](double s) { return number.at({i, s}); };
                const double rate =
                    (at(share + kPart) - 2 * at(share) + at(share - kPart)) / (kPart * kPart);
                // An eased move of 1 in a time of 1 begins with 6.
                worst = std::max(worst, std::abs(rate / (values[i + 1] - values[i])) / 6);
                const auto turned = [&](double from, double to) {
                    glm::dquat by = turn.at({i, to}) * glm::conjugate(turn.at({i, from}));
                    by = by.w < 0 ? -by : by;
                    return glm::dvec3(by.x, by.y, by.z) * 2.0;
                };
                const glm::dvec3 change =
                    (turned(share, share + kPart) - turned(share - kPart, share)) / (kPart * kPart);
                const double whole =
                    2 * std::acos(std::min(1.0, std::abs(glm::dot(turns[i], turns[i + 1]))));
                worst_turn = std::max(worst_turn, glm::length(change) / whole / 6);
            }
    }
    RecordProperty("numbers", std::to_string(worst));
    RecordProperty("turns", std::to_string(worst_turn));
    EXPECT_LT(worst, 3);
    EXPECT_LT(worst_turn, 3);
    EXPECT_GT(worst, 1.2); // keys that are passed at speed cost some
}

TEST(KeyMotion, TurnsGoTheShortestWayAtASpeedThatDoesNotJump) {
    Random random(test_seed());
    for (int round = 0; round < tries(600); ++round) {
        const KeyTimes times = any_times(random, 3 + random() % 4);
        std::vector<glm::dquat> turns;
        for (std::size_t i = 0; i < times.at.size(); ++i) {
            turns.push_back(glm::normalize(glm::dquat(random_rotation(random))));
            if (random() % 2) // means the same orientation
                turns.back() = -turns.back();
        }
        const KeyedTurn turn(times, turns);
        const auto place = [&](double time) {
            return turn.at(times.place(time)) * glm::dvec3(1, 2, 3);
        };
        EXPECT_LT(largest_jump(times, place), 0.01);
        for (std::size_t i = 0; i + 1 < turns.size(); ++i) {
            const auto away = [](const glm::dquat& a, const glm::dquat& b) {
                return 2 * std::acos(std::min(1.0, std::abs(glm::dot(a, b))));
            };
            const double whole = away(turns[i], turns[i + 1]);
            for (int part = 0; part <= 20; ++part) {
                const glm::dquat now = turn.at({i, part / 20.0});
                EXPECT_LT(away(turns[i], now), whole * 1.01 + 1e-6);
                EXPECT_LT(away(turns[i + 1], now), whole * 1.01 + 1e-6);
            }
            EXPECT_LT(away(turn.at({i, 1 - 1e-9}), turns[i + 1]), 1e-5);
        }
    }
}

TEST(KeyMotion, AnOrbitStaysAtItsDistanceFromTheData) {
    const glm::dvec3 center(30, 40, 50), eye(0, 1.6, 0);
    Similarity view{{-0.3, 0.9, -1.8}, {1, 0, 0, 0}, 0.01, 1};
    KeyTimes times;
    std::vector<Similarity> views;
    for (int i = 0; i < 5; ++i) {
        times.at.push_back({2.0 * i, 2.0 * i});
        views.push_back(view);
        view = turned(view, transform(view, center), glm::normalize(glm::dvec3(0.2, 1, 0)),
                      std::numbers::pi * (0.2 + 0.2 * i));
    }
    const KeyedSimilarity motion(times, views, {0, 0, 0});
    const double distance = glm::length(transform(views[0], center) - eye);
    for (double time = 0; time < 8; time += 0.01)
        EXPECT_NEAR(glm::length(transform(motion.at(times.place(time)), center) - eye), distance,
                    0.005 * distance);
}

TEST(KeyMotion, APlaceThatIsZoomedAboutStaysWhereItIs) {
    const glm::dvec3 place(0.31, 0.12, 0.77);
    Similarity view{{-0.5, 1, -2}, glm::normalize(glm::dquat(1, 0.2, 0.3, 0.4)), 1, 1};
    const glm::dvec3 in_room = transform(view, place);
    KeyTimes times;
    std::vector<Similarity> views;
    for (int i = 0; i < 4; ++i) {
        times.at.push_back({2.0 * i, 2.0 * i + (i == 2 ? 1 : 0)});
        views.push_back(view);
        view = scaled(view, in_room, i == 2 ? 1.0 / 300 : 40, 1e-9, 1e9);
    }
    const KeyedSimilarity motion(times, views, {9, 9, 9});
    for (double time = 0; time < 6; time += 0.01)
        EXPECT_LT(glm::length(transform(motion.at(times.place(time)), place) - in_room), 1e-6);
    EXPECT_NEAR(motion.at({2, 0.5}).scale, std::sqrt(views[2].scale * views[3].scale), 1e-6);
}

std::vector<Commands> commands_of(const std::vector<RecordedFrame>& frames) {
    std::vector<Commands> all;
    for (const RecordedFrame& frame : frames)
        all.push_back(frame.commands);
    return all;
}

/// The settings that each frame shows.
std::vector<Settings> shown_by(const std::vector<RecordedFrame>& frames, Settings settings) {
    std::vector<Settings> all;
    for (const RecordedFrame& frame : frames) {
        obey(frame.commands, settings);
        all.push_back(settings);
    }
    return all;
}

TEST(KeyFrames, FramesBeginAndEndAtTheKeysAndRestWhereTheyHold) {
    Random random(test_seed());
    const Similarity first = any_view(random), second = any_view(random);
    std::vector<KeyFrame> keys{key_at(0, first), key_at(2, second)};
    keys[0].hold = 1;
    keys[1].hold = 0.51; // no whole number of frames
    const auto frames = frames_of(keys, {.times = kEvenSteps, .rate = 30});
    ASSERT_EQ(frames.size(), 77u); // 2.51 s are 75.3 frames, and the last one is shown, too
    const auto shown = shown_by(frames, {});
    for (std::size_t i = 0; i <= 30; ++i)
        EXPECT_EQ(shown[i].room_from_physical, first) << i;
    EXPECT_NE(shown[31].room_from_physical, first);
    for (std::size_t i = 60; i < frames.size(); ++i)
        EXPECT_EQ(shown[i].room_from_physical, second) << i;
    for (std::size_t i = 61; i < frames.size(); ++i)
        EXPECT_TRUE(frames[i].commands.empty());
    EXPECT_EQ(frames[30].input.time, Seconds(1));
    EXPECT_EQ(commands_of(frames_of(keys, {.times = kEvenSteps, .rate = 30})), commands_of(frames));
}

TEST(KeyFrames, IsovaluesGoLinearlyOrByFactorsEasedOrEvenly) {
    for (const bool logarithmic : {false, true})
        for (const KeyPace pace : {KeyPace::eased, KeyPace::even}) {
            std::vector<KeyFrame> keys{key_at(0), key_at(4)};
            keys[0].isovalue = 1;
            keys[1].isovalue = 10'000;
            keys[0].pace = pace;
            const auto shown = shown_by(
                frames_of(keys, {.times = kEvenSteps, .rate = 1, .logarithmic = logarithmic}), {});
            ASSERT_EQ(shown.size(), 5u);
            const double done = pace == KeyPace::even ? 0.25 : 0.15625; // 3 / 16 - 2 / 64
            EXPECT_NEAR(shown[1].isovalue(), logarithmic ? std::pow(10, 4 * done) : 1 + 9999 * done,
                        1e-9);
            EXPECT_EQ(shown[4].isovalue(), 10'000);
        }
}

TEST(KeyFrames, TimeGoesByTheDatasTimesAndFallsBetweenStepsOnlyWhereTheyAreBlended) {
    const StepTimes uneven{{0, 1, 10, 12}, StepGaps({2})};
    std::vector<KeyFrame> keys{key_at(0), key_at(12)};
    keys[0].pace = KeyPace::even;
    keys[0].step = 0;
    keys[1].step = 3;
    KeyScene scene{.times = uneven, .rate = 2};
    auto shown = shown_by(frames_of(keys, scene), {});
    ASSERT_EQ(shown.size(), 25u);
    for (std::size_t i = 0; i < shown.size(); ++i) {
        const double time = 0.5 * static_cast<double>(i);
        const std::uint32_t step = time < 1 ? 0 : time < 10 ? 1 : time < 12 ? 2 : 3;
        EXPECT_EQ(shown[i].instant, Instant(step)) << time;
    }
    scene.start.between = BetweenSteps::blend;
    shown = shown_by(frames_of(keys, scene), scene.start);
    EXPECT_EQ(shown[1].instant, Instant(0, Instant::kFractions / 2));
    EXPECT_EQ(shown[11].instant, Instant(1, Instant::kFractions / 2));
    EXPECT_EQ(shown[22].instant, Instant(2)); // in front of a gap
}

TEST(KeyFrames, GhostsFadeInAndOutBetweenTheirKeys) {
    std::vector<KeyFrame> keys{key_at(0), key_at(2), key_at(4), key_at(6)};
    keys[0].ghosts = Ghosts{};
    keys[1].ghosts = Ghosts{2, 1, 3, 0.5f};
    keys[2].ghosts = Ghosts{2, 1, 3, 0.9f};
    keys[3].ghosts = Ghosts{0, 0, 3, 0.9f};
    const auto shown = shown_by(frames_of(keys, {.times = kEvenSteps, .rate = 1}), {});
    ASSERT_EQ(shown.size(), 7u);
    const std::vector<float> opacities{0, 0.25f, 0.5f, 0.7f, 0.9f, 0.45f, 0};
    for (std::size_t i = 0; i < shown.size(); ++i) {
        const Ghosts& ghosts = shown[i].ghosts;
        EXPECT_NEAR(ghosts.shown() ? ghosts.opacity : 0.0f, opacities[i], 1e-6) << i;
        EXPECT_EQ(ghosts.earlier, i == 0 || i == 6 ? 0u : 2u) << i;
    }
    EXPECT_EQ(shown.back().ghosts, *keys[3].ghosts);
}

TEST(KeyFrames, WhatAKeyDoesNotHoldPassesThroughIt) {
    std::vector<KeyFrame> keys{key_at(0), key_at(3), key_at(6)};
    keys[1] = {.time = 3, .bounding_box = false};
    keys[0].step = 2;
    keys[2].step = 8;
    keys[2].room_from_physical->translation.x = 6;
    const auto frames = frames_of(keys, {.times = kEvenSteps, .rate = 1});
    const auto shown = shown_by(frames, {});
    EXPECT_NEAR(shown[3].room_from_physical.translation.x, 3, 1e-12);
    EXPECT_EQ(shown[3].instant.step, 5u);
    EXPECT_TRUE(shown[2].bounding_box);
    EXPECT_FALSE(shown[3].bounding_box);
    for (std::size_t i = 1; i + 1 < frames.size(); ++i)
        EXPECT_GT(shown[i + 1].room_from_physical.translation.x,
                  shown[i].room_from_physical.translation.x);
}

TEST(KeyFrames, HeadsGoThroughThePosesOfTheKeys) {
    std::vector<KeyFrame> keys{key_at(0), key_at(2)};
    keys[0].head = Pose{{0, 1.5f, 0}, {1, 0, 0, 0}};
    keys[1].head = Pose{{1, 1.5f, 0}, glm::angleAxis(1.0f, glm::vec3(0, 1, 0))};
    KeyScene scene{.seen = {Seconds(7), {wand_at(kStanding)}}, .times = kEvenSteps, .rate = 1};
    const auto frames = frames_of(keys, scene);
    ASSERT_EQ(frames.size(), 3u);
    EXPECT_EQ(frames[0].input.find("head")->pose, keys[0].head);
    EXPECT_NEAR(frames[1].input.find("head")->pose->position.x, 0.5, 1e-6);
    EXPECT_NEAR(glm::angle(frames[1].input.find("head")->pose->orientation), 0.5, 1e-6);
    EXPECT_EQ(frames[2].input.find("head")->pose, keys[1].head);
    EXPECT_EQ(frames[1].input.find("wand")->pose, kStanding);
}

TEST(KeyFrames, HeadsRestAtTheFirstAndTheLastKeyThatHasOne) {
    std::vector<KeyFrame> keys{key_at(0), key_at(2), key_at(4), key_at(6), key_at(8)};
    for (std::size_t i = 1; i < 4; ++i)
        keys[i].head = Pose{{static_cast<float>(i), 1.5f, 0}, {1, 0, 0, 0}};
    KeyScene scene{.seen = {Seconds(0), {}}, .times = kEvenSteps, .rate = 100};
    const auto frames = frames_of(keys, scene);
    const auto head = [&](std::size_t frame) {
        return frames.at(frame).input.find("head")->pose->position.x;
    };
    EXPECT_NEAR(head(201), 1, 1e-3) << "evenly it would have gone 5e-3";
    EXPECT_NEAR(head(599), 3, 1e-3);
    EXPECT_GT(head(201 + 99), 1.3f);
}

TEST(KeyFrames, ATurnIsEvenAndEndsWhereItBegan) {
    Settings settings;
    settings.room_from_physical = {{-0.5, 1, -2}, glm::normalize(glm::dquat(1, 0.5, 0, 0)), 0.1, 2};
    const glm::dvec3 pivot(5, 6, 7);
    const auto keys = turn_keys(settings, pivot, Instant(0), Instant(9), 10);
    const auto frames =
        frames_of(keys, {.start = settings, .times = kEvenSteps, .pivot = pivot, .rate = 18});
    const auto shown = shown_by(frames, settings);
    ASSERT_EQ(shown.size(), 181u);
    const glm::dvec3 center = transform(settings.room_from_physical, pivot);
    const glm::dvec3 up = settings.room_from_physical.rotation * glm::dvec3(0, 0, 1);
    for (std::size_t i = 0; i < shown.size(); ++i) {
        const Similarity expected = turned(settings.room_from_physical, center, up,
                                           2 * std::numbers::pi * static_cast<double>(i) / 180);
        for (const glm::dvec3 corner : {glm::dvec3(0), glm::dvec3(10, 0, 14)})
            EXPECT_LT(glm::length(transform(shown[i].room_from_physical, corner) -
                                  transform(expected, corner)),
                      1e-9);
        EXPECT_EQ(shown[i].instant.step, i / 20);
    }
    EXPECT_EQ(shown.back().room_from_physical, settings.room_from_physical);
}

TEST(KeyFrames, AFileOfKeysIsReadAsItWasWritten) {
    Random random(test_seed());
    std::vector<KeyFrame> keys;
    for (int i = 0; i < 5; ++i) {
        Settings settings;
        settings.room_from_physical = any_view(random);
        settings.instant = Instant(3, 77);
        settings.mark.point.emplace();
        keys = with_key(keys, key_of(settings, kStanding));
    }
    keys[2].hold = 0.5;
    keys[3].array = "zwölf";
    keys[4].coloring.reset();
    EXPECT_EQ(keys_from(keys_text(keys), "k.json"), keys);
    EXPECT_EQ(keys[4].time, 8);
}

TEST(KeyFrames, DamagedFilesOfKeysAreRefusedInOneLine) {
    const auto refusal = [](const std::string& text) -> std::string {
        try {
            keys_from(text, "k.json");
        } catch (const Error& error) {
            return error.what();
        }
        return "read";
    };
    const auto with = [&](const std::string& keys) {
        return refusal(R"({"format":"isochron keys","version":1,"keys":)" + keys + "}");
    };
    EXPECT_EQ(with(R"([{"time":0},{"time":2,"step":3}])"), "read");
    EXPECT_EQ(refusal("{"), "k.json: not a file of keys: no JSON");
    EXPECT_EQ(refusal("[1]"), "k.json: not a file of keys: expected \"format\": \"isochron keys\"");
    EXPECT_EQ(refusal(R"({"format":"isochron keys","version":2,"keys":[]})"),
              "k.json: version: expected an integer from 0 to 1, got 2");
    EXPECT_EQ(with("[]"), "k.json: keys: expected a list of 1 to 128, got []");
    EXPECT_EQ(with(R"([{"time":0},{"hold":1}])"), "k.json: key 2: keys: \"time\" is missing");
    EXPECT_EQ(with(R"([{"time":-1}])"),
              "k.json: key 1: time: expected a number from 0 to 3600, got -1");
    EXPECT_EQ(with(R"([{"time":1,"hold":2},{"time":2}])"),
              "k.json: key 2: time: expected more than 3 s, the end of the rest at the key before, "
              "got 2");
    EXPECT_EQ(with(R"([{"time":3000,"hold":900}])"),
              "k.json: key 1: hold: expected an end at 3600 s or before, got 3900");
    EXPECT_EQ(with(R"([{"time":0,"pace":"fast"}])"),
              "k.json: key 1: pace: expected eased or even, got \"fast\"");
    EXPECT_EQ(with(R"([{"time":0,"stepp":1}])"), "k.json: key 1: keys: unknown key \"stepp\"");
    for (const char* known : {R"("hold":1)", R"("pace":"even")", R"("fraction":1)", R"("text":"a")",
                              R"("coloring":{"by":"value","map":"viridis","bands":2,"run":1})"})
        EXPECT_THAT(with(fmt::format(R"([{{"time":0,{},"run":1}}])", known)),
                    testing::HasSubstr("unknown key \"run\""))
            << "beside what may lack";
    EXPECT_EQ(refusal(std::string(40, '[')), "k.json: nested deeper than 16 levels");
    // Cut off anywhere, it is refused and nothing worse.
    const std::string whole = keys_text(std::vector<KeyFrame>{key_of({}, kStanding)});
    for (std::size_t size = 0; size + 2 < whole.size(); ++size)
        EXPECT_THAT(refusal(whole.substr(0, size)), testing::StartsWith("k.json: ")) << size;
}

TEST(KeyFrames, AKeyIsSeenFromWhereTheViewerStandsNow) {
    Random random(test_seed());
    Settings settings;
    settings.room_from_physical = any_view(random);
    const KeyFrame key = key_of(settings, kStanding);
    settings.keys = {key};
    EXPECT_EQ(seen_key(settings, kStanding), 0u);
    const Pose walked{{3, 1.6f, -2}, glm::angleAxis(0.7f, glm::vec3(0, 1, 0))};
    EXPECT_EQ(seen_key(settings, walked), std::nullopt);
    obey(way_to_key(key, settings, walked), settings);
    EXPECT_EQ(seen_key(settings, walked), 0u);
    // The data stand to the viewer as before.
    const auto seen = [](const Similarity& view, const Pose& head) {
        return glm::conjugate(glm::dquat(head.orientation)) *
               (transform(view, {1, 2, 3}) - glm::dvec3(head.position));
    };
    EXPECT_LT(glm::length(seen(*key.room_from_physical, kStanding) -
                          seen(settings.room_from_physical, walked)),
              1e-5);
}

} // namespace
} // namespace isochron::interaction
