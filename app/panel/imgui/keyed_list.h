// Keys that go through an open list of the panel.
#pragma once

#include <cstddef>

namespace isochron::app {

/// Up and Down go from line to line of the popup that is being laid out, and Enter chooses one.
///
///     const KeyedList keys(shown, words.size());
///     for (std::size_t i = 0; i < words.size(); ++i)
///         if (keys.line(i, ImGui::Selectable(words[i], keys.at(i))))
///             shown = i;
class KeyedList {
  public:
    /// @param here number of the line where it begins
    KeyedList(std::size_t here, std::size_t lines);
    bool at(std::size_t line) const { return line == at_; }
    /// Called right after a line was laid out, which is scrolled to if the keys have gone there.
    /// @param clicked with the mouse @return whether it is chosen; then the popup closes
    bool line(std::size_t line, bool clicked) const;

  private:
    std::size_t at_ = 0;
    bool moved_ = false, chosen_ = false;
};

} // namespace isochron::app
