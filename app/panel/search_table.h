// The table of all that the search of commands can find: every key, and every control of the panel
// and its bars, with its other names, its present value, and what choosing it does.
#pragma once

#include "app/panel/panel_model.h"
#include "interaction/commands.h"
#include "interaction/input/actions.h"
#include "interaction/input/window_event.h"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace isochron::app {

/// Something that a key does. Running it presses that key, so that all that follows is as if the
/// user had pressed it.
struct KeyCommand {
    std::string words, name; ///< `play, pause`, `Space`
    interaction::Key key;
    interaction::Chord chord = interaction::Chord::none;
    /// What the key leads to; empty: something that a window does itself.
    std::optional<interaction::Action> action{};
    std::string_view found_as{}; ///< stable name of what a window does itself; else the action's
    bool in_room = true;         ///< a hand in the room can have it, too
};
/// The events of someone who presses its key and lets it go.
std::vector<interaction::WindowEvent> presses_of(const KeyCommand& command);

/// All that keys do at once, in the order of their table; what a key does while it is held is left
/// out.
const std::vector<KeyCommand>& key_commands();

/// A page beside the panel that a line of the search opens.
enum class SearchPage : std::uint8_t { none, help, statistics, messages, room };

/// What a number leads to that was typed with a line's name, such as `opacity 40`.
struct NumberEffect {
    std::string words; ///< the value, in words; or why there is no such value
    interaction::Commands commands;
};

/// One line of the search. Choosing it presses its key, applies its commands, or opens its section of
/// the panel.
struct SearchLine {
    /// Name of the control, for ever: an action's name in recordings, `opacity`, or `background=light` for
    /// a value that the control can have. Lines that set the same control in two ways share it.
    std::string name;
    std::string words;    ///< what it does
    std::string others{}; ///< other names, with commas between them
    std::string value{};  ///< the present value; empty: it has none
    std::string key{};    ///< as printed on the keyboard; empty: no key does it
    interaction::Commands commands{};
    std::function<NumberEffect(double)> with_number{}; ///< empty: it takes no number
    const KeyCommand* press = nullptr;
    std::optional<std::size_t> section{}; ///< section of the panel; kSections: the bar of the time
    SearchPage page = SearchPage::none;
    std::optional<MovieWish> movie{};
    std::optional<std::size_t> session{}; ///< number of the session that goes on
    bool in_room = true;                  ///< a hand in the room can have it, too
};

/// All lines, in the order in which an empty search lists them.
/// @param model outlives the lines
std::vector<SearchLine> search_lines(const PanelModel& model);

/// The names of controls that have other names; each must be that of a line for some data.
std::vector<std::string_view> controls_with_other_names();

} // namespace isochron::app
