// Accepts or refuses a tracker's samples.
#include "interaction/trackers/pose_filter.h"

#include <cmath>

namespace isochron::interaction {
namespace {

/// Tolerance of a quaternion's length; trackers send few decimals.
constexpr float kNearlyUnit = 0.02f;
/// [m] no room is larger; the limit keeps garbage from breaking the arithmetic that follows.
constexpr float kFarthest = 1e4f;

} // namespace

bool is_pose(const Pose& pose) {
    return is_finite(pose) && std::abs(glm::length(pose.orientation) - 1) <= kNearlyUnit &&
           glm::length(pose.position) <= kFarthest;
}

bool PoseFilter::plausible(const PoseSample& from, const PoseSample& to) const {
    const double elapsed = (to.time - from.time).count();
    const double distance = glm::length(glm::dvec3(to.pose.position - from.pose.position));
    const double angle = glm::length(rotation_between(from.pose.orientation, to.pose.orientation));
    return distance <= limits_.slack + limits_.fastest * elapsed &&
           angle <= limits_.slack_turn + limits_.fastest_turn * elapsed;
}

PoseFilter::Verdict PoseFilter::accept(const PoseSample& sample) {
    last_ = sample;
    jump_.reset();
    ++counts_.accepted;
    return Verdict::accepted;
}

bool PoseFilter::continues_jump(const PoseSample& sample) const {
    // A jump ends when no sample continues it for `held_after`.
    return jump_ && plausible(jump_->newest, sample) &&
           sample.time - jump_->newest.time <= limits_.held_after;
}

PoseFilter::Verdict PoseFilter::jump(const PoseSample& sample, Seconds since) {
    if (sample.time - since < limits_.accept_jump) {
        jump_ = Jump{since, sample};
        ++counts_.jumped;
        return Verdict::refused;
    }
    ++counts_.moved_on;
    accept(sample);
    return Verdict::moved_on;
}

PoseFilter::Verdict PoseFilter::add(PoseSample sample) {
    if (!is_pose(sample.pose) || !std::isfinite(sample.time.count())) {
        refuse();
        return Verdict::refused;
    }
    sample.pose.orientation = glm::normalize(sample.pose.orientation);
    if (sample.velocity && !is_finite(*sample.velocity))
        sample.velocity.reset();
    if (!last_)
        return accept(sample);
    if (sample.time < last_->time || (jump_ && sample.time < jump_->newest.time)) {
        ++counts_.late;
        return Verdict::refused;
    }
    // As time passes, the jump's place comes within reach of the last good pose. So this test is
    // first: a sample that continues a jump is part of the jump.
    if (continues_jump(sample))
        return jump(sample, jump_->since);
    return plausible(*last_, sample) ? accept(sample) : jump(sample, sample.time);
}

Tracking PoseFilter::tracking(Seconds now) const {
    if (!last_ || now - last_->time > limits_.lost_after)
        return Tracking::lost;
    return now - last_->time > limits_.held_after ? Tracking::held : Tracking::tracked;
}

} // namespace isochron::interaction
