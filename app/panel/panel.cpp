// The control panel.
#include "app/panel/panel.h"

#include "app/panel/panel_words.h"
#include "app/panel/parts/curve_drawer.h"
#include "app/panel/parts/icons.h"
#include "app/panel/parts/messages.h"
#include "app/panel/parts/sections.h"
#include "app/panel/parts/story_card.h"
#include "app/panel/parts/theme.h"
#include "app/panel/parts/time_bar.h"
#include "app/panel/parts/time_track.h"
#include "app/panel/parts/view_cube.h"

#include <imgui_internal.h>

#include <algorithm>
#include <string>

namespace isochron::app {
namespace {

using interaction::Commands;

constexpr ImGuiWindowFlags kPart = ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove |
                                   ImGuiWindowFlags_NoSavedSettings |
                                   ImGuiWindowFlags_NoBringToFrontOnFocus;

/// Begins a part of the panel that fills a box.
void begin_part(const char* name, const PanelBox& box, Ink paper, ImGuiWindowFlags flags = kPart) {
    ImGui::SetNextWindowPos({box.low.x, box.low.y});
    ImGui::SetNextWindowSize({box.size().x, box.size().y});
    ImGui::PushStyleColor(ImGuiCol_WindowBg, color_of(paper));
    ImGui::PushStyleVar(ImGuiStyleVar_WindowRounding, 0.0f);
    ImGui::Begin(name, nullptr, flags);
}

void end_part() {
    ImGui::End();
    ImGui::PopStyleVar();
    ImGui::PopStyleColor();
}

/// The strip by which a hand carries the panel in the room; says between which steps the moment lies,
/// or that a gap is held, where both have room.
void title_of(const PanelModel& model, const PanelLayout& layout) {
    const PanelBox box{{0.0f, 0.0f}, {layout.top.high.x, layout.top.low.y}};
    begin_part("###title", box, Ink::chosen);
    const std::string words = "Isochron: " + model.info.array;
    ImGui::SetCursorPosY((box.size().y - ImGui::GetFontSize()) / 2);
    ImGui::TextUnformatted(words.c_str());
    const std::string held = held_text(model);
    const float wide = ImGui::CalcTextSize(words.c_str()).x,
                wants = ImGui::CalcTextSize(held.c_str()).x;
    const float margin = ImGui::GetStyle().WindowPadding.x;
    if (wide + wants + 4 * margin < box.size().x) {
        ImGui::SameLine(box.size().x - wants - margin);
        text(held);
    }
    end_part();
}

/// Below the pages in the room: lines of the tools, and the way out of an empty picture. They keep their
/// place whatever the page holds, and are scrolled where they take more than half of the column.
class RoomStrip {
  public:
    explicit RoomStrip(const PanelModel& model)
        : model_(model), shown_(has_tool_strip(model) || model.notes.empty),
          lines_(ImGui::GetID("lines of the strip")) {}

    /// Height that it takes below the page; 0: it is not shown.
    float height() const {
        const float gap = ImGui::GetStyle().ItemSpacing.y;
        const float most = ImGui::GetContentRegionAvail().y / 2;
        const float lines = ImGui::GetStateStorage()->GetFloat(lines_, ImGui::GetFrameHeight());
        return shown_ ? std::min(lines + kLine + 2 * gap, most) : 0.0f;
    }
    void lay_out(Commands& commands) {
        if (!shown_)
            return;
        ImGui::Separator();
        ImGui::BeginChild("strip");
        if (has_tool_strip(model_))
            tool_strip(model_, ImGui::GetContentRegionAvail().x, commands);
        if (empty_rows(model_))
            merge(commands, model_.notes.empty->commands);
        const float lines = ImGui::GetCursorPosY();
        ImGui::EndChild();
        ImGui::GetStateStorage()->SetFloat(lines_, lines); // for the next frame
    }

  private:
    static constexpr float kLine = 1.0f; ///< between the page and the strip

