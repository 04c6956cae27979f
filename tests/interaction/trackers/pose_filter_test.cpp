// Which samples the filter accepts: gaps, jumps, garbage, and recovery.
#include "interaction/trackers/pose_filter.h"

#include "tests/interaction/input_builders.h"
#include "tests/support/test_seed.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace isochron::interaction {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
using Verdict = PoseFilter::Verdict;

Pose at(double x, double y = 1.6, double z = 0) {
    return {glm::vec3(x, y, z), glm::quat(1, 0, 0, 0)};
}

/// A filter with a clock of 60 frames per second.
class Tracker {
  public:
    explicit Tracker(const PoseFilterLimits& limits = {}) : filter(limits) {}
    PoseFilter filter;
    Seconds now{0};

    Verdict frame(const Pose& pose) {
        now += Seconds(1.0 / 60);
        return filter.add({now, pose});
    }
    void silence(double seconds) { now += Seconds(seconds); }
    float x() const { return filter.last()->pose.position.x; }
    Tracking tracking() const { return filter.tracking(now); }
};

TEST(PoseFilter, NothingIsLostAndHasNoPose) {
    const PoseFilter filter({});
    EXPECT_FALSE(filter.last());
    EXPECT_EQ(filter.tracking(Seconds(0)), Tracking::lost);
}

TEST(PoseFilter, ASilentTrackerIsHeldThenLostAndItsPoseStands) {
    Tracker tracker;
    tracker.frame(at(1));
    EXPECT_EQ(tracker.tracking(), Tracking::tracked);
    tracker.silence(0.09);
    EXPECT_EQ(tracker.tracking(), Tracking::tracked);
    tracker.silence(0.02);
    EXPECT_EQ(tracker.tracking(), Tracking::held);
    tracker.silence(0.85);
    EXPECT_EQ(tracker.tracking(), Tracking::held);
    tracker.silence(0.1);
    EXPECT_EQ(tracker.tracking(), Tracking::lost);
    EXPECT_EQ(tracker.x(), 1);
    tracker.frame(at(1.5));
    EXPECT_EQ(tracker.tracking(), Tracking::tracked);
    EXPECT_EQ(tracker.x(), 1.5f);
}

TEST(PoseFilter, WhatIsNoPoseIsRefused) {
    Tracker tracker;
    tracker.frame(at(1));
    std::vector<Pose> garbage{at(kNan), at(1, INFINITY), at(1e9), at(1), at(1), at(1), at(1)};
    garbage[3].orientation = glm::quat(0, 0, 0, 0);
    garbage[4].orientation = glm::quat(kNan, 0, 0, 0);
    garbage[5].orientation = glm::quat(1, 1, 0, 0);
    garbage[6].orientation = glm::quat(0.9f, 0, 0, 0);
    for (const Pose& pose : garbage)
        EXPECT_EQ(tracker.frame(pose), Verdict::refused);
    EXPECT_EQ(tracker.filter.counts().not_a_pose, garbage.size());
    EXPECT_EQ(tracker.filter.last()->pose, at(1));
    EXPECT_EQ(tracker.tracking(), Tracking::held) << "garbage does not keep a pose alive";
}

TEST(PoseFilter, RoundedQuaternionsAreNormalized) {
    Tracker tracker;
    Pose pose = at(0);
    pose.orientation = glm::quat(1.01f, 0, 0, 0);
    EXPECT_EQ(tracker.frame(pose), Verdict::accepted);
    EXPECT_FLOAT_EQ(glm::length(tracker.filter.last()->pose.orientation), 1);
}

TEST(PoseFilter, AShortJumpIsNeverSeen) {
    Tracker tracker;
    for (int i = 0; i < 10; ++i)
        tracker.frame(at(0.01 * i));
    for (int i = 0; i < 10; ++i)
        EXPECT_EQ(tracker.frame(at(-2)), Verdict::refused);
    EXPECT_EQ(tracker.tracking(), Tracking::held);
    EXPECT_EQ(tracker.frame(at(0.2)), Verdict::accepted);
    EXPECT_EQ(tracker.tracking(), Tracking::tracked);
    EXPECT_EQ(tracker.filter.counts().jumped, 10u);
    EXPECT_EQ(tracker.filter.counts().moved_on, 0u);
}

