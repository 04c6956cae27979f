// Keys on the panel in the room, for a hand that has no keyboard: digits for a number, letters for
// a text.
#include "app/panel/parts/room_keys.h"

#include "app/panel/panel_words.h"
#include "app/panel/parts/theme.h"

#include <imgui.h>

#include <algorithm>
#include <cctype>
#include <string_view>
#include <utility>

namespace isochron::app {
namespace {

constexpr float kKeyHeight = 40.0f;
constexpr std::size_t kLongestText = 60;

} // namespace

RoomKeys* RoomKeys::here() {
    return static_cast<RoomKeys*>(ImGui::GetIO().UserData);
}

void RoomKeys::use() {
    ImGui::GetIO().UserData = this;
}

void RoomKeys::open(std::uint32_t field, Kind kind, std::string text) {
    field_ = field;
    kind_ = kind;
    text_ = std::move(text);
    fresh_ = opening_ = true;
    capital_ = false;
    accepted_for_ = 0;
}

std::optional<std::string> RoomKeys::take(std::uint32_t field) {
    if (accepted_for_ != field || field == 0)
        return std::nullopt;
    accepted_for_ = 0;
    return std::exchange(accepted_, {});
}

void RoomKeys::press(const std::string& key) {
    if (std::exchange(fresh_, false))
        text_.clear();
    if (text_.size() < kLongestText)
        text_ += key;
}

void RoomKeys::row_of_keys(const char* keys, float width) {
    const float gap = ImGui::GetStyle().ItemSpacing.x;
    const std::string_view all(keys);
    const float each =
        (width - gap * static_cast<float>(all.size() - 1)) / static_cast<float>(all.size());
    for (std::size_t i = 0; i < all.size(); ++i) {
        if (i > 0)
            ImGui::SameLine();
        const auto letter = static_cast<unsigned char>(all[i]);
        const std::string key(1, static_cast<char>(capital_ ? std::toupper(letter) : letter));
        if (ImGui::Button((key + "##key").c_str(), {each, kKeyHeight}))
            press(key);
    }
}

void RoomKeys::draw(std::uint32_t field) {
    if (field_ == 0 || field_ != field)
        return;
    if (std::exchange(opening_, false))
        ImGui::OpenPopup("keys");
    const ImVec2 panel = ImGui::GetIO().DisplaySize;
    const bool words = kind_ == Kind::words;
    const float width = words ? panel.x - 30.0f : 190.0f;
    // It takes the whole panel, so that a ray beside the keys presses nothing behind them.
    ImGui::SetNextWindowPos({0.0f, 0.0f});
    ImGui::SetNextWindowSize(panel);
    if (!ImGui::BeginPopup("keys", ImGuiWindowFlags_NoMove)) {
        field_ = 0;
        return;
    }
    ImGui::SetCursorPos({(panel.x - width) / 2, words ? 110.0f : 90.0f});
    ImGui::BeginGroup();
    ImGui::TextColored(color_of(Ink::dim), "%s",
                       words                         ? "a name"
                       : kind_ == Kind::whole_number ? "a whole number"
                                                     : "a number");
    const ImVec2 corner = ImGui::GetCursorScreenPos();
    const float height = ImGui::GetFrameHeight();
    ImGui::GetWindowDrawList()->AddRectFilled(corner, {corner.x + width, corner.y + height},
                                              packed(fresh_ ? Ink::chosen : Ink::control),
                                              ImGui::GetStyle().FrameRounding);
    ImGui::SetCursorScreenPos({corner.x + 6.0f, corner.y + 3.0f});
    ImGui::PushClipRect(corner, {corner.x + width, corner.y + height}, true);
    text(text_.empty() ? " " : text_);
    ImGui::PopClipRect();
    ImGui::SetCursorScreenPos({corner.x, corner.y + height + 8.0f});
    if (words) {
        for (const char* const keys : {"1234567890", "qwertyuiop", "asdfghjkl-", "zxcvbnm_.,"})
            row_of_keys(keys, width);
    } else {
        for (const char* const keys : {"789", "456", "123"})
            row_of_keys(keys, width);
        row_of_keys(kind_ == Kind::whole_number ? "0" : "-0.", width);
        if (kind_ == Kind::number)
            row_of_keys("e", width);
    }
    const float gap = ImGui::GetStyle().ItemSpacing.x, half = (width - gap) / 2;
    if (words) {
        if (ImGui::Button("capitals", {half, kKeyHeight}))
            capital_ = !capital_;
        ImGui::SameLine();
        if (ImGui::Button("space", {half, kKeyHeight}))
            press(" ");
    }
    if (ImGui::Button("delete", {width, kKeyHeight})) {
        if (std::exchange(fresh_, false))
            text_.clear();
        else if (!text_.empty())
            text_.pop_back();
    }
    const bool accepted = ImGui::Button("accept", {half, kKeyHeight});
    ImGui::SameLine();
    const bool left = ImGui::Button("cancel", {half, kKeyHeight});
    ImGui::EndGroup();
    if (accepted || left)
        ImGui::CloseCurrentPopup();
    ImGui::EndPopup();
    if (accepted && !text_.empty()) {
        accepted_for_ = field_;
        accepted_ = text_;
    }
    if (accepted || left)
        field_ = 0;
}

std::optional<std::string> keyed_text(std::uint32_t field, RoomKeys::Kind kind,
                                      const std::string& text) {
    RoomKeys* const keys = RoomKeys::here();
    if (keys == nullptr)
        return std::nullopt;
    const ImGuiIO& io = ImGui::GetIO();
    const float still = 0.5f * io.MouseDragThreshold;
    if (ImGui::IsItemDeactivated() && !ImGui::IsItemDeactivatedAfterEdit() &&
        io.MouseDragMaxDistanceSqr[0] <= still * still)
        keys->open(field, kind, text);
    keys->draw(field);
    return keys->take(field);
}

} // namespace isochron::app
