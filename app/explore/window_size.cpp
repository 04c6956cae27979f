// The size of a desktop's window, kept from one session to the next.
#include "app/explore/window_size.h"

#include "index/error.h"
#include "index/system/input_file.h"
#include "index/system/new_file.h"
#include "index/system/user_folders.h"

#include <fmt/format.h>

#include <filesystem>
#include <optional>
#include <sstream>
#include <string>

namespace isochron::app {
namespace {

constexpr int kSmallestSide = 160, kLargestSide = 16384;

std::optional<std::filesystem::path> file_of_size() {
    const auto folder = index::user_state_folder();
    return folder ? std::optional(*folder / "window") : std::nullopt;
}

} // namespace

bool may_keep_window_size(const ExploreOptions& options, const Config& config) {
    const auto& windows = config.installation.windows;
    return options.config == ExploreOptions().config && options.size.empty() && !options.emulate &&
           !config.openxr.enabled && windows.size() == 1 && !windows.front().fullscreen;
}

void recall_window_size(Config& config) {
    constexpr std::uint64_t kLongest = 64;
    const auto file = file_of_size();
    std::error_code error;
    stereo::Window& window = config.installation.windows.front();
    window.sized = stereo::SizeOnDesktop::scaled;
    if (!file || !std::filesystem::is_regular_file(*file, error))
        return;
    try {
        std::istringstream text(index::read_text(*file, kLongest));
        glm::ivec2 size(0);
        text >> size.x >> size.y;
        if (text && size.x >= kSmallestSide && size.y >= kSmallestSide && size.x <= kLargestSide &&
            size.y <= kLargestSide) {
            window.size = size;
            window.sized = stereo::SizeOnDesktop::fitting;
        }
    } catch (const index::Error&) { // then the configuration says how large it is
    }
}

void remember_window_size(const glm::ivec2& size) {
    const auto path = file_of_size();
    if (!path || size.x < kSmallestSide || size.y < kSmallestSide)
        return;
    try {
        index::make_folder(path->parent_path());
        const std::string text = fmt::format("{} {}\n", size.x, size.y);
        index::write_file(*path, text);
    } catch (const index::Error&) { // then it is not remembered
    }
}

} // namespace isochron::app
