// Takes the events of a frame into ImGui's state, and says which events the panel uses.
#pragma once

#include "app/panel/imgui/number_entry.h"
#include "app/panel/panel.h"
#include "interaction/input/window_event.h"

#include <glm/vec2.hpp>
#include <imgui.h>

#include <cstdint>
#include <optional>
#include <set>
#include <span>
#include <utility>

namespace isochron::app {

/// Keys that ImGui's text fields and sliders understand, and our names of them.
std::span<const std::pair<int, interaction::Key>> keys_of_imgui();

/// Converts a place in the window to one in the panel's part of it. A place outside the window
/// stays outside.
glm::vec2 folded(glm::vec2 at, glm::ivec2 places);

/// Whether the mouse at a place would be the panel's, as its windows were laid out last, in the
/// current Dear ImGui context. @param at panel pixels
bool has_mouse_at(const PanelLayout& panel, glm::vec2 at);

/// Takes one event into ImGui's state. The call returns whether the panel uses the event.
struct EventTaker {
    ImGuiIO& io;
    const PanelLayout& panel;
    std::uint32_t& late_releases;
    std::optional<glm::vec2>& cursor;
    glm::ivec2 places;   ///< number of panels in the window, see `repeat`
    bool popups = false; ///< a popup is open, which Escape closes
    bool lists = false;  ///< a popup or a page with a list is open, through which arrow keys go
    bool& closes_popup;
    NumberEntry& numbers;
    std::uint32_t released = 0; ///< mouse buttons that went up for this frame
    std::uint32_t pressed = 0;  ///< mouse buttons that went down among these events
    bool begun = false;         ///< a key or button went down among these events
    bool clicked = false;       ///< one of them on the panel
    bool typed = false;         ///< characters came among these events
    std::set<interaction::Key>
        changed{}; ///< keys, of those that ImGui reads, with events among these

    /// Whether ImGui would misread the event together with the earlier ones of this frame.
    bool must_wait(const interaction::WindowEvent& event) const;
    /// Whether the panel takes mouse events where the mouse is now. ImGui's own answer is about the
    /// place of the last frame, but a quick user moves and presses within one frame.
    bool captures_mouse() const;
    bool operator()(const interaction::KeyEvent& event);
    bool operator()(const interaction::TextEvent& event);
    bool operator()(const interaction::MouseButtonEvent& event);
    bool operator()(const interaction::MouseMoveEvent& event) const;
    bool operator()(const interaction::ScrollEvent& event) const;
    bool operator()(const interaction::FocusEvent& event) const;
    bool operator()(const interaction::GamepadEvent&) const { return false; }
};

} // namespace isochron::app
