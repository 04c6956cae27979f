// One device of a tracker: turns its samples, buttons and valuators into its state in a frame.
#include "interaction/trackers/tracked_device.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

namespace isochron::interaction {
namespace {

constexpr Seconds kShortestHistory{0.015}; ///< two samples of a tracker at 60 Hz show a velocity

/// Weight of the velocity: 1 up to half of `held_after`, falling to 0 at `held_after`, from which
/// on the last good pose itself is held.
double trust(Seconds age, const PoseFilterLimits& limits) {
    return std::clamp(2.0 - 2.0 * (age / limits.held_after), 0.0, 1.0);
}

glm::dvec3 no_faster(const glm::dvec3& velocity, double limit) {
    const double speed = glm::length(velocity);
    return speed > limit ? velocity * (limit / speed) : velocity;
}

} // namespace

TrackedDevice::TrackedDevice(DeviceOptions options)
    : options_(std::move(options)), filter_(options_.limits),
      history_(options_.prediction.smoothing, kShortestHistory) {}

void TrackedDevice::add_pose(Seconds time, const Pose& sensor, std::optional<Velocity> velocity,
                             std::optional<Seconds> device_time) {
    if (!is_pose(sensor))
        return filter_.refuse();
    PoseSample sample{time - options_.latency, sensor, std::nullopt, device_time};
    sample.pose.orientation = glm::normalize(sensor.orientation);
    sample.pose = calibrated(options_.calibration, sample.pose);
    if (velocity)
        sample.velocity = calibrated(options_.calibration, sample.pose, *velocity);
    const PoseFilter::Verdict verdict = filter_.add(sample);
    if (verdict == PoseFilter::Verdict::refused)
        return;
    if (verdict == PoseFilter::Verdict::moved_on)
        history_.forget();
    history_.add(filter_.last()->time, filter_.last()->pose);
}

void TrackedDevice::set_button(std::size_t index, bool down) {
    if (index >= kMostButtons)
        return;
    const std::uint64_t mask = std::uint64_t{1} << index;
    set_buttons(down ? buttons_ | mask : buttons_ & ~mask);
}

void TrackedDevice::set_buttons(std::uint64_t bits) {
    buttons_ = bits;
    tapped_ |= bits;
}

void TrackedDevice::set_valuator(std::size_t index, float value) {
    if (index >= kMostValuators || !std::isfinite(value))
        return;
    valuators_.resize(std::max(valuators_.size(), index + 1), 0.0f);
    valuators_[index] = value;
}

Velocity TrackedDevice::velocity() const {
    const PoseFilterLimits& limits = options_.limits;
    const Velocity told = filter_.last()->velocity.value_or(history_.steady());
    return {no_faster(told.linear, limits.fastest), no_faster(told.angular, limits.fastest_turn)};
}

void TrackedDevice::state_pose(DeviceState& state, Seconds now, Seconds display_delay) const {
    const Tracking tracking = filter_.tracking(now);
    state.pose_valid = tracking == Tracking::tracked;
    state.pose_lost = tracking == Tracking::lost;
    if (!filter_.last())
        return;
    const PoseSample& last = *filter_.last();
    state.pose = last.pose;
    state.measured = last.time;
    state.device_time = last.device_time;
    if (!state.pose_valid)
        return;
    state.velocity = velocity();
    const PredictionOptions& prediction = options_.prediction;
    if (!prediction.on)
        return;
    const Seconds age = std::max(now - last.time, Seconds(0));
    const Seconds ahead = std::min(age + display_delay, prediction.limit);
    state.pose = extrapolated(last.pose, *state.velocity, trust(age, options_.limits) * ahead);
}

std::uint64_t TrackedDevice::mapped_buttons() const {
    const std::uint64_t down = buttons_ | tapped_;
    if (options_.buttons.empty())
        return down;
    std::uint64_t bits = 0;
    for (std::size_t i = 0; i < options_.buttons.size(); ++i)
        bits |= (down >> options_.buttons[i] & 1) << i;
    return bits;
}

std::vector<float> TrackedDevice::mapped_valuators() const {
    if (options_.valuators.empty())
        return valuators_;
    std::vector<float> values;
    for (std::size_t i = 0; i < options_.valuators.size(); ++i) {
        const std::size_t from = options_.valuators[i];
        const float factor = options_.valuator_factors.empty() ? 1.0f : options_.valuator_factors[i];
        values.push_back(from < valuators_.size() ? factor * valuators_[from] : 0.0f);
    }
    return values;
}

DeviceState TrackedDevice::poll(Seconds now) {
    if (!heard_ || now - *heard_ > options_.limits.lost_after) {
        buttons_ = 0;
        std::ranges::fill(valuators_, 0.0f);
    }
    DeviceState state{options_.name, std::nullopt, true, mapped_buttons(), mapped_valuators()};
    tapped_ = 0;
    polled_ = now;
    if (options_.has_pose)
        state_pose(state, now, options_.prediction.display_delay);
    return state;
}

DeviceState TrackedDevice::latch(Seconds now) const {
    DeviceState state{.name = options_.name, .pose = std::nullopt, .valuators = {}};
    if (options_.has_pose)
        state_pose(state, now,
                   std::max(polled_ + options_.prediction.display_delay - now, Seconds(0)));
    return state;
}

std::string TrackedDevice::status() const {
    if (!options_.has_pose)
        return fmt::format("  {}: without a pose", options_.name);
    const PoseFilterCounts& c = filter_.counts();
    return fmt::format("  {}: {} poses, {} refused as none, {} late, {} jumped, {} moved on",
                       options_.name, c.accepted, c.not_a_pose, c.late, c.jumped, c.moved_on);
}

} // namespace isochron::interaction
