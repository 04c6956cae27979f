// The window for choosing one of the arrays that files have, where not all can be shown together.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace isochron::app {

/// An array as it is listed.
struct ListedArray {
    std::string name, grid, unit, values;
    std::string fault; ///< why it cannot be chosen; empty: it can
};

class ArrayWindow {
  public:
    /// Lays the window out in the current Dear ImGui frame, in the middle of the picture. A double
    /// click on a line, Enter or the button opens the line's array.
    /// @param file name of the data @param first number of the line that is chosen at the beginning
    /// @return number of the array that the user has chosen
    std::optional<std::size_t> draw(const std::string& file, const std::vector<ListedArray>& arrays,
                                    std::size_t first);

  private:
    bool draw_lines(const std::vector<ListedArray>& arrays, bool moved);

    std::optional<std::size_t> chosen_; ///< line; empty: not laid out yet
};

} // namespace isochron::app
