// Finds the user's folders from the environment.
#include "index/system/user_folders.h"

#include <cstdlib>

namespace isochron::index {
namespace {

/// @param in_home where the folder is without the variable
std::optional<std::filesystem::path> user_folder(const char* variable, const char* in_home) {
    const auto value = [](const char* name) {
        const char* text = std::getenv(name);
        return std::filesystem::path(text ? text : "");
    };
    if (const auto folder = value(variable); !folder.empty())
        return folder / "isochron";
    if (const auto home = value("HOME"); !home.empty())
        return home / in_home / "isochron";
    return std::nullopt;
}

} // namespace

std::optional<std::filesystem::path> user_state_folder() {
    return user_folder("XDG_STATE_HOME", ".local/state");
}

std::optional<std::filesystem::path> user_cache_folder() {
    return user_folder("XDG_CACHE_HOME", ".cache");
}

} // namespace isochron::index
