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

/// The suffixes of all windows and viewports: `_front`, `_front_upper`. All differ. An only window
/// has none, and an only viewport has its window's.
struct PictureNames {
    struct Window {
        std::string suffix;
        std::vector<std::string> viewports; ///< beginning with the window's suffix
    };
    std::vector<Window> windows;
};
PictureNames picture_names(const stereo::Installation& installation);

} // namespace isochron::app
