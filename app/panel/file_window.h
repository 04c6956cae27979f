// Chooses data to open: those that were open lately, and what lies in the folders.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace isochron::app {

class FileWindow {
  public:
    /// Opens the window. @param recent the newest first; its folder is the first to be shown
    void open(std::vector<std::filesystem::path> recent);
    void close() { shown_ = false; }
    bool is_open() const { return shown_; }

    /// Lays it out in the current Dear ImGui frame, in the middle of the picture.
    /// @return the index that the user has chosen, with which the window closes
    std::optional<std::filesystem::path> draw();

  private:
    void go_to(const std::filesystem::path& folder);
    std::optional<std::filesystem::path> draw_folder();

    bool shown_ = false;
    std::vector<std::filesystem::path> recent_;
    std::filesystem::path folder_;
    std::vector<std::string> folders_, files_; ///< in it: names, in order
    std::string complaint_;                    ///< why it cannot be listed
};

} // namespace isochron::app
