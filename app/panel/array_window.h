// The window for choosing one of the arrays of the data.
#pragma once

#include "app/panel/panel_model.h"
#include "app/panel/parts/panel_layout.h"

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace isochron::app {

/// The words around the lines.
struct ArrayQuestion {
    std::string question;
    const char* values; ///< above the ranges of values
    const char* button;
};

class ArrayWindow {
  public:
    /// Lays the window out in the current Dear ImGui frame, in the middle of the picture. A double
    /// click on a line, Enter or the button chooses the line's array.
    /// @param first number of the line that is chosen at the beginning
    /// @return number of the array that the user has chosen
    std::optional<std::size_t> draw(const ArrayQuestion& words,
                                    const std::vector<ListedArray>& arrays, std::size_t first);
    /// Draws the list on a panel in the room, which it covers: a line is chosen by one press.
    /// @param left set when the user leaves it without a choice
    std::optional<std::size_t> draw_in_room(const PanelBox& place,
                                            const std::vector<ListedArray>& arrays,
                                            std::size_t first, bool& left);
    void begin_anew() { chosen_.reset(); } ///< the next layout is the first one

  private:
    bool draw_lines(const std::vector<ListedArray>& arrays, const char* values, bool moved);

    std::optional<std::size_t> chosen_; ///< line; empty: not laid out yet
};

} // namespace isochron::app
