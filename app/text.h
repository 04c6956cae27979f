// Formats numbers and text for people.
#pragma once

#include "index/volume/volume_series.h"

#include <array>
#include <chrono>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace isochron::app {

/// `812 B`, `4.10 MiB`: three digits and a binary unit.
std::string human_bytes(double bytes);

/// `0:07`, `12:30`, `3:00:00`.
std::string human_time(std::chrono::duration<double> time);

/// A whole number in groups of three: `3,932,160`.
std::string grouped(std::uint64_t number);

/// A number without the digits that rounding left behind: `0.3`, not `0.30000000000000004`.
std::string human_number(double number);

/// A bound with its unit in four digits, rounded up, so that it still holds.
std::string upper_text(double bound, const std::string& unit);

/// `12.5 ms`, `0.0341`, `1.2e+07`: a number with its unit, short enough for a label.
/// @param digits significant ones; `SeriesInfo::digits` of an array's value
std::string with_unit(double value, const std::string& unit, int digits = index::kFewestDigits);

/// `99960.6 to 102725 Pa`: both ends in as many digits, which tell them apart to a thousandth of the range.
std::string range_text(double low, double high, const std::string& unit = {});

/// `284.84042 to 289.36212 K`: both ends exactly, in the digits that the type of the values carries.
std::string exact_range_text(double low, double high, const index::SeriesInfo& info);

/// `0.886 x 0.886 x 0.0454 m`: lengths of a box, all in as many decimals, which say the shortest one in
/// two digits and the longest one in three at least.
std::string lengths_text(const std::array<double, 3>& lengths, const std::string& unit);

/// `3.7 %`: the share of the values of all steps that are missing (NaN); empty: none is.
std::string missing_text(std::uint64_t missing, const index::SeriesInfo& info);

/// `64 x 64 x 64, 10 steps`: the vertices along each axis.
std::string grid_words(const index::SeriesInfo& info);

/// A path from the root on, without `.` and `..`.
std::string whole_path(const std::filesystem::path& path);

/// A unit with a space before it; empty if there is no unit.
std::string with_space(const std::string& unit);

/// A text in lines that fit, broken between words where it can be; line breaks of the text stay.
/// What has no room in `most` lines is cut with dots.
/// @param text UTF-8 @param fits whether a line does; one character always does
std::vector<std::string> wrapped(std::string_view text,
                                 const std::function<bool(const std::string&)>& fits,
                                 std::size_t most);
/// The number of characters of a text in UTF-8.
std::size_t characters_of(std::string_view text);

/// Whether a name has all words of a text, upper or lower case.
bool has_words(const std::string& name, std::string_view words);

/// Letters to insert, remove or replace, at least, to make one word of the other.
std::size_t edit_distance(std::string_view a, std::string_view b);

/// The word of `words` that is nearest to `word` by edit distance; empty when none is near.
std::string nearest_word(std::string_view word, const std::vector<std::string>& words);

} // namespace isochron::app
