// Rows of the panel's sections: the label in a column at the left, the control beside it.
#pragma once

#include "index/volume/value_type.h"

#include <imgui.h>

#include <cstddef>
#include <optional>
#include <span>
#include <string>

namespace isochron::app {

inline constexpr float kLabelColumn = 92.0f; ///< width of the labels, panel pixels

/// Begins a row: the label, and the place and width of the control that is laid out next.
/// @param spared width at the right that the control leaves free
void row(const char* label, float spared = 0.0f);
/// A row with nothing but text, cut with dots where it is too long; a tip shows all of it.
void text_row(const char* label, const std::string& words);
/// Words no wider than `width`, cut with dots.
std::string cut_to(const std::string& words, float width);
/// Text no wider than `width`: cut with dots, and then with a tip that shows all of it.
void fitted_text(const std::string& words, float width, const ImVec4& color);

/// The values that a field goes through when it is dragged.
struct FieldRange {
    double low = 0, high = 1;
    bool logarithmic = false;
    bool bounded = true; ///< values that are typed stay in the range, too
};

/// A number: a click lets the user type it, a drag changes it. The filled part of the field shows
/// where it lies in the range. It takes the width of the next item.
/// @param format as printf has it, with one number
/// @return whether it has changed
bool number_field(const char* id, double& value, const FieldRange& range, const char* format);
bool number_field(const char* id, float& value, const FieldRange& range, const char* format);

/// A number field for a share, 0 to 1, in percent.
bool share_field(const char* id, float& share);

/// A field for a whole number between two bounds; NumberEntry knows then that it is whole, and
/// remembers the number that it had. @param low at least 0
bool whole_number_field(const char* id, int* value, int low, int high, const char* format);

/// A choice of one word among several. @param effect tip of the control
/// @param notes beside the words in the list, dim; empty: none
/// @return number of the word that the user chose
std::optional<std::size_t> choice_field(const char* id, const std::string& current,
                                        std::span<const std::string> words, const char* effect,
                                        std::span<const std::string> notes = {});

/// A box to tick. @return whether it has changed
bool tick_field(const char* id, bool& on, const char* words = "");

/// What the mouse does with a line of a list.
enum class LinePress { none, once, twice };

/// The next control stands in the same line where it has room there, else in a new one.
/// @param right end of the room, screen pixels @param width of the control @param gap before it; -1:
/// the usual one
void go_on_within(float right, float width, float gap = -1.0f);
float button_width(const char* words);
float tick_width(const char* words); ///< width of a `tick_field`

/// A line over all columns of its table: a press chooses it, a second one soon after opens it, and
/// a third one is a first one again. A press counts also in the frame in which a field of the same
/// window takes the keyboard, where ImGui's own lines miss it.
/// @param height panel pixels; 0: that of a line of text
LinePress table_line(bool chosen, float height = 0.0f);

/// The format of a number with its unit, behind words if there are any; percent signs of both are
/// escaped.
/// @param digits significant ones
std::string format_with(const std::string& unit, const std::string& words = {},
                        int digits = index::kFewestDigits);

} // namespace isochron::app
