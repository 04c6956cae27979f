// Natural order of names: digits compare as numbers, so `t2` comes before `t10`.
#pragma once

#include <string_view>

namespace isochron::index {

/// A strict weak order that tells any two different names apart.
bool natural_less(std::string_view a, std::string_view b);

} // namespace isochron::index
