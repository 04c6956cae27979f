// The window for choosing data to open.
#include "app/panel/file_window.h"

#include "app/panel/panel_words.h"
#include "app/panel/parts/theme.h"
#include "index/formats/format.h"
#include "index/lower_case.h"

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <utility>

namespace isochron::app {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMostListed = 5000; ///< most names listed of a folder

/// Whether a file, or a folder that is one volume, is one that the program reads, by its name.
bool is_readable(const std::string& name, bool folder) {
    return index::has_known_end(name, folder) ||
           (!folder && index::lower_case(name).ends_with(".isochron"));
}

} // namespace

void FileWindow::open(std::vector<fs::path> recent) {
    shown_ = true;
    recent_ = std::move(recent);
    std::error_code error;
    go_to(recent_.empty() ? fs::current_path(error) : recent_.front().parent_path());
}

void FileWindow::go_to(const fs::path& folder) {
    folder_ = folder;
    folders_.clear();
    files_.clear();
    complaint_.clear();
    std::error_code error;
    fs::directory_iterator entry(folder, fs::directory_options::skip_permission_denied, error);
    for (; !error && entry != fs::directory_iterator() &&
           folders_.size() + files_.size() < kMostListed;
         entry.increment(error)) {
        std::error_code ignored;
        const std::string name = entry->path().filename().string();
        if (name.starts_with('.'))
            continue;
        const bool holds = entry->is_directory(ignored);
        if (is_readable(name, holds) && (holds || entry->is_regular_file(ignored)))
            files_.push_back(name);
        else if (holds)
            folders_.push_back(name);
    }
    if (error)
        complaint_ = error.message();
    std::ranges::sort(folders_);
    std::ranges::sort(files_);
    series_ = series_among(files_);
    std::erase_if(series_,
                  [](const NamedSeries& each) { return each.first.ends_with(".isochron"); });
}

std::optional<fs::path> FileWindow::draw_folder() {
    std::optional<fs::path> chosen;
    fs::path next;
    text(folder_.string());
    if (folder_.has_relative_path() && ImGui::Selectable("../"))
        next = folder_.parent_path();
    for (const std::string& name : folders_)
        if (ImGui::Selectable((name + "/").c_str()))
            next = folder_ / name;
    for (const NamedSeries& series : series_) {
        const std::string line =
            fmt::format("{} to {} ({} files)", series.first, series.last, series.files);
        if (ImGui::Selectable(line.c_str()))
            chosen = pattern_in(folder_, series.pattern);
    }
    for (const std::string& name : files_)
        if (ImGui::Selectable(name.c_str()))
            chosen = folder_ / name;
    if (!complaint_.empty())
        note(complaint_, color_of(Ink::warning));
    else if (files_.empty())
        note("no data in this folder that can be read", color_of(Ink::dim));
    if (!next.empty())
        go_to(next);
    return chosen;
}

std::optional<fs::path> FileWindow::draw() {
    if (!shown_)
        return std::nullopt;
    const ImVec2 picture = ImGui::GetIO().DisplaySize;
    ImGui::SetNextWindowPos({picture.x / 2, picture.y / 2}, ImGuiCond_Always, {0.5f, 0.5f});
    ImGui::SetNextWindowSize({std::min(0.96f * picture.x, 560.0f), 0.8f * picture.y});
    ImGui::Begin("Open data (Ctrl + O), or drop a file here###files", &shown_,
                 ImGuiWindowFlags_NoResize | ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoCollapse |
                     ImGuiWindowFlags_NoSavedSettings);
    std::optional<fs::path> chosen;
    if (!recent_.empty())
        note("recent", color_of(Ink::dim));
    for (const fs::path& path : recent_)
        if (ImGui::Selectable(path.string().c_str()))
            chosen = path;
    if (!recent_.empty())
        ImGui::Separator();
    if (auto file = draw_folder())
        chosen = std::move(file);
    ImGui::End();
    if (chosen)
        shown_ = false;
    return chosen;
}

} // namespace isochron::app
