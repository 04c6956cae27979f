// The search of commands: the user types what they want, sees its key, and runs it.
#pragma once

#include "app/panel/found_settings.h"
#include "app/panel/parts/panel_layout.h"
#include "interaction/input/actions.h"

#include <cstddef>
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
    bool in_room = true; ///< a hand in the room can have it, too
};
/// The events of someone who presses its key and lets it go.
std::vector<interaction::WindowEvent> presses_of(const KeyCommand& command);

/// All that keys do at once, in the order of their table; what a key does while it is held is left
/// out.
const std::vector<KeyCommand>& key_commands();

/// The commands whose words or key have all the words of a text, upper or lower case.
std::vector<const KeyCommand*> found(std::string_view text);

class KeySearch {
  public:
    void open();
    void close() { shown_ = false; }
    bool is_open() const { return shown_; }

    /// Lays it out in the current Dear ImGui frame, at the top of the picture. It closes when the user
    /// chooses a line. @param commands get those of a setting that the user chose
    /// @return what is to be pressed for the command that the user chose
    std::vector<interaction::WindowEvent> draw(const PanelModel& model, const PanelBox& picture,
                                               interaction::Commands& commands);
    /// Draws the search on a panel in the room, which it covers: the text is typed on keys of the
    /// panel.
    /// @param place that it covers
    /// @return the command that the user chose; null: none
    const KeyCommand* draw_in_room(const PanelModel& model, const PanelBox& place,
                                   interaction::Commands& commands);

  private:
    /// A line of the search: something that a key does, or a setting.
    struct Line {
        const KeyCommand* key = nullptr;
        const FoundSetting* setting = nullptr;
        explicit operator bool() const { return key || setting; }
        const std::string& words() const { return key ? key->words : setting->words; }
        std::string name() const { return key ? key->name : std::string(); }
    };
    std::vector<Line> lines_of(const std::vector<FoundSetting>& settings, bool in_room) const;
    Line chosen_line(const std::vector<Line>& lines, bool moved);
    Line line_in_room(const std::vector<Line>& lines);

    bool shown_ = false, fresh_ = false;
    std::string text_;
    int chosen_ = 0; ///< among the lines that are found
};

} // namespace isochron::app
