// Decides when the picture may be slow and exact.
#include "interaction/motion_gate.h"

#include "interaction/actions.h"

#include <algorithm>
#include <cmath>
#include <deque>

namespace isochron::interaction {
namespace {

constexpr Seconds kWindow{0.1};     ///< over which stillness is judged
constexpr Seconds kReaction{0.020}; ///< over which a start is noticed; long against tracker noise

struct Speeds {
    double linear = 0;  ///< [m/s]
    double angular = 0; ///< [rad/s]
    bool below(const StillnessLimits& limits, double factor) const {
        return linear <= factor * limits.linear && angular <= factor * limits.angular;
    }
};

/// Rotation vector [rad] from `from` to `to`.
glm::dvec3 rotation_between(const glm::quat& from, const glm::quat& to) {
    glm::dquat turn = glm::dquat(to) * glm::conjugate(glm::dquat(from));
    if (turn.w < 0)
        turn = -turn;
    const glm::dvec3 axis(turn.x, turn.y, turn.z);
    const double sine = glm::length(axis);
    return sine > 0 ? axis * (2.0 * std::atan2(sine, turn.w) / sine) : glm::dvec3(0);
}

/// The head's recent poses and what speeds they show.
class HeadHistory {
  public:
    void add(Seconds time, const Pose& pose) {
        if (!samples_.empty() && time <= samples_.back().time)
            samples_.pop_back();
        samples_.push_back({time, pose});
        while (samples_.size() > 2 && time - samples_[0].time > kWindow)
            samples_.pop_front();
    }
    void forget() { samples_.clear(); }

    /// Slope of the least-squares line through the window: averages tracker noise away.
    Speeds steady() const {
        if (too_short())
            return {};
        const Sample& first = samples_.front();
        const auto count = static_cast<double>(samples_.size());
        double mean_time = 0;
        for (const Sample& sample : samples_)
            mean_time += (sample.time - first.time).count() / count;
        double spread = 0;
        glm::dvec3 linear(0), angular(0);
        for (const Sample& sample : samples_) {
            const double t = (sample.time - first.time).count() - mean_time;
            spread += t * t;
            linear += t * glm::dvec3(sample.pose.position - first.pose.position);
            angular += t * rotation_between(first.pose.orientation, sample.pose.orientation);
        }
        return {glm::length(linear) / spread, glm::length(angular) / spread};
    }

    /// From the newest sample that is `kReaction` old: quick, and still above the noise.
    Speeds sudden() const {
        if (too_short())
            return {};
        const Sample& last = samples_.back();
        const auto base = std::find_if(samples_.rbegin(), samples_.rend(), [&](const Sample& s) {
            return last.time - s.time >= kReaction;
        });
        const double elapsed = (last.time - base->time).count();
        return {glm::length(glm::dvec3(last.pose.position - base->pose.position)) / elapsed,
                glm::length(rotation_between(base->pose.orientation, last.pose.orientation)) /
                    elapsed};
    }

  private:
    struct Sample {
        Seconds time;
        Pose pose;
    };
    bool too_short() const {
        return samples_.empty() || samples_.back().time - samples_.front().time < kReaction;
    }
    std::deque<Sample> samples_;
};

bool is_pending(const DeviceState& device) {
    const std::uint64_t quiet = device.name == "keys" ? quiet_actions() : 0;
    return (device.buttons & ~quiet) != 0 ||
           std::ranges::any_of(device.valuators, [](float value) { return value != 0.0f; });
}

bool is_pending(const Commands& commands) {
    return commands.isovalue || commands.step || commands.playback || commands.room_from_physical;
}

} // namespace

const char* name_of(Pace pace) {
    return pace == Pace::settled ? "settled" : "moving";
}

struct MotionGate::State {
    StillnessLimits limits;
    HeadHistory head;
    bool playing = false;
    Pace automatic = Pace::moving;
    Pace pace = Pace::moving;
    std::optional<Seconds> still_since;

    bool pending(const InputState& input, const Commands& commands) {
        if (commands.playback)
            playing = commands.playback->playing;
        return playing || is_pending(commands) ||
               std::ranges::any_of(input.devices,
                                   [](const DeviceState& device) { return is_pending(device); });
    }

    void update(const InputState& input, const Commands& commands) {
        const DeviceState* tracked = input.find("head");
        if (tracked && tracked->pose && tracked->pose_valid && is_finite(*tracked->pose))
            head.add(input.time, *tracked->pose);
        else
            head.forget();
        if (pending(input, commands)) {
            automatic = Pace::moving;
            still_since.reset();
        } else if (automatic == Pace::settled) {
            if (!head.sudden().below(limits, limits.leave_factor)) {
                automatic = Pace::moving;
                still_since.reset();
            }
        } else if (!head.steady().below(limits, 1.0)) {
            still_since.reset();
        } else {
            if (!still_since)
                still_since = input.time;
            if (input.time - *still_since >= limits.settle)
                automatic = Pace::settled;
        }
    }
};

MotionGate::MotionGate(const StillnessLimits& limits) : state_(std::make_unique<State>()) {
    state_->limits = limits;
}
MotionGate::~MotionGate() = default;

Pace MotionGate::update(const InputState& input, const Commands& commands, QualityMode mode) {
    state_->update(input, commands);
    switch (mode) {
    case QualityMode::automatic: state_->pace = state_->automatic; break;
    case QualityMode::fast: state_->pace = Pace::moving; break;
    case QualityMode::quality: state_->pace = Pace::settled; break;
    }
    return state_->pace;
}

Pace MotionGate::pace() const {
    return state_->pace;
}

} // namespace isochron::interaction
