// The window for choosing data to open: places, a folder's contents, and the path as a text.
#pragma once

#include "app/panel/file_listing.h"
#include "render/gl/image.h"

#include <filesystem>
#include <functional>
#include <future>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace isochron::app {

class FileWindow {
  public:
    /// Opens the window with the recent data; without them, in the working folder.
    /// @param recent recently opened data, newest first
    void open(std::vector<std::filesystem::path> recent);
    /// What the window offers beside the user's files.
    struct Offers {
        /// Data to try the program with, which whoever opens them may have to make; empty: none.
        std::filesystem::path demo{};
        /// Returns what was seen last of recent data; empty: nothing is known of any.
        std::function<std::shared_future<render::Image>(const std::filesystem::path&)> picture{};
    };
    void offer(Offers offers) { offers_ = std::move(offers); }
    /// Opens it as it was when it closed.
    void open_again() { shown_ = fresh_ = true; }
    void close() { shown_ = false; }
    bool is_open() const { return shown_; }

    /// Lays the window out in the current Dear ImGui frame, in the middle of the picture. A double
    /// click on a line, or Enter, opens what the line stands for: folders open in the window.
    /// What is typed filters the lines.
    /// @return the data that the user has chosen, which may be the pattern of a series; then the
    /// window closes
    std::optional<std::filesystem::path> draw();

  private:
    void go_to(const std::filesystem::path& folder);
    void go_up();
    void show_recent();
    std::optional<std::filesystem::path> go_or_take(const std::filesystem::path& path);
    std::optional<std::filesystem::path> draw_path();
    std::optional<std::filesystem::path> draw_places();
    std::optional<std::filesystem::path> draw_lines();
    const ListedFile* draw_recent(const std::vector<const ListedFile*>& shown, bool moved);
    const ListedFile* draw_table(const std::vector<const ListedFile*>& shown, bool moved);

    bool shown_ = false;
    bool fresh_ = false;  ///< opened, or another place chosen, since the last frame
    bool all_ = false;    ///< files of all names are listed
    bool lately_ = false; ///< the recent data are listed, and no folder
    std::vector<std::filesystem::path> recent_;
    Offers offers_;
    std::map<std::filesystem::path, std::shared_future<render::Image>>
        pictures_; ///< pictures of recent data
    std::filesystem::path folder_;
    std::string path_;   ///< the text of the path
    std::string filter_; ///< words that the names of the listed lines have
    Listing listing_;
    ListOrder order_ = ListOrder::name;
    bool descending_ = false;
    int chosen_ = 0; ///< among the lines that the filter lets through
};

} // namespace isochron::app
