// Names of pictures: which screenshot, which window, which viewport.
#pragma once

#include "stereo/installation.h"

#include <filesystem>
#include <string>
#include <vector>

namespace isochron::app {

/// Makes a name usable as part of a file name: letters, digits, `-` and `_` stay, all else becomes
/// `_`.
std::string file_name(std::string name);

/// `isochron_0001` for the first screenshot in a folder.
std::string screenshot_name(int number);
/// The highest number of the screenshots in a folder; 0 where there are none, or no folder.
int last_screenshot(const std::filesystem::path& folder);

/// What the names of pictures of each window, and of each of its viewports, are told apart by:
/// `_front`, `_front_upper`. Empty where there is but one. No two are the same.
struct PictureNames {
    struct Window {
        std::string suffix;
        std::vector<std::string> viewports; ///< beginning with the window's suffix
    };
    std::vector<Window> windows;
};
PictureNames picture_names(const stereo::Installation& installation);

} // namespace isochron::app
