// Decides when the picture may be slow and exact.
#include "interaction/controls/motion_gate.h"

#include "interaction/controls/action_table.h"
#include "interaction/pose_history.h"

#include <algorithm>

namespace isochron::interaction {
namespace {

constexpr Seconds kWindow{0.1};     ///< window over which stillness is judged
constexpr Seconds kStandsLong{0.1}; ///< a step of playing time that stands so long is at rest
constexpr Seconds kReaction{0.020}; ///< shortest window to notice a start despite tracker noise

bool below(const Velocity& speeds, const StillnessLimits& limits, double factor) {
    return glm::length(speeds.linear) <= factor * limits.linear &&
           glm::length(speeds.angular) <= factor * limits.angular;
}

bool is_pending(const DeviceState& device) {
    return device.buttons != 0 || (device.actions & ~quiet_actions()).any() ||
           std::ranges::any_of(device.valuators, [](float value) { return value != 0.0f; });
}

bool is_pending(const Commands& commands) {
    return commands.array || commands.isovalue || commands.isosurfaces || commands.instant ||
           commands.fraction || commands.playback || commands.room_from_physical;
}

} // namespace

const char* name_of(Pace pace) {
    return pace == Pace::settled ? "settled" : "moving";
}

struct MotionGate::State {
    StillnessLimits limits;
    PoseHistory head{kWindow, kReaction};
    bool playing = false;
    Pace automatic = Pace::moving;
    Pace pace = Pace::moving;
    std::optional<Seconds> still_since;

    bool pending(const InputState& input, const Commands& commands, Playing how) {
        if (commands.playback)
            playing = commands.playback->playing;
        return (playing && how == Playing::moves) || is_pending(commands) ||
               std::ranges::any_of(input.devices,
                                   [](const DeviceState& device) { return is_pending(device); });
    }

    void update(const InputState& input, const Commands& commands, Playing how) {
        const DeviceState* tracked = input.find("head");
        if (tracked && tracked->pose && tracked->pose_valid && is_finite(*tracked->pose))
            head.add(input.time, *tracked->pose);
        else
            head.forget();
        const bool waits = pending(input, commands, how);
        const bool by_steps = playing && how == Playing::moves_by_steps;
        if (waits) {
            automatic = Pace::moving;
            still_since.reset();
            if (by_steps) // what is on screen stands from now on
                still_since = input.time;
        } else if (automatic == Pace::settled) {
            if (!below(head.sudden(), limits, limits.leave_factor)) {
                automatic = Pace::moving;
                still_since.reset();
            }
        } else if (!below(head.steady(), limits, 1.0)) {
            still_since.reset();
        } else {
            if (!still_since)
                still_since = input.time;
            const Seconds settle = by_steps ? std::min(limits.settle, kStandsLong) : limits.settle;
            if (input.time - *still_since >= settle)
                automatic = Pace::settled;
        }
    }
};

MotionGate::MotionGate(const StillnessLimits& limits) : state_(std::make_unique<State>()) {
    state_->limits = limits;
}
MotionGate::~MotionGate() = default;

Pace MotionGate::update(const InputState& input, const Commands& commands, QualityMode mode,
                        Playing playing) {
    state_->update(input, commands, playing);
    switch (mode) {
    case QualityMode::automatic:
    case QualityMode::paper: state_->pace = state_->automatic; break;
    case QualityMode::fast: state_->pace = Pace::moving; break;
    case QualityMode::quality: state_->pace = Pace::settled; break;
    }
    return state_->pace;
}

Pace MotionGate::pace() const {
    return state_->pace;
}

} // namespace isochron::interaction
