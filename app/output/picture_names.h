// Names of the pictures of a frame: which window, which viewport.
#pragma once

#include "stereo/installation.h"

#include <string>
#include <vector>

namespace isochron::app {

/// A name as part of a file name: letters, digits, `-` and `_` stay, the rest becomes `_`.
std::string file_name(std::string name);

/// What the names of pictures of each window, and of each of its viewports, are told apart by:
/// `_front`, `_front_upper`. Empty where there is but one. No two are the same.
struct PictureNames {
    struct Window {
        std::string suffix;
        std::vector<std::string> viewports; ///< with the window's
    };
    std::vector<Window> windows;
};
PictureNames picture_names(const stereo::Installation& installation);

} // namespace isochron::app