    const PanelModel& model_;
    bool shown_;
    ImGuiID lines_; ///< what the height of all lines is kept under
};

/// The icons of a folded column; each opens its section over the picture, and closes it again.
void section_icons(std::optional<std::size_t>& open) {
    for (std::size_t i = 0; i < kSections; ++i)
        if (icon_button(sections()[i].name, sections()[i].icon, // whose name stands beside it then
                        open == i ? "" : sections()[i].name, open == i))
            open = open == i ? std::nullopt : std::optional(i);
}

/// @return its lower right corner
glm::vec2 section_over_picture(const PanelModel& model, const PanelView& view, PanelPages& pages,
                               Commands& commands) {
    constexpr float kWidth = 300.0f;
    const Section& section = sections()[*view.section];
    const PanelBox& room = view.layout.picture;
    const float width = std::min(kWidth, room.size().x);
    ImGui::SetNextWindowPos({room.low.x, room.low.y});
    ImGui::SetNextWindowSizeConstraints({width, 0.0f}, {width, room.size().y});
    ImGui::PushStyleVar(ImGuiStyleVar_WindowRounding, 0.0f);
    ImGui::Begin("###section", nullptr,
                 (kPart & ~ImGuiWindowFlags_NoScrollbar) | ImGuiWindowFlags_AlwaysAutoResize);
    text(section.name);
    ImGui::Separator();
    ImGui::PushID(section.name);
    section.lay_out(model, pages, commands);
    ImGui::PopID();
    const ImVec2 corner = ImGui::GetWindowPos(), size = ImGui::GetWindowSize();
    ImGui::End();
    ImGui::PopStyleVar();
    return {corner.x + size.x, corner.y + size.y};
}

/// What lies over the picture while the panel is shown.
void over_picture(const PanelModel& model, PanelView& view, PanelPages& pages, Commands& commands) {
    const PanelBox free = view.layout.picture;
    view.free = {{free.low.x, free.low.y + 10.0f}, free.high};
    view.lowest = view.free.low.y;
    constexpr float kApart = 8.0f, kPadding = 8.0f, kLeast = 280.0f; // for messages
    const auto keep_off = [&](const glm::vec2& corner) {
        view.lowest = std::max(view.lowest, corner.y);
        if (view.free.high.x - corner.x >= kLeast)
            view.free.low.x = corner.x;
        else
            view.free.low.y = corner.y + 6.0f;
    };
    if (view.layout.folded && view.section)
        return keep_off(section_over_picture(model, view, pages, commands));
    const glm::vec2 chip = state_chip(model, free, view.statistics);
    const float left_of_cube = view_cube(model, free, commands);
    view.free.high.x = left_of_cube;
    view.lowest = left_of_cube < free.high.x ? free.low.y + kCubeEnd.y : chip.y;
    float below = chip.y + 6.0f;
    // In a low picture the lines of the tools give way to messages, the sooner above a story's card.
    constexpr float kLow = 190.0f, kLowAboveStory = 260.0f;
    const ImGuiWindow* const said = ImGui::FindWindowByName("###message");
    const bool gives_way =
        free.size().y < (model.asked.story > 0 ? kLowAboveStory : kLow) && said && said->WasActive;
    if (has_tool_strip(model) && !gives_way) {
        ImGui::SetNextWindowPos({chip.x + kApart, free.low.y + 10.0f});
        ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {kPadding, 3.0f});
        ImGui::PushStyleColor(ImGuiCol_WindowBg, color_of(Ink::bar));
        ImGui::Begin("###tool", nullptr,
                     kPart | ImGuiWindowFlags_AlwaysAutoResize |
                         ImGuiWindowFlags_NoFocusOnAppearing);
        tool_strip(model, left_of_cube - chip.x - 2 * (kApart + kPadding), commands);
        view.free.low.y += ImGui::GetWindowHeight() + 6.0f;
        below = std::max(below, view.free.low.y);
        view.lowest = std::max(view.lowest, below);
        ImGui::End();
        ImGui::PopStyleColor();
        ImGui::PopStyleVar();
    } else {
        view.free.low.x = chip.x + kApart;
    }
    gap_window(model, free, below);
    if (!view.statistics)
        return;
    // Below them there is room for messages and for what a gap says, where there is none beside.
    constexpr float kForWords = 190.0f, kFewLines = 48.0f;
    const bool beside = view.free.high.x - statistics_end(free) >= kLeast;
    const float highest = free.high.y - below - (beside ? 0.0f : kForWords);
    if (highest >= kFewLines)
        keep_off(statistics_window(model, free, below, highest, pages));
}

} // namespace

Commands draw_panel(const PanelModel& model, PanelView& view, PanelPages& pages) {
    Commands commands;
    const ImVec2 size = ImGui::GetIO().DisplaySize;
    const PanelLayout& layout = view.layout =
        layout_in(model.place, {size.x, size.y}, rows_of(model.asked));
    if (ImGui::IsMouseClicked(ImGuiMouseButton_Left))
        view.pointed.reset();
    if (!layout.folded)
        view.section.reset();
    else if (view.pointed && *view.pointed < kSections)
        view.section = std::exchange(view.pointed, {});
    if (model.place == PanelPlace::in_room)
        title_of(model, layout);
    begin_part("###top", layout.top, Ink::bar);
    top_bar(model, pages, commands);
    end_part();
    const ImVec2 padding = layout.folded ? ImVec2(6, 6) : ImGui::GetStyle().WindowPadding;
    ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, padding);
    begin_part("###column", layout.column, Ink::paper, kPart & ~ImGuiWindowFlags_NoScrollbar);
    if (model.place != PanelPlace::over)
        story_rows(model, commands);
    if (layout.folded) {
        section_icons(view.section);
    } else if (model.place == PanelPlace::in_room) {
        RoomStrip strip(model);
        section_pages(model, pages, commands, view.pointed, strip.height());
        strip.lay_out(commands);
    } else {
        section_column(model, pages, commands, view.pointed);
    }
    if (model.place == PanelPlace::whole && empty_rows(model))
        interaction::merge(commands, model.notes.empty->commands);
    end_part();
    ImGui::PopStyleVar();
    if (layout.curves.size().y > 0) {
        begin_part("###curves", layout.curves, Ink::paper);
        curve_drawer(model, commands);
        end_part();
    }
    begin_part("###time", layout.time, Ink::bar);
    time_bar(model, layout.two_rows, commands);
    if (view.pointed == kSections)
        point_at({layout.time.low.x, layout.time.low.y}, {layout.time.high.x, layout.time.high.y});
    end_part();
    if (model.place == PanelPlace::over) {
        film_lane(model, layout, view.film, commands);
        over_picture(model, view, pages, commands);
    }
    return commands;
}

} // namespace isochron::app
