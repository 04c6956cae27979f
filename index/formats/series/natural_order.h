// Natural order of names: digits compare as numbers, so `t2` comes before `t10`.
#pragma once

#include <optional>
#include <string_view>

namespace isochron::index {

/// A strict weak order; two different names are never equivalent.
bool natural_less(std::string_view a, std::string_view b);

/// The last number in a name: 30 in `run2_t_0030`, 0.25 in `t_0.25s`; none if there is no number.
std::optional<double> last_number_in(std::string_view text);

} // namespace isochron::index
