// Texts of files and people as fields of CSV.
#pragma once

#include <string>
#include <string_view>

namespace isochron::app {

/// As RFC 4180 has it: one line, between quotes where it has to be. A text that a spreadsheet would
/// take for a formula gets a `'` in front, which it does not show.
/// @param keep_formulas leaves such a text as it is
std::string csv_field(std::string_view text, bool keep_formulas = false);

} // namespace isochron::app
