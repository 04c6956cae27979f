// Suggested actions for the controls of five kinds of controllers (interaction profiles).
#include "stereo/openxr/openxr_actions.h"

namespace isochron::stereo {
namespace {

using enum HandAction;
constexpr Hand kWand = Hand::wand, kOther = Hand::other;

constexpr std::string_view kSimple = "khr/simple_controller";
constexpr std::string_view kTouch = "oculus/touch_controller";
constexpr std::string_view kIndex = "valve/index_controller";
constexpr std::string_view kVive = "htc/vive_controller";
constexpr std::string_view kMixed = "microsoft/motion_controller";

constexpr std::array kBindings{
    HandBinding{kSimple, grab, kWand, "input/select/click"},
    HandBinding{kSimple, teleport, kWand, "input/menu/click"},
    HandBinding{kSimple, grab, kOther, "input/select/click"},
    HandBinding{kSimple, play, kOther, "input/menu/click"},

    HandBinding{kTouch, grab, kWand, "input/squeeze/value"},
    HandBinding{kTouch, fly, kWand, "input/trigger/value"},
    HandBinding{kTouch, fly_speed, kWand, "input/thumbstick/y"},
    HandBinding{kTouch, turn, kWand, "input/thumbstick/x"},
    HandBinding{kTouch, teleport, kWand, "input/x/click|input/a/click"},
    HandBinding{kTouch, recenter, kWand, "input/y/click|input/b/click"},
    HandBinding{kTouch, pick, kWand, "input/thumbstick/click"},
    HandBinding{kTouch, next_view, kOther, "input/thumbstick/click"},
    HandBinding{kTouch, grab, kOther, "input/squeeze/value"},
    HandBinding{kTouch, play, kOther, "input/trigger/value"},
    HandBinding{kTouch, isovalue, kOther, "input/thumbstick/y"},
    HandBinding{kTouch, step, kOther, "input/thumbstick/x"},
    HandBinding{kTouch, reverse, kOther, "input/x/click|input/a/click"},
    HandBinding{kTouch, panel, kOther, "input/y/click|input/b/click"},

    HandBinding{kIndex, grab, kWand, "input/squeeze/value"},
    HandBinding{kIndex, fly, kWand, "input/trigger/value"},
    HandBinding{kIndex, fly_speed, kWand, "input/thumbstick/y"},
    HandBinding{kIndex, turn, kWand, "input/thumbstick/x"},
    HandBinding{kIndex, teleport, kWand, "input/a/click"},
    HandBinding{kIndex, recenter, kWand, "input/b/click"},
    HandBinding{kIndex, pick, kWand, "input/thumbstick/click"},
    HandBinding{kIndex, next_view, kOther, "input/thumbstick/click"},
    HandBinding{kIndex, grab, kOther, "input/squeeze/value"},
    HandBinding{kIndex, play, kOther, "input/trigger/value"},
    HandBinding{kIndex, isovalue, kOther, "input/thumbstick/y"},
    HandBinding{kIndex, step, kOther, "input/thumbstick/x"},
    HandBinding{kIndex, reverse, kOther, "input/a/click"},
    HandBinding{kIndex, panel, kOther, "input/b/click"},

    HandBinding{kVive, grab, kWand, "input/squeeze/click"},
    HandBinding{kVive, fly, kWand, "input/trigger/click"},
    HandBinding{kVive, fly_speed, kWand, "input/trackpad/y"},
    HandBinding{kVive, turn, kWand, "input/trackpad/x"},
    HandBinding{kVive, teleport, kWand, "input/trackpad/click"},
    HandBinding{kVive, recenter, kWand, "input/menu/click"},
    HandBinding{kVive, grab, kOther, "input/squeeze/click"},
    HandBinding{kVive, play, kOther, "input/trigger/click"},
    HandBinding{kVive, isovalue, kOther, "input/trackpad/y"},
    HandBinding{kVive, step, kOther, "input/trackpad/x"},
    HandBinding{kVive, pick, kOther, "input/trackpad/click"},
    HandBinding{kVive, panel, kOther, "input/menu/click"},

    HandBinding{kMixed, grab, kWand, "input/squeeze/click"},
    HandBinding{kMixed, fly, kWand, "input/trigger/value"},
    HandBinding{kMixed, fly_speed, kWand, "input/thumbstick/y"},
    HandBinding{kMixed, turn, kWand, "input/thumbstick/x"},
    HandBinding{kMixed, teleport, kWand, "input/trackpad/click"},
    HandBinding{kMixed, recenter, kWand, "input/menu/click"},
    HandBinding{kMixed, pick, kWand, "input/thumbstick/click"},
    HandBinding{kMixed, next_view, kOther, "input/thumbstick/click"},
    HandBinding{kMixed, grab, kOther, "input/squeeze/click"},
    HandBinding{kMixed, play, kOther, "input/trigger/value"},
    HandBinding{kMixed, isovalue, kOther, "input/thumbstick/y"},
    HandBinding{kMixed, step, kOther, "input/thumbstick/x"},
    HandBinding{kMixed, reverse, kOther, "input/trackpad/click"},
    HandBinding{kMixed, panel, kOther, "input/menu/click"},
};

} // namespace

std::span<const HandBinding> hand_bindings() {
    return kBindings;
}

std::string_view path_on(const HandBinding& binding, bool left) {
    const auto bar = binding.path.find('|');
    if (bar == std::string_view::npos)
        return binding.path;
    return left ? binding.path.substr(0, bar) : binding.path.substr(bar + 1);
}

} // namespace isochron::stereo
