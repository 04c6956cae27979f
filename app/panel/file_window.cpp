// The window for choosing data to open: places, a folder's contents, and the path as a text.
#include "app/panel/file_window.h"

#include "app/config/series_names.h"
#include "app/panel/imgui/number_entry.h"
#include "app/panel/panel_words.h"
#include "app/panel/parts/icons.h"
#include "app/panel/parts/rows.h"
#include "app/panel/parts/session_field.h"
#include "app/panel/parts/theme.h"
#include "app/text.h"

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <cstdlib>

namespace isochron::app {
namespace {

namespace fs = std::filesystem;
using Kind = ListedFile::Kind;

bool is_pressed(ImGuiKey key) {
    return ImGui::IsKeyPressed(ImGui::GetKeyIndex(key));
}

fs::path home_folder() {
    const char* const home = std::getenv("HOME");
    return home ? fs::path(home) : fs::path();
}

/// A path that the user has typed: `~` is their home, and what does not begin at the root lies in
/// the folder that is shown.
fs::path typed_path(const std::string& words, const fs::path& folder) {
    if (words == "~" || words.starts_with("~/"))
        return home_folder() / words.substr(std::min<std::size_t>(2, words.size()));
    return (folder / words).lexically_normal();
}

} // namespace

void FileWindow::open(std::vector<fs::path> recent) {
    shown_ = true;
    recent_ = std::move(recent);
    std::error_code error;
    go_to(recent_.empty() ? fs::current_path(error) : recent_.front().parent_path());
    if (!recent_.empty())
        show_recent();
}

void FileWindow::show_recent() {
    listing_ = listed(recent_);
    for (const fs::path& path : recent_)
        if (offers_.picture && !pictures_.contains(path))
            pictures_.emplace(path, offers_.picture(path));
    lately_ = fresh_ = true;
    filter_.clear();
    chosen_ = 0;
}

void FileWindow::go_to(const fs::path& folder) {
    folder_ = folder;
    path_ = folder.string();
    listing_ = listed_in(folder, all_);
    sort_lines(listing_.lines, order_, descending_);
    lately_ = false;
    fresh_ = true;
    filter_.clear();
    chosen_ = 0;
}

/// From the recent data to the folder of the newest; from a folder to the one around it.
void FileWindow::go_up() {
    if (lately_)
        go_to(fs::path(folder_));
    else if (folder_.has_relative_path())
        go_to(folder_.parent_path());
}

/// Opens a folder in the window, or takes data.
std::optional<fs::path> FileWindow::go_or_take(const fs::path& path) {
    std::error_code error;
    if (fs::is_directory(path, error)) {
        go_to(path);
        return std::nullopt;
    }
    if (fs::exists(path, error) || is_pattern(path.filename().string()))
        return path;
    listing_.complaint = fmt::format("{}: no such file or folder", path.string());
    return std::nullopt;
}

std::optional<fs::path> FileWindow::draw_path() {
    constexpr float kUp = 26.0f;
    if (icon_button("up", Icon::up, "the folder around this one (Backspace)", false, kUp))
        go_up();
    ImGui::SameLine();
    ImGui::SetNextItemWidth(-1.0f);
    text_field("##path", "path of a file or folder", path_);
    const bool typed = ImGui::IsItemDeactivatedAfterEdit() && is_pressed(ImGuiKey_Enter);
    return typed ? go_or_take(typed_path(path_, folder_)) : std::nullopt;
}

std::optional<fs::path> FileWindow::draw_places() {
    std::optional<fs::path> taken;
    constexpr float kWidth = 118.0f;
    ImGui::BeginChild("places", {kWidth, 0.0f});
    std::error_code error;
    const auto place = [&](const char* name, const fs::path& folder) {
        if (!folder.empty() && ImGui::Selectable(name, !lately_ && folder == folder_))
            go_to(folder);
    };
    if (!recent_.empty() && ImGui::Selectable("recent", lately_))
        show_recent();
    if (!offers_.demo.empty() && ImGui::Selectable("demo data"))
        taken = offers_.demo;
    place("working folder", fs::current_path(error));
    place("home", home_folder());
    place("file system", "/");
    for (const char* const mounted : {"/media", "/mnt", "/data", "/scratch"})
        if (fs::is_directory(mounted, error) && !fs::is_empty(mounted, error))
            place(mounted, mounted);
    ImGui::EndChild();
    return taken;
}

/// The recent data, each with what was seen last: the name first, then where it lies.
const ListedFile* FileWindow::draw_recent(const std::vector<const ListedFile*>& shown, bool moved) {
    const ListedFile* opened = nullptr;
    ImGui::BeginChild("recent data");
    for (int i = 0; i < static_cast<int>(shown.size()); ++i) {
        const ListedFile& line = *shown[static_cast<std::size_t>(i)];
        ImGui::PushID(i);
        const ImVec2 corner = ImGui::GetCursorPos();
        const float height = small_picture_size().y, row = ImGui::GetTextLineHeightWithSpacing();
        if (const LinePress press = table_line(i == chosen_, height); press != LinePress::none) {
            chosen_ = i;
            if (press == LinePress::twice)
                opened = &line;
        }
        if (i == chosen_ && moved)
            ImGui::SetScrollHereY();
        ImGui::SetCursorPos(corner);
        const auto picture = pictures_.find(line.path);
        small_picture(picture == pictures_.end() ? std::shared_future<render::Image>()
                                                 : picture->second);
        const float left = corner.x + small_picture_size().x + 10.0f;
        ImGui::SetCursorPos({left, corner.y + (height - 2 * row) / 2});
        const float width = ImGui::GetContentRegionMax().x - left;
        fitted_text(said_name(line.path), width, color_of(Ink::text));
        ImGui::SetCursorPos({left, corner.y + height / 2});
        fitted_text(line.path.parent_path().string(), width, color_of(Ink::dim));
        ImGui::SetCursorPos({corner.x, corner.y + height + ImGui::GetStyle().ItemSpacing.y});
        ImGui::PopID();
    }
    ImGui::Dummy({0.0f, 0.0f});
    ImGui::EndChild();
    return opened;
}

/// The lines as a table. @return the one that is to be opened
const ListedFile* FileWindow::draw_table(const std::vector<const ListedFile*>& shown, bool moved) {
    constexpr ImGuiTableFlags kFlags =
        ImGuiTableFlags_ScrollY | ImGuiTableFlags_Sortable | ImGuiTableFlags_SizingFixedFit;
    const ListedFile* opened = nullptr;
    if (!ImGui::BeginTable("files", 3, kFlags))
        return opened;
    ImGui::TableSetupScrollFreeze(0, 1);
    ImGui::TableSetupColumn("name",
                            ImGuiTableColumnFlags_WidthStretch | ImGuiTableColumnFlags_DefaultSort);
    ImGui::TableSetupColumn("size", ImGuiTableColumnFlags_WidthFixed, 76.0f);
    ImGui::TableSetupColumn("changed", ImGuiTableColumnFlags_WidthFixed, 122.0f);
    ImGui::TableHeadersRow();
    if (ImGuiTableSortSpecs* const order = ImGui::TableGetSortSpecs();
        order && order->SpecsDirty && order->SpecsCount > 0 && !lately_) {
        order_ = static_cast<ListOrder>(order->Specs[0].ColumnIndex);
        descending_ = order->Specs[0].SortDirection == ImGuiSortDirection_Descending;
        sort_lines(listing_.lines, order_, descending_);
        order->SpecsDirty = false;
        ImGui::EndTable();
        return opened; // the lines have changed places
    }
    for (int i = 0; i < static_cast<int>(shown.size()); ++i) {
        const ListedFile& line = *shown[static_cast<std::size_t>(i)];
        ImGui::TableNextRow();
        ImGui::TableNextColumn();
        ImGui::PushID(i);
        const std::string name = line.kind == Kind::folder ? line.name + "/" : line.name;
        if (const LinePress press = table_line(i == chosen_); press != LinePress::none) {
            chosen_ = i;
            if (press == LinePress::twice)
                opened = &line;
        }
        if (i == chosen_ && moved)
            ImGui::SetScrollHereY();
        ImGui::SameLine(0.0f, 0.0f);
        fitted_text(name, ImGui::GetContentRegionAvail().x, color_of(Ink::text));
        ImGui::TableNextColumn();
        ImGui::TextColored(color_of(Ink::dim), "%s", size_words(line).c_str());
        ImGui::TableNextColumn();
        ImGui::TextColored(color_of(Ink::dim), "%s", date_words(line).c_str());
        ImGui::PopID();
    }
    ImGui::EndTable();
    return opened;
}

std::optional<fs::path> FileWindow::draw_lines() {
    constexpr float kAll = 96.0f, kOpen = 60.0f;
    if (!ImGui::IsAnyItemActive()) { // what is typed filters the lines
        ImGui::SetWindowFocus();     // without, ImGui 1.90.1 gives no field of a child the keyboard
        ImGui::SetKeyboardFocusHere();
    }
    ImGui::SetNextItemWidth(ImGui::GetContentRegionAvail().x - kAll - kOpen -
                            2 * ImGui::GetStyle().ItemSpacing.x);
    const bool filtered = !filter_.empty(); // before Backspace takes its last letter
    if (text_field("##filter", "filter", filter_))
        chosen_ = 0;
    const bool typing = ImGui::IsItemActive() || ImGui::IsItemDeactivated();
    ImGui::SameLine();
    if (tick_field("##all", all_, "all files") && !lately_)
        go_to(folder_);
    ImGui::SameLine(ImGui::GetContentRegionMax().x - kOpen);
    const bool asked = ImGui::Button("Open", {kOpen, 0.0f});
    if (typing && !filtered && is_pressed(ImGuiKey_Backspace))
        go_up();
    std::vector<const ListedFile*> shown;
    for (const ListedFile& line : listing_.lines)
        if (has_words(line.name, filter_))
            shown.push_back(&line);
    const int last = std::max(0, static_cast<int>(shown.size()) - 1);
    const int way = (typing && is_pressed(ImGuiKey_DownArrow) ? 1 : 0) -
                    (typing && is_pressed(ImGuiKey_UpArrow) ? 1 : 0);
    chosen_ = std::clamp(chosen_ + way, 0, last);
    if (!listing_.complaint.empty())
        note(listing_.complaint, color_of(Ink::warning));
    else if (shown.empty())
        note(listing_.lines.empty() ? "no readable data in this folder"
                                    : "no name here has these words",
             color_of(Ink::dim));
    const ListedFile* opened = lately_ ? draw_recent(shown, way != 0) : draw_table(shown, way != 0);
    if (!shown.empty() && (asked || (typing && is_pressed(ImGuiKey_Enter))))
        opened = shown[static_cast<std::size_t>(std::min(chosen_, last))];
    if (!opened)
        return std::nullopt;
    if (opened->kind == Kind::folder) {
        go_to(fs::path(opened->path));
        return std::nullopt;
    }
    return opened->path;
}

std::optional<fs::path> FileWindow::draw() {
    if (!shown_)
        return std::nullopt;
    const ImVec2 picture = ImGui::GetIO().DisplaySize;
    ImGui::SetNextWindowPos({picture.x / 2, picture.y / 2}, ImGuiCond_Always, {0.5f, 0.5f});
    ImGui::SetNextWindowSize({std::min(0.96f * picture.x, 720.0f), 0.84f * picture.y});
    if (std::exchange(fresh_, false))
        ImGui::SetNextWindowFocus();
    ImGui::Begin("Open data or a model (Ctrl + O), or drop a file here###files", &shown_,
                 ImGuiWindowFlags_NoResize | ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoCollapse |
                     ImGuiWindowFlags_NoSavedSettings);
    std::optional<fs::path> chosen = draw_path();
    if (auto place = draw_places())
        chosen = std::move(place);
    ImGui::SameLine();
    ImGui::BeginChild("contents");
    if (auto line = draw_lines())
        chosen = std::move(line);
    ImGui::EndChild();
    ImGui::End();
    if (chosen)
        shown_ = false;
    return chosen;
}

} // namespace isochron::app
