// Sessions to go on with, as a list with small pictures.
#include "app/panel/parts/session_field.h"

#include "app/panel/imgui/keyed_list.h"
#include "app/panel/panel_words.h"
#include "app/panel/parts/theme.h"

#include <algorithm>
#include <chrono>

namespace isochron::app {
void small_picture(const std::shared_future<render::Image>& picture) {
    const ImVec2 place = small_picture_size(), corner = ImGui::GetCursorScreenPos();
    ImGui::Dummy(place);
    ImDrawList& list = *ImGui::GetWindowDrawList();
    list.AddRectFilled(corner, {corner.x + place.x, corner.y + place.y}, packed(Ink::control));
    using namespace std::chrono_literals;
    if (!picture.valid() || picture.wait_for(0s) != std::future_status::ready ||
        picture.get().rgba.empty())
        return;
    const render::Image& image = picture.get();
    const auto width = static_cast<float>(image.width), height = static_cast<float>(image.height);
    const float scale = std::min(place.x / width, place.y / height);
    const ImVec2 half{scale * width / 2, scale * height / 2};
    const ImVec2 middle{corner.x + place.x / 2, corner.y + place.y / 2};
    list.AddImage(const_cast<render::Image*>(&image), // NOLINT: an identity for ImGui
                  {middle.x - half.x, middle.y - half.y}, {middle.x + half.x, middle.y + half.y});
}

std::optional<std::size_t> session_field(const char* id, const std::string& current,
                                         std::span<const OfferedSession> sessions) {
    std::optional<std::size_t> chosen;
    constexpr float kHighest = 5.5f; // lines
    const ImVec2 place = small_picture_size();
    const float line = place.y + ImGui::GetStyle().ItemSpacing.y;
    ImGui::SetNextWindowSizeConstraints({0.0f, 0.0f}, {460.0f, kHighest * line});
    const bool open = ImGui::BeginCombo(id, current.c_str(), ImGuiComboFlags_HeightLargest);
    if (!open) {
        tip("All sessions on these data");
        return chosen;
    }
    const KeyedList keys(0, sessions.size());
    for (std::size_t i = 0; i < sessions.size(); ++i) {
        ImGui::PushID(static_cast<int>(i));
        const ImVec2 corner = ImGui::GetCursorPos();
        if (keys.line(i, ImGui::Selectable("##session", keys.at(i), 0, {0.0f, place.y})))
            chosen = i;
        ImGui::SetCursorPos(corner);
        small_picture(sessions[i].picture);
        ImGui::SameLine();
        ImGui::SetCursorPosY(corner.y + (place.y - ImGui::GetTextLineHeight()) / 2);
        text(sessions[i].words);
        ImGui::SetCursorPosY(corner.y + line);
        ImGui::PopID();
    }
    ImGui::EndCombo();
    return chosen;
}

} // namespace isochron::app
