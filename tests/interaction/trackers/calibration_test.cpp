// Calibration, compared with poses that were computed by hand.
#include "interaction/trackers/calibration.h"

#include "tests/interaction/controls/control_desk.h"
#include "tests/support/test_seed.h"

#include <cmath>
#include <limits>

namespace isochron::interaction {
namespace {

constexpr float kQuarter = 1.57079633f;

void expect_pose(const Pose& pose, const glm::dvec3& position, const glm::dvec3& ahead,
                 const glm::dvec3& up) {
    expect_near(pose.position, position, 1e-5);
    expect_near(pose.orientation * glm::vec3(0, 0, -1), ahead, 1e-5);
    expect_near(pose.orientation * glm::vec3(0, 1, 0), up, 1e-5);
}

TEST(Calibration, WithoutAnyNothingChanges) {
    const Pose pose{{1, 2, 3}, glm::quat(0, 1, 0, 0)};
    EXPECT_EQ(calibrated({}, pose), pose);
}

/// A tracker with +Z up and +Y towards the front wall, its origin 2 m behind the room's and 10 cm
/// above the floor. Its head target is aligned with the tracker's axes while the viewer looks
/// ahead.
TEST(Calibration, ATrackerWithZUpLandsInTheRoom) {
    Calibration calibration;
    calibration.room_from_tracker = {{0, 0.1f, 2}, rotation_from_angles({0, -kQuarter, 0})};
    calibration.sensor_from_thing = {{0, 0, 0}, rotation_from_angles({0, kQuarter, 0})};
    // 0.5 m to the right, 3 m to the front, 1.7 m up.
    const Pose ahead{{0.5f, 3, 1.7f}, glm::quat(1, 0, 0, 0)};
    expect_pose(calibrated(calibration, ahead), {0.5, 1.8, -1}, {0, 0, -1}, {0, 1, 0});
    // Looking to the left: by a quarter about the tracker's up.
    const Pose left{{0.5f, 3, 1.7f}, glm::angleAxis(kQuarter, glm::vec3(0, 0, 1))};
    expect_pose(calibrated(calibration, left), {0.5, 1.8, -1}, {-1, 0, 0}, {0, 1, 0});
}

/// Glasses whose target sits 3 cm above and 8 cm ahead of the point between the eyes.
TEST(Calibration, TheEyesAreBehindAndBelowTheTarget) {
    Calibration calibration;
    calibration.sensor_from_thing.position = {0, -0.03f, 0.08f};
    expect_pose(calibrated(calibration, {{0, 1.7f, 0}, glm::quat(1, 0, 0, 0)}), {0, 1.67, 0.08},
                {0, 0, -1}, {0, 1, 0});
    // Turned to the right, the eyes are to the left of the target.
    expect_pose(calibrated(calibration, {{0, 1.7f, 0}, rotation_from_angles({-kQuarter, 0, 0})}),
                {-0.08, 1.67, 0}, {1, 0, 0}, {0, 1, 0});
}

TEST(Calibration, ScaleIsOfTheTrackersOwnLengthsOnly) {
    Calibration calibration;
    calibration.scale = 0.0254;
    calibration.room_from_tracker.position = {1, 0, 0};
    calibration.sensor_from_thing.position = {0, 0, 0.1f};
    expect_pose(calibrated(calibration, {{100, 0, 0}, glm::quat(1, 0, 0, 0)}), {3.54, 0, 0.1},
                {0, 0, -1}, {0, 1, 0});
}

TEST(Calibration, AnglesTurnToTheLeftUpAndCounterClockwise) {
    expect_near(rotation_from_angles({kQuarter, 0, 0}) * glm::vec3(0, 0, -1), {-1, 0, 0}, 1e-6);
    expect_near(rotation_from_angles({0, kQuarter, 0}) * glm::vec3(0, 0, -1), {0, 1, 0}, 1e-6);
    expect_near(rotation_from_angles({0, 0, kQuarter}) * glm::vec3(1, 0, 0), {0, 1, 0}, 1e-6);
    // Pitch comes before heading, as of a head on a neck.
    expect_near(rotation_from_angles({kQuarter, kQuarter, 0}) * glm::vec3(0, 0, -1), {0, 1, 0},
                1e-6);
}

/// Velocities are checked against the difference of two calibrated poses.
TEST(Calibration, VelocitiesAreThoseOfTheThing) {
    Random random(test_seed());
    for (int round = 0; round < 100; ++round) {
        const auto direction = [&] {
            return glm::dvec3(uniform(random, -1, 1), uniform(random, -1, 1),
                              uniform(random, -1, 1));
        };
        Calibration calibration;
        calibration.room_from_tracker = {glm::vec3(direction()), random_rotation(random)};
        calibration.sensor_from_thing = {glm::vec3(direction()), random_rotation(random)};
        calibration.scale = uniform(random, 0.5, 2);
        const Pose sensor{glm::vec3(direction()), random_rotation(random)};
        const Velocity velocity{direction(), direction()};
        constexpr Seconds kMoment{1e-2};
        const Pose before = calibrated(calibration, extrapolated(sensor, velocity, -kMoment));
        const Pose after = calibrated(calibration, extrapolated(sensor, velocity, kMoment));
        const Velocity found = calibrated(calibration, calibrated(calibration, sensor), velocity);
        const double span = 2 * kMoment.count();
        expect_near(found.linear, glm::dvec3(after.position - before.position) / span, 2e-3);
        expect_near(found.angular, rotation_between(before.orientation, after.orientation) / span,
                    2e-3);
    }
}

TEST(Calibration, OnlyRotationsAreRotations) {
    Random random(test_seed());
    for (int round = 0; round < 100; ++round) {
        const glm::quat q = random_rotation(random);
        const auto found = rotation_from(glm::mat3_cast(glm::dquat(q)));
        ASSERT_TRUE(found);
        EXPECT_LT(glm::length(rotation_between(q, *found)), 1e-5);
    }
    const double nan = std::numeric_limits<double>::quiet_NaN();
    EXPECT_FALSE(rotation_from(glm::dmat3(0)));
    EXPECT_FALSE(rotation_from(glm::dmat3(1.1)));
    EXPECT_FALSE(rotation_from(glm::dmat3(-1))) << "a mirror";
    EXPECT_FALSE(rotation_from(glm::dmat3(nan)));
    EXPECT_FALSE(rotation_from(glm::dmat3(1, 0, 0, 0.3, 1, 0, 0, 0, 1))) << "sheared";
}

} // namespace
} // namespace isochron::interaction
