// The window of an explorer that has no data to show: it lets the user choose some, or shows how
// far the data are that are being indexed.
#pragma once

#include "app/session/page_window.h"

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
    PageWindowOptions window = {};
};

/// Until the user has chosen, or dropped files onto the window.
/// @return a file, a folder or the pattern of a series; nothing: they leave
std::optional<std::filesystem::path> choose_data(const stereo::Windows& windows,
                                                 const DataChoice& choice);

/// How far the data are that are waited for.
struct DataProgress {
    bool ready = false; ///< they can be shown, or never will be
    std::string line;   ///< what is going on
    float fraction = 0;
};

/// Shows it in the first window until the data are ready.
/// @param name of the data
/// @return false: the user leaves
bool wait_for_data(const stereo::Windows& windows, const std::string& name,
                   const std::function<DataProgress()>& progress, PageWindowOptions options);

} // namespace isochron::app
