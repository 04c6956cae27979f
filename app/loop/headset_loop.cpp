// A headset's part in the live loop.
#include "app/loop/headset_loop.h"

#include "app/telling.h"
#include "interaction/input/composite_input.h"

#include <fmt/format.h>

namespace isochron::app {
namespace {

const char* in_words(stereo::HeadsetState state) {
    switch (state) {
    case stereo::HeadsetState::absent: return "not there, looking for it";
    case stereo::HeadsetState::idle: return "waiting until it wants pictures";
    case stereo::HeadsetState::running: return "running";
    case stereo::HeadsetState::ended: return "ended by its user";
    }
    return "";
}

} // namespace

void HeadsetLoop::tell_changes() {
    std::string now = fmt::format("headset {}: {}", in_words(state_), headset_->description());
    if (now != told_)
        print_note("{}", now);
    told_ = std::move(now);
}

void HeadsetLoop::begin_frame(interaction::Seconds now) {
    if (!headset_)
        return;
    state_ = headset_->update(now);
    tell_changes();
    const auto frame = headset_->begin_frame(now);
    period_ = frame ? std::optional(frame->period) : std::nullopt;
}

interaction::InputState HeadsetLoop::with_devices(interaction::InputState others,
                                                  interaction::Seconds now) {
    if (!headset_)
        return others;
    const interaction::InputState mine = headset_->poll(now);
    feel(haptics_.update(mine));
    return interaction::merged(mine, others);
}

void HeadsetLoop::feel(const std::vector<interaction::HapticPulse>& pulses) {
    for (const interaction::HapticPulse& pulse : pulses)
        if (headset_)
            headset_->vibrate(pulse.hand, interaction::Seconds(pulse.seconds), pulse.amplitude);
}

void HeadsetLoop::leave() {
    if (headset_)
        headset_->leave();
}

std::vector<std::string> HeadsetLoop::status() const {
    return headset_ ? headset_->status() : std::vector<std::string>();
}

} // namespace isochron::app
