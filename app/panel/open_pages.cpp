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
    if (pressed && key->key == Key::escape && any() && !io.WantTextInput && !popup) {
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

void OpenPages::lay_out_files() {
    if (auto file = files_.draw())
        chosen_ = std::move(file);
}

Seconds OpenPages::introduction_ends() const {
    constexpr Seconds kLeast{6.0}; // long enough to be read
    return newcomer_ && begun_ && introduced_at_ ? *introduced_at_ + kLeast : Seconds(0);
}

void OpenPages::lay_out(const PanelModel& model, const PanelArea& panel, Seconds time) {
    if (help_ && model.place != PanelPlace::in_room)
        help_ = help_window(model);
    lay_out_files();
    if (!newcomer_ || any() || model.place != PanelPlace::over)
        return;
    if (!introduced_at_)
        introduced_at_ = time;
    if (begun_ && time >= introduction_ends()) {
        newcomer_ = false;
        introduced_ = true;
        return;
    }
    const bool docked = panel.bottom - panel.top > 2 * panel.title;
    first_use_window(docked ? panel.right : 0.0f);
}

} // namespace isochron::app
