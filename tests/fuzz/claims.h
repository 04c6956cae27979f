// Checks that end the program when they fail, for the fuzz targets.
#pragma once

#include <cstdint>
#include <span>
#include <string_view>

namespace isochron::fuzz {

using Bytes = std::span<const std::uint8_t>;

/// Ends the program where a target's claim does not hold, in every kind of build.
void claim(bool holds, const char* what);

/// For messages of errors.
void claim_one_line(std::string_view message);

} // namespace isochron::fuzz
