// What the panel gives to the desktop: a text for the clipboard, and a folder to open.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

namespace isochron::app {

struct DesktopWish {
    std::string text;             ///< for the clipboard; empty: none
    std::filesystem::path folder; ///< to open; empty: none
};

/// The file or folder that a message names with its whole path: what begins with ` /`, up to `: ` or
/// ` and `. Nothing: it names none.
std::optional<std::filesystem::path> path_in(std::string_view message);

/// Whether this desktop can open folders: xdg-open is installed.
bool can_open_folders();
/// Lets the desktop open a folder; returns at once, whatever comes of it.
void open_folder(const std::filesystem::path& folder);

} // namespace isochron::app
