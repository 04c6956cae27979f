// The search of commands: the user types what they want, sees its key and value, and runs it.
#pragma once

#include "app/panel/parts/panel_layout.h"
#include "app/panel/search_rank.h"

#include <optional>
#include <string>

namespace isochron::app {

class KeySearch {
  public:
    void open();
    void close() { shown_ = false; }
    bool is_open() const { return shown_; }

    /// Lays it out in the current Dear ImGui frame: at the top of the picture or, in the room, over
    /// all of the panel, where the text is typed on keys of the panel. It closes when the user chooses
    /// a line.
    /// @param place the picture, or the panel in the room
    /// @return the line that the user chose, with the commands of the number that they typed
    std::optional<SearchLine> draw(const PanelModel& model, const PanelBox& place);

  private:
    const SearchLine* chosen_line(const Ranking& found, bool moved);
    const SearchLine* line_in_room(const Ranking& found);
    const SearchLine* over_picture(const Ranking& found, const PanelBox& picture, bool& left);
    const SearchLine* in_room(const Ranking& found, const PanelBox& place, bool& left);

    bool shown_ = false, fresh_ = false;
    std::string text_;
    int chosen_ = 0;     ///< among the lines that are found
    bool moved_ = false; ///< an arrow key has chosen it: a line that is only near needs that
};

} // namespace isochron::app
