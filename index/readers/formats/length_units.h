// Units of length as files write them, and axes with units of their own.
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace isochron::index {

/// Meters in a unit, by its name or sign (`um`, `µm`, `micron`, `micrometers`); none: unknown.
std::optional<double> meters_in(std::string_view unit);

/// The sign that is shown for a unit: `um` of `microns`; others as they are, none of `pixel`.
std::string tidy_length_unit(const std::string& unit);

} // namespace isochron::index
