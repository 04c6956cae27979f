// Names of pictures.
#include "app/output/picture_names.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <charconv>
#include <set>
#include <string_view>

namespace isochron::app {
namespace {

constexpr std::string_view kScreenshot = "isochron_";

/// Makes suffixes from names; adds numbers where names have become equal.
class Suffixes {
  public:
    std::string next(const std::string& name) {
        const std::string wanted = fmt::format("_{}", file_name(name));
        std::string unused = wanted;
        for (int twin = 2; !taken_.insert(unused).second; ++twin)
            unused = fmt::format("{}_{}", wanted, twin);
        return unused;
    }

  private:
    std::set<std::string> taken_;
};

} // namespace

std::string file_name(std::string name) {
    for (char& c : name)
        if (!std::isalnum(static_cast<unsigned char>(c)) && c != '-' && c != '_')
            c = '_';
    return name;
}

std::string screenshot_name(int number) {
    return fmt::format("{}{:04}", kScreenshot, number);
}

int last_screenshot(const std::filesystem::path& folder) {
    int last = 0;
    std::error_code none;
    for (const auto& entry : std::filesystem::directory_iterator(folder, none)) {
        const std::string name = entry.path().filename().string();
        int number = 0;
        if (name.starts_with(kScreenshot) &&
            std::from_chars(name.data() + kScreenshot.size(), name.data() + name.size(), number)
                    .ec == std::errc())
            last = std::max(last, number);
    }
    return last;
}

PictureNames picture_names(const stereo::Installation& installation) {
    PictureNames names;
    Suffixes windows;
    for (const stereo::Window& window : installation.windows) {
        PictureNames::Window& named = names.windows.emplace_back();
        if (installation.windows.size() > 1)
            named.suffix = windows.next(window.name);
        Suffixes viewports;
        for (std::size_t i = 0; i < window.viewports.size(); ++i) {
            const std::string& name = window.viewports[i].name;
            named.viewports.push_back(
                window.viewports.size() == 1
                    ? named.suffix
                    : named.suffix +
                          viewports.next(name.empty() ? fmt::format("viewport{}", i + 1) : name));
        }
    }
    return names;
}

} // namespace isochron::app
