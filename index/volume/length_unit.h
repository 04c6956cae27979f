// Units of length, so that files say coordinates in the unit that another program expects.
#pragma once

#include <optional>
#include <string_view>

namespace isochron::index {

/// The meters in a unit of length: `m`, `km`, `cm`, `mm`, `um`, `nm`, `in`, `ft`, or one of their
/// English names in any case. @return empty if the unit is not known
std::optional<double> meters_in(std::string_view unit);

} // namespace isochron::index
