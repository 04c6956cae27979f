// The bar at the top: data, undo, tools, what is written, and help.
#include "app/panel/parts/top_bar.h"

#include "app/frame/history.h"
#include "app/panel/panel_words.h"
#include "app/panel/parts/clip_lines.h"
#include "app/panel/parts/export_section.h"
#include "app/panel/parts/icons.h"
#include "app/panel/parts/mark_lines.h"
#include "app/panel/parts/rows.h"
#include "app/panel/parts/slice_lines.h"
#include "app/panel/parts/theme.h"
#include "app/panel/parts/written_pictures.h"
#include "interaction/controls/action_table.h"
#include "interaction/tools/ruler_tool.h"
#include "interaction/tools/tool_table.h"

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <string>

namespace isochron::app {
namespace {

using interaction::Commands;
using interaction::ToolKind;

constexpr float kWideBar = 620.0f;   ///< has room for words beside its icons
constexpr float kNarrowBar = 400.0f; ///< below, what has a key is left out

void gap_between_groups() {
    ImGui::SameLine(0.0f, 6.0f);
    const ImVec2 corner = ImGui::GetCursorScreenPos();
    ImGui::GetWindowDrawList()->AddLine(
        {corner.x, corner.y + 5.0f}, {corner.x, corner.y + kIconButton - 5.0f}, packed(Ink::line));
    ImGui::SetCursorScreenPos({corner.x + 6.0f, corner.y});
}

/// Undo or redo; its tip says what would change.
void way_button(const PanelModel& model, const char* id, Icon icon, const char* key,
                const Commands* change, Commands& commands) {
    ImGui::BeginDisabled(!change);
    const bool pressed = icon_button(id, icon, "");
    if (ImGui::IsItemHovered(ImGuiHoveredFlags_AllowWhenDisabled)) {
        const std::string what = words_for_way(model.asked, change, model.info.steps());
        tip(fmt::format("{}{}{} ({})", id, what.empty() ? "" : ": ", what, key).c_str());
    }
    ImGui::EndDisabled();
    if (pressed && change)
        commands = *change;
}

/// The tool of the mouse, or of the wand that points at the panel in the room.
void tool_buttons(const PanelModel& model, Commands& commands) {
    const bool in_room = model.place == PanelPlace::in_room;
    interaction::Tools tools = model.asked.tools;
    ToolKind& held = in_room ? tools.wand : tools.mouse;
    const ToolKind usual = in_room ? ToolKind::grab : ToolKind::pick;
    for (const interaction::ToolRow& each : interaction::tool_table()) {
        const std::string key = each.key ? fmt::format(" ({})", name_of(*each.key)) : "";
        const bool on = held == each.kind;
        if (icon_button(std::string(each.words).c_str(), IconPath(each.icon),
                        fmt::format("{}: {}{}", each.words, each.effect, key).c_str(), on))
            held = on ? usual : each.kind;
        if (&each != &interaction::tool_table().back())
            ImGui::SameLine(0.0f, 2.0f);
    }
    if (tools != model.asked.tools)
        commands.tools = tools;
}

/// Beside the button that saves a picture: what pictures show.
void picture_menu(const PanelModel& model, PanelPages& pages, Commands& commands) {
    constexpr float kDots = 20.0f;
    ImGui::SameLine(0.0f, 0.0f);
    const ImVec2 corner = ImGui::GetCursorScreenPos();
    ImGui::SetCursorScreenPos({corner.x, corner.y + (kIconButton - kDots) / 2});
    if (icon_button("picture menu", Icon::menu, "what pictures show, and their size", false, kDots))
        ImGui::OpenPopup("pictures");
    ImGui::SetCursorScreenPos({corner.x + kDots, corner.y}); // the line of all icons goes on
    ImGui::Dummy({0.0f, kIconButton});
    if (!ImGui::BeginPopup("pictures"))
        return;
    popup_title("What pictures show");
    picture_rows(model, commands);
    ImGui::BeginDisabled(!model.movies.offered || model.movies.progress);
    if (ImGui::Button("figure of this view"))
        pages.movie = MovieWish::figure;
    ImGui::EndDisabled();
    tip("a page for a paper, as PDF, and its description, which `isochron figure` reads");
    ImGui::EndPopup();
}

void movie_button(const PanelModel& model, PanelPages& pages, Commands& commands) {
    if (icon_button("movie", Icon::movie, "make a movie", model.movies.progress.has_value()))
        ImGui::OpenPopup("movies");
    if (!ImGui::BeginPopup("movies"))
        return;
    popup_title("Movies");
    pages.movie = movie_rows(model, commands);
    if (pages.movie)
        ImGui::CloseCurrentPopup();
    ImGui::EndPopup();
}

/// Moves to a place from which `width` is left to the end of the line.
void go_to_end(float width) {
    const float end = ImGui::GetWindowContentRegionMax().x;
    ImGui::SameLine(std::max(ImGui::GetCursorPosX(), end - width));
}

} // namespace

void top_bar(const PanelModel& model, PanelPages& pages, Commands& commands) {
    const bool in_room = model.place == PanelPlace::in_room;
    const float whole = ImGui::GetWindowWidth();
    ImGui::SetCursorPosY((ImGui::GetWindowHeight() - kIconButton) / 2);
    if (!in_room && pages.offers_files) {
        if (icon_button("open", Icon::open, "open other data (Ctrl + O)"))
            pages.files = true;
        gap_between_groups();
    }
    way_button(model, "undo", Icon::undo, "Ctrl + Z", model.ways.undo, commands);
    ImGui::SameLine(0.0f, 2.0f);
    way_button(model, "redo", Icon::redo, "Ctrl + Shift + Z", model.ways.redo, commands);
    gap_between_groups();
    tool_buttons(model, commands);
    gap_between_groups();
    if (icon_button("picture", Icon::picture, "save a screenshot of every window (P)"))
        commands.screenshot = true;
    if (whole >= kNarrowBar)
        picture_menu(model, pages, commands);
    if (whole >= kNarrowBar) {
        ImGui::SameLine(0.0f, 2.0f);
        export_button(model, commands);
    }
    if (in_room) {
        go_to_end(kIconButton);
        if (icon_button("search", Icon::search, "find a command and run it"))
            pages.search = true;
        return;
    }
    if (model.movies.offered && whole >= kNarrowBar) {
        ImGui::SameLine(0.0f, 2.0f);
        if (icon_button("record", Icon::record,
                        model.recording ? "end the recording of this session"
                                        : "record this session, to replay it",
                        model.recording))
            pages.movie = MovieWish::record;
        ImGui::SameLine(0.0f, 2.0f);
        movie_button(model, pages, commands);
    }
    constexpr float kSearch = 170.0f, kGap = 4.0f;
    const bool words = whole >= kWideBar;
    go_to_end(kIconButton + kGap + (words ? kSearch : kIconButton));
    if (words) {
        const ImVec2 corner = ImGui::GetCursorScreenPos();
        ImGui::PushStyleVar(ImGuiStyleVar_ButtonTextAlign, {0.0f, 0.5f});
        if (ImGui::Button("      search    Ctrl + K", {kSearch, kIconButton}))
            pages.search = true;
        ImGui::PopStyleVar();
        draw_icon(*ImGui::GetWindowDrawList(), Icon::search,
                  {corner.x + 15.0f, corner.y + kIconButton / 2}, 17.0f, packed(Ink::dim));
        tip("find a command, see its key, and run it (Ctrl + K)");
    } else if (icon_button("search", Icon::search,
                           "find a command, see its key, and run it (Ctrl + K)")) {
        pages.search = true;
    }
    ImGui::SameLine(0.0f, kGap);
    if (icon_button("help", Icon::help, "help: keys, mouse and devices (F1)"))
        pages.help = true;
}

namespace {

constexpr float kGapOfRuler = 14.0f;

/// The picked ruler and what it measures, what the next one measures, and the values along it.
void ruler_lines(const PanelModel& model, float width, Commands& commands) {
    const float right = ImGui::GetCursorScreenPos().x + width;
    const interaction::Rulers& rulers = model.asked.rulers;
    ImGui::AlignTextToFramePadding();
    ImGui::TextColored(color_of(Ink::dim), "%s", interaction::ruler_line(model.asked).c_str());
    const interaction::Ruler* const ruler = rulers.chosen();
    if (ruler && ruler->complete()) {
        const std::string measured = (rulers.list.size() > 1 ? ruler->name + ": " : std::string()) +
                                     interaction::measured_text(*ruler, model.data.unit);
        go_on_within(right, ImGui::CalcTextSize(measured.c_str()).x);
        text(measured);
    }
    go_on_within(right, tick_width("angle"), kGapOfRuler);
    bool angle = rulers.angle;
    if (tick_field("##angle", angle, "angle"))
        commands.rulers = with_angle(rulers, angle);
    tip("the next ruler measures the angle at the second of three places (Ctrl + Shift + R)");
    if (!ruler)
        return;
    if (ruler->complete()) {
        go_on_within(right, button_width("values"), kGapOfRuler);
        if (ImGui::Button("values"))
            commands.curves = interaction::profile_on_or_off(model.asked.curves);
        tip("the values along the ruler as a curve (Ctrl + Shift + D)");
    }
    go_on_within(right, ImGui::GetFrameHeight());
    if (icon_button("no ruler", Icon::remove,
                    rulers.list.size() > 1 ? "remove this ruler (Delete); the others are in the "
                                             "list of objects"
                                           : "remove the ruler (Delete)",
                    false, ImGui::GetFrameHeight()))
        commands.rulers = without_ruler(rulers, rulers.picked);
}

/// Whether the strip shows a tool: what it has made is there, or a tool with a line is held.
bool has_line(const interaction::ToolRow& tool, const PanelModel& model) {
    const interaction::Tools& tools = model.asked.tools;
    const ToolKind held = model.place == PanelPlace::in_room ? tools.wand : tools.mouse;
    return tool.made &&
           (tool.made(model.asked) || (held == tool.kind && tool.kind != ToolKind::pick));
}

} // namespace

bool has_tool_strip(const PanelModel& model) {
    return model.asked.mark.point ||
           std::ranges::any_of(interaction::tool_table(), [&](const interaction::ToolRow& tool) {
               return has_line(tool, model);
           });
}

void tool_strip(const PanelModel& model, float width, Commands& commands) {
    for (const interaction::ToolRow& tool : interaction::tool_table()) {
        if (!has_line(tool, model))
            continue;
        if (tool.kind == ToolKind::clip)
            clip_lines(model, width, commands);
        else if (tool.kind == ToolKind::slice)
            slice_lines(model, width, commands);
        else if (tool.kind == ToolKind::ruler)
            ruler_lines(model, width, commands);
    }
    if (model.asked.mark.point)
        mark_lines(model, width, commands);
}

} // namespace isochron::app
