// Words and numbers of the settings in links.
#pragma once

#include "interaction/setting_values.h"

#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace isochron::app {

/// Settings of a link by their names, as `index::settings_of_link` gives them.
using LinkWords = std::map<std::string, std::string>;

/// @return none: it is no finite number
std::optional<double> number_of(std::string_view text);
/// The parts between separators; at least one.
std::vector<std::string_view> split(std::string_view text, char at);
/// The numbers of a list; empty if one of them is none.
std::vector<double> numbers_of(std::string_view text, char at = ',');
/// A setting; empty: it is not there.
const std::string& word_of(const LinkWords& words, const std::string& name);
/// @return none: the setting is not there, or is no finite number
std::optional<double> number_in(const LinkWords& words, const std::string& name);

/// Sets the map and its range. @param map, range names of the settings
void color_as_linked(interaction::Coloring& coloring, const LinkWords& settings,
                     const std::string& map, const std::string& range);

} // namespace isochron::app
