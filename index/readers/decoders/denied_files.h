// Finds which file the fence has denied to a library.
#pragma once

#include <filesystem>

namespace isochron::index {

/// The first file since the last call that a library wanted to read, that the user can read, and
/// that the fence hides; empty if there was none. Libraries say little of a file that they cannot
/// open; some take it for empty.
std::filesystem::path take_denied_file();

} // namespace isochron::index
