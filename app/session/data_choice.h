// The window of an explorer that was started without data: it lets the user choose some.
#pragma once

#include "stereo/windows.h"

#include <glm/vec3.hpp>

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace isochron::app {

struct DataChoice {
    std::vector<std::filesystem::path> recent; ///< the newest first
    /// What keeps data from being opened, in one line; empty: nothing does.
    std::function<std::string(const std::filesystem::path&)> why_not_open;
    std::function<bool()> ended;  ///< asked in each frame: nobody chooses any more
    glm::vec3 background{0.0f};   ///< sRGB
    double frame_rate_limit = 60; ///< [Hz]
    float font_scale = 1;         ///< times what the desktop asks for
};

/// Until the user has chosen, or dropped a file onto the window.
/// @return nothing: they leave
std::optional<std::filesystem::path> choose_data(const stereo::Windows& windows,
                                                 const DataChoice& choice);

} // namespace isochron::app
