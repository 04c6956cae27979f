// The table of all actions, one row each: name, keys, words and effect. The help of keys, the
// search of commands, the motion gate and recordings follow from the rows.
#pragma once

#include "interaction/control_context.h"
#include "interaction/input/actions.h"

#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace isochron::interaction {

/// The frame in which an action's key goes down.
struct Press {
    const ControlContext& context;
    Commands& commands;              ///< commands of the frame so far
    std::vector<std::string>& notes; ///< messages for people
};

using ActionEffect = std::function<void(const Press&)>;

inline constexpr unsigned kQuiet = 1; ///< does not change the picture of the data: no motion
/// Does something while its key is held, or with the mouse; the press alone does nothing, so the
/// search of commands leaves the action out.
inline constexpr unsigned kHeld = 2;

struct ActionRow {
    Action action;
    std::string name; ///< in recordings, so that it stays for ever
    int old_bit;      ///< in recordings of version 1; kNoOldBit: the action came later
    std::vector<KeyStroke> keys;
    unsigned traits;   ///< kQuiet, kHeld
    std::string words; ///< in the search of commands; empty: those of its line
    /// What happens when a key goes down; empty: navigation, time or another part of the controls
    /// reads the key itself.
    ActionEffect effect;
};

/// A line of the help, and the actions that it tells of.
struct KeyLine {
    std::string keys;   ///< as printed on the keyboard
    std::string effect; ///< what they do
    std::vector<ActionRow> actions;
};
/// The whole table; `control_lines` has the keys that the window itself handles. The line for Shift
/// and Ctrl themselves comes last, since other lines say what they do with other keys.
std::span<const KeyLine> key_lines();

/// The name of an action in recordings.
std::string_view name_of(Action action);
std::optional<Action> action_named(std::string_view name);
/// The action of a bit in recordings of version 1: 0 to 63 of the device `keys`, then those of
/// `more_keys`. Nothing: no action had that bit.
std::optional<Action> action_of_old_bit(int bit);

/// The drawer of curves with the values along the ruler, or closed if it shows these.
CurveDrawer profile_on_or_off(CurveDrawer curves);

/// Two ghosts in each direction of time where there are none, and else none.
Ghosts ghosts_on_or_off(Ghosts ghosts);

/// Actions that do not change the picture of the data: the motion gate ignores them.
const ActionSet& quiet_actions();

} // namespace isochron::interaction
