// Checks and changes XML before VTK reads it.
#pragma once

#include <limits>
#include <optional>
#include <string>
#include <string_view>

namespace isochron::index {

/// Checks the depth of elements, since VTK's parsers recurse into them, after taking quadratic
/// time.
/// @throws Error naming the file when elements are nested deeper than in any VTK file
void expect_shallow(std::string_view markup, const std::string& file);

/// Checks that all arrays have names: VTK refuses others with a message that users cannot
/// understand.
/// @throws Error naming the file
void expect_names(std::string_view markup, const std::string& file);

/// Whether a text has numbers that VTK 9.1 reads wrongly: it reads `-inf` as `inf`, and does not
/// know `Infinity`.
bool holds_hard_infinities(std::string_view text);

/// The lowest f32, which replaces -inf while VTK reads the values.
inline constexpr float kLowest = std::numeric_limits<float>::lowest();

/// The same text with these numbers replaced by `inf` and `kLowest`.
/// @return none when it has `kLowest` itself, which could not be told from -inf after VTK
std::optional<std::string> with_easy_infinities(std::string_view text);

} // namespace isochron::index
