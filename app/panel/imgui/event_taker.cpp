// How ImGui's state follows events: one change of each key and button a frame.
#include "app/panel/imgui/event_taker.h"

#include <glm/common.hpp>
#include <imgui_internal.h>

#include <algorithm>
#include <iterator>
#include <variant>

namespace isochron::app {
namespace {

using namespace interaction;

/// Keys that ImGui's text fields and sliders understand, and our names of them.
constexpr std::pair<int, Key> kKeys[]{
    {ImGuiKey_Tab, Key::tab},
    {ImGuiKey_LeftArrow, Key::left},
    {ImGuiKey_RightArrow, Key::right},
    {ImGuiKey_UpArrow, Key::up},
    {ImGuiKey_DownArrow, Key::down},
    {ImGuiKey_Home, Key::home},
    {ImGuiKey_End, Key::end},
    {ImGuiKey_Delete, Key::del},
    {ImGuiKey_Backspace, Key::backspace},
    {ImGuiKey_Enter, Key::enter},
    {ImGuiKey_Escape, Key::escape},
    {ImGuiKey_A, Key{'A'}},
    {ImGuiKey_C, Key{'C'}},
    {ImGuiKey_V, Key{'V'}},
    {ImGuiKey_X, Key{'X'}},
    {ImGuiKey_Z, Key{'Z'}},
};

bool is_read(Key key) {
    return std::ranges::any_of(kKeys, [key](const auto& each) { return each.second == key; });
}

/// Keys that go through a list and choose of it.
bool goes_through_list(Key key) {
    using enum Key;
    constexpr Key kAll[]{up, down, left, right, page_up, page_down, home, end, enter};
    return std::ranges::find(kAll, key) != std::end(kAll);
}

} // namespace

std::span<const std::pair<int, Key>> keys_of_imgui() {
    return kKeys;
}

glm::vec2 folded(glm::vec2 at, glm::ivec2 places) {
    const glm::vec2 shown = at * glm::vec2(places);
    return shown - glm::clamp(glm::floor(shown), glm::vec2(0.0f), glm::vec2(places - 1));
}

bool EventTaker::must_wait(const WindowEvent& event) const {
    if (const auto* key = std::get_if<KeyEvent>(&event))
        return clicked ||
               ((io.WantTextInput || io.WantCaptureKeyboard || lists) && is_read(key->key) &&
                (changed.contains(key->key) || (typed && key->down)));
    if (const auto* button = std::get_if<MouseButtonEvent>(&event))
        return button->down &&
               ((pressed | released) & 1u << static_cast<std::size_t>(button->button)) != 0;
    if (std::holds_alternative<TextEvent>(event))
        return clicked || (io.WantTextInput && !changed.empty());
    return false;
}

bool has_mouse_at(const PanelLayout& panel, glm::vec2 at) {
    const ImGuiContext& imgui = *ImGui::GetCurrentContext();
    const ImGuiIO& io = imgui.IO;
    bool drags = false; // something of the panel
    for (std::size_t button = 0; button < std::size(io.MouseDown); ++button)
        drags = drags || (io.MouseDown[button] && io.MouseDownOwned[button]);
    if (drags || imgui.OpenPopupStack.Size > 0 || panel.covers(at))
        return true;
    return std::any_of(imgui.Windows.begin(), imgui.Windows.end(), [&](const ImGuiWindow* window) {
        return window->Active && !window->Hidden &&
               (window->Flags & (ImGuiWindowFlags_NoMouseInputs | ImGuiWindowFlags_ChildWindow)) ==
                   0 &&
               window->OuterRectClipped.Contains({at.x, at.y});
    });
}

bool EventTaker::captures_mouse() const {
    return has_mouse_at(panel, {io.MousePos.x, io.MousePos.y});
}

bool EventTaker::operator()(const KeyEvent& event) {
    const auto code = static_cast<std::size_t>(event.key);
    begun = begun || event.down;
    if (event.down)
        numbers.press(event.key);
    if (is_read(event.key))
        changed.insert(event.key);
    if (code < std::size(io.KeysDown))
        io.KeysDown[code] = event.down;
    if (event.key == Key::left_control || event.key == Key::right_control)
        io.KeyCtrl = event.down;
    if (event.key == Key::left_shift || event.key == Key::right_shift)
        io.KeyShift = event.down;
    if (event.key == Key::escape && event.down && event.alone() && popups && !io.WantTextInput)
        return closes_popup = true;
    return event.down && (io.WantTextInput || (lists && goes_through_list(event.key)));
}

bool EventTaker::operator()(const TextEvent& event) {
    typed = true;
    if (io.WantTextInput)
        numbers.type(event.character);
    return io.WantTextInput;
}

bool EventTaker::operator()(const MouseButtonEvent& event) {
    const auto button = static_cast<std::size_t>(event.button);
    const std::uint32_t bit = 1u << button;
    // Before the button is down: whose it was when it was pressed last says nothing of this press.
    const bool taken = event.down && captures_mouse();
    // ImGui sees the state once per frame: delay the release of a click within one frame.
    begun = begun || event.down;
    (event.down ? pressed : released) |= bit;
    if (!event.down && (pressed & bit))
        late_releases |= bit;
    else
        io.MouseDown[button] = event.down;
    clicked = clicked || taken;
    return taken;
}

bool EventTaker::operator()(const MouseMoveEvent& event) const {
    const glm::vec2 at = folded({event.x, event.y}, places);
    cursor = at;
    io.MousePos = {at.x * io.DisplaySize.x, at.y * io.DisplaySize.y};
    return false;
}

bool EventTaker::operator()(const ScrollEvent& event) const {
    if (captures_mouse())
        io.MouseWheel += event.dy;
    return captures_mouse();
}

bool EventTaker::operator()(const FocusEvent& event) const {
    if (!event.focused) {
        std::fill(std::begin(io.MouseDown), std::end(io.MouseDown), false);
        std::fill(std::begin(io.KeysDown), std::end(io.KeysDown), false);
        io.KeyCtrl = io.KeyShift = false;
    }
    return false;
}

} // namespace isochron::app
