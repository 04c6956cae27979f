// Decides whether the wand's buttons and stick belong to the panel or to the world.
#include "interaction/controls/panel_pointer.h"

namespace isochron::interaction {
namespace {

constexpr const char* kWand = "wand";
constexpr const char* kMouse = "mouse"; ///< its wheel scrolls the panel where the wand points

/// The panel never takes the button that shows and hides it, wherever the wand points.
constexpr std::uint64_t kTakeable = ~bit(WandButton::room_panel);

} // namespace

void PanelPointer::update(const InputState& input, const TouchedPanel& touched) {
    const Reading now(input, before_);
    before_ = now.levels();
    const std::uint64_t buttons = Reading::buttons(now.wand), before = now.before.wand;
    taken_ &= buttons;
    carried_.reset();
    const auto hand = Reading::hand(now.wand);
    const bool dragging = touch_.pressed && (taken_ & bit(WandButton::grab)) != 0;
    const bool holds_world = ((buttons & before) & ~taken_) != 0;
    if (!touched.panel.shown) {
        touch_ = {}; // buttons stay taken, or the world would see them pressed
    } else if (hand) {
        touch_.hit = hit_of(*hand, touched.panel.pose, touched.size);
        if (!dragging && (holds_world || !touch_.hit || !touch_.hit->inside()))
            touch_.hit.reset();
    } else if (!dragging) { // in a gap of tracking a drag goes on, and no new one begins
        touch_.hit.reset();
    }
    if (hand && touch_.hit && touch_.hit->inside())
        taken_ |= buttons & ~before & kTakeable;

    const bool pressed = touched.panel.shown && (taken_ & bit(WandButton::grab)) != 0;
    if (!pressed)
        grip_.reset();
    else if (!touch_.pressed && touch_.hit && touch_.hit->at.y < touched.title)
        grip_ = Grip{touch_.hit->at, touch_.hit->distance};
    touch_.pressed = pressed;
    if (grip_ && hand) {
        // The gripped place stays on the ray, at its distance. The panel's turn depends on its
        // position and its position on its turn: a few iterations settle both.
        const glm::vec3 held =
            hand->position + hand->orientation * glm::vec3(0.0f, 0.0f, -grip_->distance);
        Pose pose = touched.panel.pose;
        for (int round = 0; round < 4; ++round)
            pose = facing(held - (place_on(pose, touched.size, grip_->at) - pose.position),
                          touched.eyes);
        carried_ = pose;
    }

    const double stick = std::clamp(
        now.wand_rate(WandValuator::scale) + now.wand_rate(WandValuator::fly), -1.0, 1.0);
    bool pushed = false;
    for (std::size_t i = 0; now.wand && i < now.wand->valuators.size(); ++i)
        pushed = pushed || Reading::valuator(now.wand, i) != 0.0;
    stick_in_world_ = pushed && (stick_in_world_ || !touch_.hit);
    takes_stick_ = touch_.hit.has_value() && !stick_in_world_;
    touch_.scroll = takes_stick_ ? stick : 0.0;
    touch_.notches = touch_.hit ? Reading::valuator(now.mouse, kMouseWheel) : 0.0;
}

InputState PanelPointer::rest_of(InputState input) const {
    for (DeviceState& device : input.devices)
        if (device.name == kWand) {
            device.buttons &= ~taken_;
            if (takes_stick_)
                std::ranges::fill(device.valuators, 0.0f);
        } else if (device.name == kMouse && touch_.hit && device.valuators.size() > kMouseWheel) {
            device.valuators[kMouseWheel] = 0.0f;
        }
    return input;
}

} // namespace isochron::interaction
