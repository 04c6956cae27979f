// Characters that the user types into the panel's fields, most of which hold one number.
#include "app/panel/imgui/number_entry.h"

#include "app/panel/parts/room_keys.h"

#include <fmt/format.h>
#include <imgui.h>
#include <imgui_internal.h>

#include <algorithm>
#include <array>
#include <tuple>
#include <utility>
#include <vector>

namespace isochron::app {
namespace {

constexpr int kNone = -1;
constexpr int kWords = -2; ///< kept of a field that holds words and no number

bool is_separator(char32_t character) {
    return character == U'.' || character == U',';
}

/// The text of a field; only its ASCII characters matter. ImGui 1.91 no longer keeps the text as
/// wide characters.
template <class Field>
std::string text_of(const Field& field) {
    std::string text;
    const auto add = [&text](const auto& characters, int count) {
        for (int i = 0; i < count; ++i)
            text +=
                static_cast<unsigned>(characters[i]) < 128 ? static_cast<char>(characters[i]) : '?';
    };
    if constexpr (requires { field.TextW; })
        add(field.TextW, field.CurLenW);
    else
        add(field.TextA, field.TextLen);
    return text;
}

/// Its text when the user began.
template <class Field>
std::string first_text_of(const Field& field) {
    if constexpr (requires { field.InitialTextA; })
        return field.InitialTextA.Data;
    else
        return field.TextToRevertTo.Data;
}

/// The text of a field as it will be when it has taken the characters that wait for it.
std::string text_to_be(const ImGuiInputTextState& field, const std::u32string& waiting) {
    std::string text = text_of(field);
    auto first = static_cast<std::size_t>(field.GetCursorPos()), last = first;
    if (field.HasSelection()) // the first character replaces it
        std::tie(first, last) = std::minmax({static_cast<std::size_t>(field.GetSelectionStart()),
                                             static_cast<std::size_t>(field.GetSelectionEnd())});
    first = std::min(first, text.size());
    last = std::min(last, text.size());
    std::string typed;
    for (const char32_t character : waiting)
        typed += character < 128 ? static_cast<char>(character) : '?';
    return text.replace(first, last - first, typed);
}

} // namespace

bool text_field(const char* id, const char* hint, std::string& words) {
    constexpr std::size_t kLongest = 4095; // longest path
    ImGui::GetStateStorage()->SetInt(ImGui::GetID(id), kWords);
    std::array<char, kLongest + 1> characters{};
    words.copy(characters.data(), kLongest);
    const bool changed = ImGui::InputTextWithHint(id, hint, characters.data(), characters.size());
    words = characters.data();
    return changed;
}

bool text_area(const char* id, std::string& words, float width, float height, std::size_t most) {
    ImGui::GetStateStorage()->SetInt(ImGui::GetID(id), kWords);
    std::vector<char> characters(most + 1);
    words.copy(characters.data(), most);
    const bool changed =
        ImGui::InputTextMultiline(id, characters.data(), characters.size(), {width, height});
    words = characters.data();
    return changed;
}

bool finished_text(const char* id, const char* hint, std::string& words) {
    if (RoomKeys* const keys = RoomKeys::here()) {
        const std::string label = (words.empty() ? hint : words) + "###" + id;
        if (ImGui::Button(label.c_str(), {ImGui::CalcItemWidth(), 0.0f}))
            keys->open(ImGui::GetID(id), RoomKeys::Kind::words, words);
        keys->draw(ImGui::GetID(id));
        const auto typed = keys->take(ImGui::GetID(id));
        if (typed)
            words = *typed;
        return typed.has_value();
    }
    text_field(id, hint, words);
    return ImGui::IsItemDeactivatedAfterEdit();
}

void NumberEntry::type(char32_t character) {
    const ImGuiContext& context = *ImGui::GetCurrentContext();
    ImGuiInputTextState* field = ImGui::GetInputTextState(context.ActiveId);
    if (!field || context.ActiveId != refused_)
        refused_ = 0;
    if (refused_ != 0)
        return;
    if (!field || !is_separator(character)) {
        waiting_ += character;
        return;
    }
    const int before = context.ActiveIdWindow->StateStorage.GetInt(context.ActiveId, kNone);
    if (before == kWords) {
        waiting_ += character;
        return;
    }
    const bool whole = before != kNone;
    const std::string text = text_to_be(*field, waiting_);
    if (!whole && std::ranges::none_of(text, [](char c) { return is_separator(c); })) {
        waiting_ += U'.';
        return;
    }
    const std::string stays = whole ? std::to_string(before) : first_text_of(*field);
    complaint_ =
        fmt::format("{}{}: expected {}, without separators of thousands; it stays {}", text,
                    static_cast<char>(character),
                    whole ? "a whole number" : "a number with one decimal point or comma", stays);
    refused_ = context.ActiveId;
    field->SelectAll();
    waiting_.assign(stays.begin(), stays.end());
}

void NumberEntry::press(interaction::Key key) {
    using enum interaction::Key;
    for (const interaction::Key edits : {backspace, del, enter, escape, tab})
        if (key == edits)
            refused_ = 0;
}

void NumberEntry::flush() {
    for (const char32_t character : std::exchange(waiting_, {}))
        ImGui::GetIO().AddInputCharacter(character);
}

std::string NumberEntry::take_complaint() {
    return std::exchange(complaint_, {});
}

} // namespace isochron::app
