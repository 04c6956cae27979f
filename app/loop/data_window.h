// The window of an explorer that has no data to show yet: it lets the user choose some, or shows
// the progress of indexing.
#pragma once

#include "app/loop/page_window.h"
#include "app/panel/array_window.h"

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace isochron::app {

struct DataWindowOptions {
    std::vector<std::filesystem::path> recent; ///< the newest first
    FileWindow::Offers offers = {};            ///< beside the user's files
    /// Why data cannot be opened, in one line; empty: they can.
    std::function<std::string(const std::filesystem::path&)> why_not_open;
    PageWindowOptions window = {};
};

/// Shows the window until the user has chosen data, or dropped files onto it.
/// @return a file, a folder or the pattern of a series; empty: the user leaves
std::optional<std::filesystem::path> choose_data(const stereo::Windows& windows,
                                                 const DataWindowOptions& options);

/// The progress of data that the user waits for.
struct DataProgress {
    bool ready = false; ///< they can be shown, or never will be
    std::string line;   ///< what is going on
    float fraction = 0;
    /// Arrays of which the user is to choose one; empty: none.
    std::vector<ListedArray> arrays = {};
};

/// The choice among arrays, where the data leave one.
struct ArrayChoice {
    std::function<std::size_t()> first = [] { return std::size_t{0}; }; ///< chosen at the beginning
    std::function<void(std::size_t)> choose = [](std::size_t) {};
};

enum class Waited : std::uint8_t {
    ready,
    canceled, ///< by Escape
    left      ///< the user has closed the window, or the program ends
};
/// Shows the progress in the first window, or arrays to choose from, until the data are ready.
/// @param name of the data
Waited wait_for_data(const stereo::Windows& windows, const std::string& name,
                     const std::function<DataProgress()>& progress, PageWindowOptions options,
                     const ArrayChoice& choice = {});

} // namespace isochron::app
