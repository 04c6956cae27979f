// Rows of JSON objects as CSV.
#pragma once

#include <nlohmann/json.hpp>

#include <string>
#include <vector>

namespace isochron::app {

/// As RFC 4180 has it, nothing for null. Texts are one line each, and those that a spreadsheet would
/// take for a formula get a `'` in front, which it does not show.
/// @param columns that come first, also where no row has them; the others come in the order in which
/// rows have them
/// @param keep_formulas leaves such texts as they are
std::string csv_of(const nlohmann::ordered_json& rows, std::vector<std::string> columns,
                   bool keep_formulas = false);

} // namespace isochron::app
