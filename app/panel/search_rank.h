// Ranks the lines of the search by the words that they share with what the user typed.
#pragma once

#include "app/panel/search_table.h"

#include <optional>
#include <span>
#include <string_view>
#include <vector>

namespace isochron::app {

/// The lines that were found, best first.
struct Ranking {
    std::vector<const SearchLine*> lines;
    std::optional<double> number; ///< that the text holds: `opacity 40`
    /// No line has all that was typed: these are the nearest three, by words and by letters, and the
    /// help.
    bool only_near = false;
};

/// Ranks lines by the share of the typed words that each of them has in its words or other names: a
/// rare word counts more than a frequent one. Words match in any order and case, from their beginning
/// on (`transp`), in the plural, in British spelling and, if they have more than four letters, with
/// one letter wrong, missing, added or exchanged with its neighbor. A word that means the same in another
/// program (`fiducial`, a mark) counts nearly as much.
/// @param lines of `search_lines`; they outlive the result
/// @param text without any word, all lines are found
Ranking ranked(std::span<const SearchLine> lines, std::string_view text);

} // namespace isochron::app
