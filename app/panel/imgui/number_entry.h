// Characters that the user types into the panel's fields, most of which hold one number.
#pragma once

#include "interaction/input/window_event.h"

#include <cstddef>
#include <string>

namespace isochron::app {

/// A field for words, which NumberEntry leaves as they are. It has the width of the next item.
/// @param hint shown while it is empty @return whether the words have changed
bool text_field(const char* id, const char* hint, std::string& words);
/// A field for a text that counts only when it is finished, such as a name. On the panel in the
/// room, keys on the panel take the place of the keyboard.
/// @return whether the user has finished another text
bool finished_text(const char* id, const char* hint, std::string& words);

/// A field of several lines for words. @param width, height panel pixels @param most bytes that it takes
/// @return whether the words have changed
bool text_area(const char* id, std::string& words, float width, float height, std::size_t most);

/// Passes typed characters to the field of ImGui that has the keyboard. A comma is a decimal point
/// there: ImGui would leave it out, and 1,5 would become 15. A second point or comma, or one in a
/// whole number, may be meant to part thousands: then the field gets back the number that it had
/// when the user began, and what is typed on is left out until the user edits or ends the entry.
/// Works on ImGui's current context.
class NumberEntry {
  public:
    void type(char32_t character);
    /// Notices the keys with which the user edits or ends an entry.
    void press(interaction::Key key);
    /// Hands the characters over to ImGui, whose next frame takes them.
    void flush();
    /// Why characters were refused since the last call, for the user; empty: none were.
    std::string take_complaint();

  private:
    std::u32string waiting_; ///< for ImGui's next frame
    unsigned refused_ = 0;   ///< the field whose entry was refused, until it is edited
    std::string complaint_;
};

} // namespace isochron::app
