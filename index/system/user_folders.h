// The user's folders, as the XDG Base Directory Specification 0.8 names them.
#pragma once

#include <filesystem>
#include <optional>

namespace isochron::index {

/// For what the program remembers between runs: $XDG_STATE_HOME/isochron, else
/// ~/.local/state/isochron. Empty if there is no home folder.
std::optional<std::filesystem::path> user_state_folder();
/// For files that can be made again: $XDG_CACHE_HOME/isochron, else ~/.cache/isochron. Empty if
/// there is no home folder.
std::optional<std::filesystem::path> user_cache_folder();

} // namespace isochron::index
