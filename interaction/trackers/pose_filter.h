// Accepts or refuses a tracker's samples, and tells how far the last good pose can be trusted.
//
//     PoseFilter filter({});
//     filter.add({now, pose});
//     if (filter.last() && filter.tracking(now) == Tracking::tracked)
//         use(filter.last()->pose);
#pragma once

#include "interaction/input/tracked_input.h"

namespace isochron::interaction {

/// One measured pose, in the room.
struct PoseSample {
    Seconds time; ///< session time of the measurement
    Pose pose;
    std::optional<Velocity> velocity = std::nullopt;   ///< if the device sends it
    std::optional<Seconds> device_time = std::nullopt; ///< time of measuring, by the device's clock
};

/// Whether it is finite, at most 10 km from the origin, and its quaternion nearly of unit length.
bool is_pose(const Pose& pose);

struct PoseFilterLimits {
    double fastest = 5.0;       ///< [m/s] a faster motion is a jump
    double fastest_turn = 20.0; ///< [rad/s]
    Seconds accept_jump{0.3};   ///< a jump is accepted once it has lasted this long
    Seconds held_after{0.1};    ///< a pose older than this is only held
    Seconds lost_after{1.0};    ///< a pose older than this is lost
    double slack = 0.05;        ///< [m] a shorter way is never a jump, as time stamps are inexact
    double slack_turn = 0.2;    ///< [rad]
    bool operator==(const PoseFilterLimits&) const = default;
};

/// How many samples have been refused or believed so far, and why.
struct PoseFilterCounts {
    std::uint64_t accepted = 0;
    std::uint64_t not_a_pose = 0; ///< see `is_pose`
    std::uint64_t late = 0;       ///< older than the newest accepted one
    std::uint64_t jumped = 0;     ///< implausibly far from the last good pose
    std::uint64_t moved_on = 0;   ///< jumps that lasted and were believed
};

/// Depends only on the samples and times that it was given. A sample is accepted if it is a pose
/// that can be reached from the last good one within the limits. Otherwise it starts a jump.
/// Samples that can be reached from the newest one of the jump continue it; they are refused until
/// the jump has lasted for `accept_jump`. Until then, and while no samples come, the last good pose
/// stays.
class PoseFilter {
  public:
    enum class Verdict : std::uint8_t { accepted, moved_on, refused };

    explicit PoseFilter(const PoseFilterLimits& limits) : limits_(limits) {}
    Verdict add(PoseSample sample);
    /// Counts something that came in place of a pose.
    void refuse() { ++counts_.not_a_pose; }

    /// The newest accepted sample, its orientation of unit length.
    const std::optional<PoseSample>& last() const { return last_; }
    Tracking tracking(Seconds now) const;
    const PoseFilterCounts& counts() const { return counts_; }
    const PoseFilterLimits& limits() const { return limits_; }

  private:
    bool plausible(const PoseSample& from, const PoseSample& to) const;
    Verdict accept(const PoseSample& sample);
    bool continues_jump(const PoseSample& sample) const;
    Verdict jump(const PoseSample& sample, Seconds since);

    struct Jump {
        Seconds since;
        PoseSample newest;
    };
    PoseFilterLimits limits_;
    std::optional<PoseSample> last_;
    std::optional<Jump> jump_;
    PoseFilterCounts counts_;
};

} // namespace isochron::interaction
