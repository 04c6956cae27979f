// The recent poses of a device, and its velocity estimated from them.
#include "interaction/pose_history.h"

#include <algorithm>

namespace isochron::interaction {

void PoseHistory::add(Seconds time, const Pose& pose) {
    if (!samples_.empty() && time <= samples_.back().time)
        samples_.pop_back();
    samples_.push_back({time, pose});
    while (samples_.size() > 2 && time - samples_[0].time > window_)
        samples_.pop_front();
}

bool PoseHistory::too_short() const {
    return samples_.empty() || samples_.back().time - samples_.front().time < shortest_;
}

Velocity PoseHistory::steady() const {
    if (too_short())
        return {};
    const Sample& first = samples_.front();
    const auto count = static_cast<double>(samples_.size());
    double mean_time = 0;
    for (const Sample& sample : samples_)
        mean_time += (sample.time - first.time).count() / count;
    double spread = 0;
    Velocity slope;
    for (const Sample& sample : samples_) {
        const double t = (sample.time - first.time).count() - mean_time;
        spread += t * t;
        slope.linear += t * glm::dvec3(sample.pose.position - first.pose.position);
        slope.angular += t * rotation_between(first.pose.orientation, sample.pose.orientation);
    }
    return {slope.linear / spread, slope.angular / spread};
}

Velocity PoseHistory::sudden() const {
    if (too_short())
        return {};
    const Sample& last = samples_.back();
    const auto base = std::find_if(samples_.rbegin(), samples_.rend(), [&](const Sample& s) {
        return last.time - s.time >= shortest_;
    });
    const double elapsed = (last.time - base->time).count();
    return {glm::dvec3(last.pose.position - base->pose.position) / elapsed,
            rotation_between(base->pose.orientation, last.pose.orientation) / elapsed};
}

} // namespace isochron::interaction
