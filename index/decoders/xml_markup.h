// Checks and changes XML before VTK reads it.
#pragma once

#include "index/system/mapped_file.h"

#include <limits>
#include <optional>
#include <string>
#include <string_view>

namespace isochron::index {

/// The text of a file up to its appended data, which the mapping gives without reading the rest.
std::string_view markup_of(const MappedFile& file);

/// Of appended values that end too early VTK leaves the rest as they were in memory. Whatever was
/// cut off, the end of the markup is gone as well.
/// @throws Error naming the file
void expect_end(const MappedFile& file, const std::string& name);

/// VTK's parsers descend into elements by recursion, and take quadratic time before.
/// @throws Error naming the file when elements are nested deeper than in any file of VTK's
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
