// The pages that lie over the picture beside the panel.
#include "app/panel/open_pages.h"

#include "app/panel/panel_help.h"

#include <imgui.h>

#include <utility>
#include <variant>

namespace isochron::app {

using interaction::Key;
using interaction::KeyEvent;
using interaction::Seconds;
using interaction::TextEvent;
using interaction::WindowEvent;

bool OpenPages::turn(const WindowEvent& event, bool popup) {
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
    const bool escapes = pressed && key->key == Key::escape && !popup;
    if (escapes && search_.is_open()) {
        search_.close();
        return true;
    }
    if (escapes && any() && !io.WantTextInput) {
        if (files_.is_open())
            files_.close();
        else
            help_ = false;
        return true;
    }
    const bool chord =
        key && key->down && (io.KeyCtrl || key->with(interaction::Modifier::control)) &&
        !key->with(interaction::Modifier::alt) && !key->with(interaction::Modifier::super);
    if (chord && key->key == Key{'K'}) {
        if (search_.is_open())
            search_.close();
        else
            search_.open();
        begun_ = true;
        return true;
    }
    if (!chord || key->key != Key{'O'} || !recent_)
        return false;
    open_files();
    return true;
}

void OpenPages::lay_out_files() {
    if (auto file = files_.draw())
        chosen_ = std::move(file);
}

Seconds OpenPages::introduction_ends() const {
    constexpr Seconds kLeast{6.0}; // long enough to be read
    return newcomer_ && begun_ && introduced_at_ ? *introduced_at_ + kLeast : Seconds(0);
}

void OpenPages::lay_out(const PanelModel& model, const PanelBox& picture, Seconds time) {
    if (help_ && model.place != PanelPlace::in_room)
        help_ = help_window(model);
    lay_out_files();
    if (model.place != PanelPlace::in_room)
        if (auto presses = search_.draw(picture); !presses.empty())
            presses_ = std::move(presses);
    if (!newcomer_ || any() || model.place != PanelPlace::over)
        return;
    if (!introduced_at_)
        introduced_at_ = time;
    if (begun_ && time >= introduction_ends()) {
        newcomer_ = false;
        introduced_ = true;
        return;
    }
    first_use_window(picture);
}

} // namespace isochron::app