/// However near: with time the old place comes into reach, and that must not shorten the wait.
TEST(PoseFilter, AJumpIsBelievedOnceItHasLasted) {
    for (const double distance : {0.25, 0.5, 2.0, 50.0}) {
        Tracker tracker;
        tracker.frame(at(0));
        const Seconds jumped = tracker.now + Seconds(1.0 / 60);
        Verdict verdict = Verdict::refused;
        for (int i = 0; i < 60 && verdict == Verdict::refused; ++i)
            verdict = tracker.frame(at(distance + 0.01 * i));
        EXPECT_EQ(verdict, Verdict::moved_on);
        EXPECT_NEAR((tracker.now - jumped).count(), 0.3, 0.018) << distance;
        EXPECT_EQ(tracker.frame(at(distance + 0.2)), Verdict::accepted);
    }
}

TEST(PoseFilter, ATurnOfTheHeadByHalfACircleWithinAFrameIsAJumpToo) {
    Tracker tracker;
    tracker.frame(at(0));
    Pose turned = at(0);
    turned.orientation = glm::quat(0, 0, 1, 0);
    EXPECT_EQ(tracker.frame(turned), Verdict::refused);
    EXPECT_EQ(tracker.frame(at(0)), Verdict::accepted);
}

TEST(PoseFilter, FlickerBetweenTwoPlacesNeverMovesOn) {
    Tracker tracker;
    for (int i = 0; i < 600; ++i)
        tracker.frame(at(i % 3 == 0 ? 0 : -3 - i % 2));
    EXPECT_EQ(tracker.x(), 0);
    EXPECT_EQ(tracker.filter.counts().moved_on, 0u);
}

TEST(PoseFilter, SamplesThatAreOlderThanTheNewestAreDropped) {
    PoseFilter filter({});
    EXPECT_EQ(filter.add({Seconds(1), at(0)}), Verdict::accepted);
    EXPECT_EQ(filter.add({Seconds(0.99), at(0.01)}), Verdict::refused);
    EXPECT_EQ(filter.counts().late, 1u);
    EXPECT_EQ(filter.last()->time, Seconds(1));
}

TEST(PoseFilter, AVelocityThatIsNotFiniteIsLeftOut) {
    PoseFilter filter({});
    filter.add({Seconds(0), at(0), Velocity{{kNan, 0, 0}, {0, 0, 0}}});
    ASSERT_TRUE(filter.last());
    EXPECT_FALSE(filter.last()->velocity);
}

/// A person walks and turns about while a third of all samples is garbage of some kind.
TEST(PoseFilter, GarbageNeverMovesTheWorld) {
    Random random(test_seed());
    for (int round = 0; round < 20; ++round) {
        Tracker tracker;
        glm::dvec3 place(0, 1.6, 0), velocity(0);
        tracker.frame(at(0));
        for (int frame = 0; frame < 2000; ++frame) {
            for (int axis = 0; axis < 3; ++axis)
                velocity[axis] += uniform(random, -0.1, 0.1) - 0.05 * velocity[axis];
            place += velocity / 60.0;
            const Pose truth{glm::vec3(place), glm::quat(1, 0, 0, 0)};
            Pose measured = truth;
            switch (random() % 12) {
            case 0: measured.position[random() % 3] = static_cast<float>(kNan); break;
            case 1: measured.position += glm::vec3(uniform(random, 1, 1e6), 0, 0); break;
            case 2: measured.orientation = glm::quat(0, 0, 0, 0); break;
            case 3: measured.orientation = random_rotation(random) * 2.0f; break;
            default: break;
            }
            tracker.frame(measured);
            const float off = glm::length(tracker.filter.last()->pose.position - truth.position);
            ASSERT_LT(off, 0.5) << "frame " << frame;
            ASSERT_TRUE(is_finite(tracker.filter.last()->pose));
        }
        EXPECT_GT(tracker.filter.counts().accepted, 1000u);
        EXPECT_GT(tracker.filter.counts().not_a_pose, 300u);
    }
}

} // namespace
} // namespace isochron::interaction
