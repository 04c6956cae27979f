// Keys that go through an open list of the panel.
#include "app/panel/imgui/keyed_list.h"

#include <imgui.h>

#include <algorithm>

namespace isochron::app {
namespace {

bool pressed(ImGuiKey key) {
    return ImGui::IsKeyPressed(ImGui::GetKeyIndex(key));
}

} // namespace

KeyedList::KeyedList(std::size_t here, std::size_t lines) {
    int* const kept = ImGui::GetStateStorage()->GetIntRef(ImGui::GetID("keyed"));
    const bool fresh = ImGui::IsWindowAppearing();
    if (fresh)
        *kept = static_cast<int>(here);
    const int way = (pressed(ImGuiKey_DownArrow) ? 1 : 0) - (pressed(ImGuiKey_UpArrow) ? 1 : 0);
    *kept = std::clamp(*kept + way, 0, std::max(0, static_cast<int>(lines) - 1));
    at_ = static_cast<std::size_t>(*kept);
    moved_ = fresh || way != 0;
    chosen_ = !fresh && pressed(ImGuiKey_Enter);
}

bool KeyedList::line(std::size_t line, bool clicked) const {
    if (!at(line))
        return clicked;
    if (moved_)
        ImGui::SetScrollHereY();
    if (chosen_)
        ImGui::CloseCurrentPopup();
    return clicked || chosen_;
}

} // namespace isochron::app
