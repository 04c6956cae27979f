// Checks XML before it is parsed.
#pragma once

#include "index/system/mapped_file.h"

#include <cstddef>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <string_view>

namespace isochron::index {

/// The text of a file up to its appended data. Does not read the rest of the file.
std::string_view markup_of(const MappedFile& file);

/// Checks that the markup has its end, which a file that was cut off has lost. VTK reads such a
/// file without an error, and missing values become whatever was in memory.
/// @throws Error naming the file
void expect_end(const MappedFile& file, const std::string& name);

/// A tag of markup, `<Piece Extent="...">`, and the place where it begins.
struct Tag {
    std::size_t at;
    std::string_view text;
};
/// Calls `visit` for each tag in order, but for comments, declarations and raw text.
void for_each_tag(std::string_view markup, const std::function<void(Tag)>& visit);

/// Checks how deep elements are nested. VTK's parsers recurse for each level, and their time grows
/// with the square of the depth.
/// @throws Error naming the file when they are nested deeper than VTK itself ever writes
void expect_shallow(std::string_view markup, const std::string& file);

/// Checks that all arrays have names: VTK refuses others with a message that users cannot
/// understand.
/// @throws Error naming the file
void expect_names(std::string_view markup, const std::string& file);

/// The markup with slashes in the names of other files (`Source`, `file`), see `path_named_in`.
/// @return none where it has them already
std::optional<std::string> with_slashes(std::string_view markup, const std::filesystem::path& file);

} // namespace isochron::index
