// The panel's section on all that stands in the picture.
#include "app/panel/parts/objects_section.h"

#include "app/panel/imgui/number_entry.h"
#include "app/panel/item_table.h"
#include "app/panel/panel_words.h"
#include "app/panel/parts/eye_memory.h"
#include "app/panel/parts/rows.h"
#include "app/panel/parts/theme.h"

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <cstddef>
#include <string>

namespace isochron::app {
namespace {

using interaction::Commands;

constexpr float kItemSide = 22.0f;
constexpr std::size_t kMostItemLines = 8; ///< that are seen without scrolling

/// One line of the list.
struct ItemLine {
    const ItemKind& kind;
    const PanelModel& model;
    std::size_t number;
    Item item;
    float& before; ///< opacity that it had when it was seen last
};

void item_eye(const ItemLine& line, Commands& commands) {
    if (!line.kind.has_eye()) {
        ImGui::Dummy({kItemSide, kItemSide});
        return;
    }
    const Item& item = line.item;
    if (item.opacity && *item.opacity > 0)
        line.before = *item.opacity;
    if (icon_button("eye", item.shown ? Icon::eye : Icon::eye_shut,
                    item.shown ? "hide it" : "show it", false, kItemSide))
        show_item(line.kind, line.model, line.number, !item.shown, commands, line.before);
}

/// Its color, to be changed, or the icon of its kind.
void item_swatch(const ItemLine& line, Commands& commands) {
    if (line.item.color) {
        glm::vec3 color = *line.item.color;
        if (ImGui::ColorEdit3("##color", &color.x,
                              ImGuiColorEditFlags_NoInputs | ImGuiColorEditFlags_NoTooltip))
            line.kind.recolor(line.model, line.number, color, commands);
        tip("its color");
        return;
    }
    const ImVec2 corner = ImGui::GetCursorScreenPos();
    draw_icon(*ImGui::GetWindowDrawList(), line.kind.icon,
              {corner.x + kItemSide / 2, corner.y + kItemSide / 2}, 16.0f, packed(Ink::dim));
    ImGui::Dummy({kItemSide, kItemSide});
}

void item_words(const ItemLine& line, Commands& commands) {
    const Item& item = line.item;
    const float width =
        ImGui::GetContentRegionAvail().x - kItemSide - ImGui::GetStyle().ItemSpacing.x;
    const ImVec2 corner = ImGui::GetCursorPos();
    if (ImGui::InvisibleButton("words", {std::max(width, 1.0f), kItemSide}) && line.kind.can_go())
        go_to_item(line.kind, line.model, line.number, commands);
    if (line.kind.can_go() && ImGui::IsItemHovered()) {
        const ImVec2 low = ImGui::GetItemRectMin(), high = ImGui::GetItemRectMax();
        ImGui::GetWindowDrawList()->AddRectFilled(
            low, high, ImGui::GetColorU32(ImGuiCol_FrameBgHovered), 3.0f);
    }
    const std::string note = fmt::format("{}{}{}", item.note, item.note.empty() ? "" : "\n",
                                         line.kind.can_go() ? line.kind.go_words : "");
    if (!note.empty())
        tip(note.c_str());
    ImGui::OpenPopupOnItemClick("item", ImGuiPopupFlags_MouseButtonRight);
    ImGui::SetCursorPos({corner.x + 4.0f, corner.y});
    ImGui::AlignTextToFramePadding();
    const ImVec4 ink = color_of(item.faulty ? Ink::warning : item.shown ? Ink::text : Ink::dim);
    const float value = ImGui::CalcTextSize(item.value.c_str()).x;
    const float gap = item.value.empty() ? 0.0f : 10.0f;
    fitted_text(item.words, width - 4.0f - value - gap, ink);
    ImGui::SetCursorPos({corner.x + width - value, corner.y});
    ImGui::AlignTextToFramePadding();
    ImGui::TextColored(ink, "%s", item.value.c_str());
    ImGui::SameLine();
    ImGui::SetCursorPos({corner.x + width + ImGui::GetStyle().ItemSpacing.x, corner.y});
}

void item_menu(const ItemLine& line, Commands& commands) {
    const auto& [kind, model, i, item, before] = line;
    if (icon_button("menu", Icon::menu, "more about it", false, kItemSide))
        ImGui::OpenPopup("item");
    if (!ImGui::BeginPopup("item"))
        return;
    popup_title(words_of_item(item).c_str());
    if (kind.rename && item.named) {
        std::string name = item.name;
        ImGui::SetNextItemWidth(150.0f);
        if (finished_text("##name", "name", name) && !name.empty() && name != item.name)
            kind.rename(model, i, name, commands);
    }
    if (kind.fade && item.opacity) {
        float opacity = *item.opacity;
        ImGui::SetNextItemWidth(150.0f);
        if (share_field("##opacity", opacity))
            kind.fade(model, i, opacity, commands);
        tip("opacity");
    }
    if (kind.can_go() && ImGui::MenuItem(kind.go_words, nullptr, item.picked))
        go_to_item(kind, model, i, commands);
    const std::size_t count = kind.count(model);
    if (kind.alone && count > 1 && ImGui::MenuItem("show it alone"))
        show_alone(kind, model, i, commands);
    for (const ItemAct& act : kind.acts)
        if ((!act.offered || act.offered(model, i)) && ImGui::MenuItem(act.words))
            act.run(model, i, commands);
    if (kind.remove && ImGui::MenuItem("remove", nullptr, false, count > kind.least))
        kind.remove(model, i, commands);
    ImGui::EndPopup();
}

void item_line(const ItemLine& line, Commands& commands) {
    const ImVec2 corner = ImGui::GetCursorScreenPos();
    if (line.item.picked)
        ImGui::GetWindowDrawList()->AddRectFilled({corner.x - 7.0f, corner.y},
                                                  {corner.x - 4.0f, corner.y + kItemSide},
                                                  packed(Ink::accent), 1.5f);
    item_eye(line, commands);
    ImGui::SameLine();
    item_swatch(line, commands);
    ImGui::SameLine();
    item_words(line, commands);
    item_menu(line, commands);
}

} // namespace

void objects_section(const PanelModel& model, Commands& commands) {
    std::size_t lines = 0;
    for (const ItemKind& kind : item_kinds())
        lines += kind.count(model);
    ImGuiStorage& memory = *ImGui::GetStateStorage();
    // The page in the room is scrolled as a whole.
    const bool scrolls = lines > kMostItemLines && model.place != PanelPlace::in_room;
    const float height = kItemSide + ImGui::GetStyle().ItemSpacing.y;
    if (scrolls) // from the edge on, where the bar of what is picked stands
        ImGui::BeginChild("lines", {0.0f, (static_cast<float>(kMostItemLines) + 0.5f) * height});
    for (const ItemKind& kind : item_kinds())
        for (std::size_t i = 0; i < kind.count(model); ++i) {
            ImGui::PushID(kind.name.data());
            ImGui::PushID(static_cast<int>(i));
            item_line({kind, model, i, kind.item(model, i), opacity_before(memory, kind.name, i)},
                      commands);
            ImGui::PopID();
            ImGui::PopID();
        }
    if (scrolls)
        ImGui::EndChild();
}

} // namespace isochron::app
