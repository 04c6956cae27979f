// The window for choosing data to open: recent data, and folders.
#pragma once

#include "app/config/series_names.h"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace isochron::app {

class FileWindow {
  public:
    /// Opens the window. @param recent recently opened data, newest first; it begins in the folder
    /// of the first one
    void open(std::vector<std::filesystem::path> recent);
    void close() { shown_ = false; }
    bool is_open() const { return shown_; }

    /// Lays the window out in the current Dear ImGui frame, in the middle of the picture.
    /// @return the data that the user has chosen, which may be the pattern of a series; then the
    /// window closes
    std::optional<std::filesystem::path> draw();

  private:
    void go_to(const std::filesystem::path& folder);
    std::optional<std::filesystem::path> draw_folder();

    bool shown_ = false;
    std::vector<std::filesystem::path> recent_;
    std::filesystem::path folder_;
    std::vector<std::string> folders_, files_; ///< sorted names in folder_
    std::vector<NamedSeries> series_;          ///< among files_
    std::string complaint_;                    ///< why folder_ cannot be listed
};

} // namespace isochron::app
