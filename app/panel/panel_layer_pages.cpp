// The pages that lie over the picture beside the panel.
#include "app/panel/panel_help.h"
#include "app/panel/panel_layer.h"
#include "app/panel/panel_tools.h"

#include <imgui.h>
#include <imgui_internal.h>

#include <utility>
#include <variant>

namespace isochron::app {

using interaction::Key;
using interaction::KeyEvent;
using interaction::Seconds;
using interaction::TextEvent;
using interaction::WindowEvent;

/// F1, `?` and Ctrl + O, wherever the mouse is, and Escape from what they open. @return whether it
/// was one of them
bool PanelLayer::turns_page(const WindowEvent& event) {
    const ImGuiIO& io = ImGui::GetIO();
    const auto* key = std::get_if<KeyEvent>(&event);
    const auto* typed = std::get_if<TextEvent>(&event);
    const bool pressed = key && key->down && key->alone();
    if ((pressed && key->key == Key::f1) ||
        (typed && typed->character == U'?' && !io.WantTextInput)) {
        help_ = !help_;
        begun_ = true;
        return true;
    }
    // At once: what comes after it may open the next page.
    if (pressed && key->key == Key::escape && has_page() && !io.WantTextInput && !has_popup()) {
        if (files_.is_open())
            files_.close();
        else
            help_ = false;
        return true;
    }
    const bool opens = key && key->down && key->key == Key{'O'} &&
                       (io.KeyCtrl || key->with(interaction::Modifier::control)) &&
                       !key->with(interaction::Modifier::alt) &&
                       !key->with(interaction::Modifier::super);
    if (!opens || !recent_)
        return false;
    open_files();
    return true;
}

void PanelLayer::lay_out_files(glm::ivec2 picture, const std::string& complaint, Seconds time) {
    begin_frame(picture, time);
    if (auto file = files_.draw())
        chosen_ = std::move(file);
    message_window(complaint, {}, Seconds(0));
    ImGui::Render();
}

void PanelLayer::lay_out_progress(glm::ivec2 picture, const std::string& name,
                                  const std::string& line, float fraction, Seconds time) {
    begin_frame(picture, time);
    progress_window(name, line, fraction);
    ImGui::Render();
}

bool PanelLayer::has_popup() const {
    return imgui_->OpenPopupStack.Size > 0;
}

/// Lays out the pages over the picture: help, files and introduction.
void PanelLayer::lay_out_pages(const PanelModel& model, Seconds time) {
    if (help_ && model.place != PanelPlace::in_room)
        help_ = help_window(model);
    if (auto file = files_.draw())
        chosen_ = std::move(file);
    if (!newcomer_ || has_page() || model.place != PanelPlace::over)
        return;
    constexpr Seconds kLeast{6.0}; // long enough to be read
    if (!introduced_at_)
        introduced_at_ = time;
    if (begun_ && time - *introduced_at_ >= kLeast) {
        newcomer_ = false;
        introduced_ = true;
        return;
    }
    const bool docked = area_.bottom - area_.top > 2 * area_.title;
    first_use_window(docked ? area_.right : 0.0f);
}

} // namespace isochron::app
