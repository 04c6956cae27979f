// Computes vignette and fade from motion and tracking.
#include "interaction/navigation/comfort.h"

#include "interaction/navigation/navigation.h"

#include <algorithm>
#include <cmath>

namespace isochron::interaction {
namespace {

constexpr Seconds kDark{0.3}, kLeapFade{0.15}; ///< for a leap: how long, and how fast it comes
constexpr double kLongestFade = 0.1;           ///< [s] a stall must not darken the picture at once

/// `value` moved towards `wanted`, at a rate of 1 per `fade`.
double approached(double value, double wanted, double seconds, Seconds fade) {
    const double step = fade.count() > 0 ? seconds / fade.count() : 1.0;
    return std::clamp(wanted, value - step, value + step);
}

/// 0 at `from` and below, 1 at `to` and above.
double ramp(double value, double from, double to) {
    if (!(to > from))
        return value > from ? 1.0 : 0.0;
    return std::clamp((value - from) / (to - from), 0.0, 1.0);
}

} // namespace

double Comfort::wanted_vignette(const glm::dvec3& head, const Similarity& volume,
                                double seconds) const {
    // A leap, such as a reset, lasts one frame only, so the vignette hardly starts to close.
    if (!options_.vignette || seconds <= 0)
        return 0;
    const glm::dquat turn = volume.rotation * glm::conjugate(before_.rotation);
    const double angle = 2 * std::acos(std::clamp(std::abs(turn.w), 0.0, 1.0));
    // The place in the data where the head is: where it was before the volume moved, and is now.
    const glm::dvec3 now = transform(volume, in_physical(before_, head));
    const double speed = glm::length(now - head) / seconds;
    return std::max(ramp(speed, options_.vignette_speed, options_.vignette_full),
                    ramp(angle / seconds, options_.vignette_turn, options_.vignette_turn_full));
}

ComfortState Comfort::update(const InputState& input, const Similarity& volume,
                             std::uint32_t leaps_to) {
    const DeviceState* head = input.find("head");
    const double seconds =
        time_ ? std::clamp((input.time - *time_).count(), 0.0, kLongestFade) : 0.0;
    const glm::dvec3 place =
        head && head->pose && is_finite(*head->pose) ? head->pose->position : glm::vec3(0);
    const double vignette = time_ ? wanted_vignette(place, volume, seconds) : 0.0;
    const bool lost = head && head->tracking() == Tracking::lost && options_.fade_when_lost;
    state_.vignette = approached(state_.vignette, vignette, seconds, options_.vignette_fade);
    if (time_ && leaps_to > 0 && leaps_to != leapt_to_)
        dark_until_ = input.time + kDark;
    leapt_to_ = leaps_to;
    leap_ = approached(leap_, input.time < dark_until_ ? 1.0 : 0.0, seconds, kLeapFade);
    lost_ = approached(lost_, lost ? 1.0 : 0.0, seconds, options_.lost_fade);
    state_.fade = std::max(leap_, lost_);
    time_ = input.time;
    before_ = volume;
    return state_;
}

} // namespace isochron::interaction
