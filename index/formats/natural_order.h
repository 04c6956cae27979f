// Numbers in names: digits compare as numbers, so `t2` comes before `t10`.
#pragma once

#include <optional>
#include <string_view>

namespace isochron::index {

/// A strict weak order that tells any two different names apart.
bool natural_less(std::string_view a, std::string_view b);

/// `0030` of `run2_t_0030`, `0.25` of `t_0.25s`; none where there is no number.
std::optional<double> last_number_in(std::string_view text);

} // namespace isochron::index
