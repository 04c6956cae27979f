// Safe reading of one frame's devices: absent devices are at rest, and no value is NaN.
#pragma once

#include "interaction/input/actions.h"
#include "interaction/input/tracked_input.h"

#include <algorithm>
#include <cmath>

namespace isochron::interaction {

/// The keys and buttons that were down in a frame; the next frame finds presses by comparison.
struct ButtonLevels {
    ActionSet keys;
    std::uint64_t gamepad = 0, wand = 0, other = 0, mouse = 0;
};

/// Points into the state that it reads, which must outlive it.
struct Reading {
    const DeviceState* head;
    const DeviceState* wand;
    const DeviceState* other; ///< `wand2`, of the other hand
    const DeviceState* mouse;
    const DeviceState* keys;
    const DeviceState* gamepad;
    const DeviceState* pointer; ///< the eye's ray through the cursor
    ButtonLevels before;        ///< buttons in the frame before

    /// @param levels of the frame before; needed by `pressed`
    explicit Reading(const InputState& input, const ButtonLevels& levels = {})
        : head(input.find("head")), wand(input.find("wand")), other(input.find("wand2")),
          mouse(input.find("mouse")), keys(input.find("keys")), gamepad(input.find("gamepad")),
          pointer(input.find("pointer")), before(levels) {}

    ButtonLevels levels() const {
        return {keys ? keys->actions : ActionSet(), buttons(gamepad), buttons(wand), buttons(other),
                buttons(mouse)};
    }

    static std::uint64_t buttons(const DeviceState* device) { return device ? device->buttons : 0; }
    static double valuator(const DeviceState* device, std::size_t index) {
        if (!device || index >= device->valuators.size() ||
            !std::isfinite(device->valuators[index]))
            return 0.0;
        return device->valuators[index];
    }
    double wand_rate(WandValuator which) const {
        return std::clamp(valuator(wand, static_cast<std::size_t>(which)), -1.0, 1.0);
    }
    double axis(GamepadAxis which) const {
        return std::clamp(valuator(gamepad, static_cast<std::size_t>(which)), -1.0, 1.0);
    }
    double drag(MouseBit which, int direction) const {
        return valuator(mouse, 2 * static_cast<std::size_t>(which) + direction);
    }
    bool key(Action action) const { return keys && holds(keys->actions, action); }
    bool pad(GamepadButton which) const { return (buttons(gamepad) & bit(which)) != 0; }
    bool wand_button(WandButton which) const { return (buttons(wand) & bit(which)) != 0; }
    // A button is pressed in the frame in which it goes down.
    bool pressed(Action action) const { return key(action) && !holds(before.keys, action); }
    bool pressed(GamepadButton which) const { return pad(which) && !(before.gamepad & bit(which)); }
    bool pressed(WandButton which) const {
        return wand_button(which) && !(before.wand & bit(which));
    }

    /// The pose of a hand while it is tracked; none for a pose that is only held.
    static std::optional<Pose> hand(const DeviceState* device) {
        return device && device->pose && device->pose_valid && is_finite(*device->pose)
                   ? device->pose
                   : std::nullopt;
    }
    /// The ray that picks: the eye's ray through the cursor, or else the wand's.
    std::optional<Pose> picking_ray() const {
        const auto eye = hand(pointer);
        return eye ? eye : hand(wand);
    }
    /// The head's pose, tracked or held; without one, standing at the room's origin.
    Pose viewer() const {
        return head && head->pose ? *head->pose : Pose{{0.0f, 1.6f, 0.0f}, {1.0f, 0, 0, 0}};
    }
};

} // namespace isochron::interaction
