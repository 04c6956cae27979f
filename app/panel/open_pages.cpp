// The pages that lie over the picture beside the panel.
#include "app/panel/open_pages.h"

#include "app/panel/panel_help.h"
#include "app/panel/parts/messages.h"
#include "app/panel/parts/story_card.h"
#include "app/text.h"

#include <imgui.h>

#include <algorithm>
#include <variant>

namespace isochron::app {

using interaction::Key;
using interaction::KeyEvent;
using interaction::Seconds;
using interaction::TextEvent;
using interaction::WindowEvent;

/// Keys answer a question and do nothing else, except for Ctrl + Q.
/// @return whether the event is an answer, or nothing that may be done now
bool OpenPages::answer_by(const WindowEvent& event) {
    const auto* key = std::get_if<KeyEvent>(&event);
    if (!key || !key->down)
        return std::holds_alternative<TextEvent>(event);
    if (key->key == Key::enter || key->key == Key::escape)
        answer_ = key->key == Key::enter ? Answer::yes : Answer::no;
    const bool modifier = key->key == Key::left_control || key->key == Key::right_control;
    return !modifier && !(key->key == Key{'Q'} && key->with(interaction::Modifier::control));
}

bool OpenPages::turn(const WindowEvent& event, bool popup) {
    if (leaving_) // Enter and Escape answer, as keys of the session
        return false;
    if (asks_ && !popup)
        return answer_by(event);
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
    // The fields of these two pages have the keyboard all the time.
    if (escapes && shows_name()) {
        asks_name_ = false;
        name_.clear();
        return true;
    }
    if (escapes && search_.is_open()) {
        search_.close();
        return true;
    }
    if (escapes && files_.is_open()) {
        files_.close();
        return true;
    }
    if (escapes && lists_arrays_) {
        lists_arrays_ = false;
        return true;
    }
    const bool reads = pressed && (key->key == Key::enter || key->key == Key::escape);
    if (reads && shows_room_ && !any() && !popup && !io.WantTextInput) {
        shows_room_ = explains_room_ = false;
        return room_explained_ = true;
    }
    if (escapes && (help_ || messages_) && !io.WantTextInput) {
        help_ = messages_ = false;
        return true;
    }
    if (pressed && key->key == Key::enter && offers_way_out_ && !popup && !io.WantTextInput) {
        takes_way_out_ = true;
        return true;
    }
    const bool chord =
        key && key->down && (io.KeyCtrl || key->with(interaction::Modifier::control)) &&
        !key->with(interaction::Modifier::alt) && !key->with(interaction::Modifier::super);
    return chord && turn_with_control(key->key, io.KeyShift);
}

/// @return whether the combination with Ctrl opens or closes a page
bool OpenPages::turn_with_control(Key key, bool shift) {
    if (key == Key{'K'}) {
        if (search_.is_open())
            search_.close();
        else
            search_.open();
        begun_ = true;
        return true;
    }
    if (key == Key{'A'} && shift && has_session_) {
        if (!std::exchange(lists_arrays_, false))
            open_arrays();
        begun_ = true;
        return true;
    }
    if (key != Key{'O'} || !recent_)
        return false;
    open_files();
    return true;
}

void OpenPages::press(interaction::Action action) {
    const auto& all = key_commands();
    if (const auto key = std::ranges::find(all, action, &KeyCommand::action); key != all.end())
        presses_ = presses_of(*key);
}

void OpenPages::open_arrays() {
    lists_arrays_ = true;
    arrays_.begin_anew();
}

/// Does what a line of the search stands for. @return its commands
interaction::Commands OpenPages::run(const SearchLine& found, bool in_room) {
    found_ = {.section = found.section,
              .statistics = found.page == SearchPage::statistics,
              .movie = found.movie};
    if (found.page == SearchPage::help)
        open_help();
    if (found.page == SearchPage::messages)
        open_messages();
    if (found.page == SearchPage::room)
        explain_room();
    if (found.press && !in_room)
        presses_ = presses_of(*found.press);
    else if (found.press && found.press->action)
        action_ = found.press->action;
    else if (found.press)
        open_arrays();
    return found.commands;
}

/// The arrays that can be shown as they are, and those for which the data are opened anew.
interaction::Commands OpenPages::lay_out_arrays(const PanelModel& model, const PanelBox& picture) {
    const PanelArrays& shown = model.arrays;
    std::vector<ListedArray> lines(shown.lines.begin(), shown.lines.end());
    if (lines.empty())
        lines.push_back({model.info.array, grid_words(model.info), model.info.value_unit, {}, {}});
    const std::size_t here = lines.size();
    lines.insert(lines.end(), others_.begin(), others_.end());
    bool left = false;
    const auto chosen =
        model.place == PanelPlace::in_room
            ? arrays_.draw_in_room(picture, lines, shown.asked, left)
            : arrays_.draw({.question = others_.empty() ? "Which array should be shown?"
                                                        : "Which array should be shown? With "
                                                          "another grid, the data are opened anew.",
                            .values = "values",
                            .button = "Show (Enter)"},
                           lines, shown.asked);
    if (chosen || left)
        lists_arrays_ = false;
    if (chosen && *chosen >= here)
        chosen_array_ = lines[*chosen].name;
    return chosen && *chosen < here && *chosen != shown.asked ? shown.way_to(*chosen)
                                                              : interaction::Commands();
}

void OpenPages::lay_out_files() {
    if (auto file = files_.draw())
        chosen_ = std::move(file);
}

Seconds OpenPages::introduction_ends() const {
    constexpr Seconds kLeast{6.0}; // long enough to be read
    return newcomer_ && begun_ && introduced_at_ ? *introduced_at_ + kLeast : Seconds(0);
}

interaction::Commands OpenPages::lay_out(const PanelModel& model, const PanelBox& picture,
                                         float lowest, Seconds time) {
    interaction::Commands commands;
    has_session_ = true;
    turned_ = std::exchange(leaving_, model.asked.leaving) != leaving_;
    asks_ = shows_room_ = false;
    if (leaving_ && model.place != PanelPlace::in_room) { // nothing beside it takes keys
        offers_way_out_ = takes_way_out_ = false;
        return commands;
    }
    if (help_ && model.place != PanelPlace::in_room) {
        const HelpAnswer answer = help_window(model);
        help_ = answer.stays;
        if (answer.tour)
            tour_.start();
    }
    if (messages_)
        messages_ = messages_page(model, desktop_wish_);
    lay_out_files();
    if (const auto found = search_.draw(model, picture)) {
        commands = run(*found, model.place == PanelPlace::in_room);
        go_on_with(model, found->session);
    }
    if (lists_arrays_)
        interaction::merge(commands, lay_out_arrays(model, picture));
    const bool took = std::exchange(takes_way_out_, false) && model.notes.empty;
    offers_way_out_ = false;
    if (took)
        interaction::merge(commands, model.notes.empty->commands);
    if (any() || model.place != PanelPlace::over)
        return commands;
    if (model.ways.undo || model.sessions.empty()) // going on now would take back what was changed
        offers_earlier_ = false;
    if (asks_name_) {
        lay_out_name(picture, lowest);
    } else if (offers_earlier_) {
        std::size_t chosen = 0;
        asks_ = true;
        const Answer by_key = std::exchange(answer_, Answer::none);
        const Answer clicked = earlier_card(picture, model.sessions, chosen);
        const Answer answer = clicked == Answer::none ? by_key : clicked;
        if (answer == Answer::yes) {
            commands = model.sessions[chosen].commands;
            go_on_with(model, chosen);
        }
        offers_earlier_ = answer == Answer::none;
    }
    asks_ = asks_ && offers_earlier_;
    const bool told = story_card(model, picture, lowest, commands);
    if (!asks_name_ && !asks_)
        interaction::merge(commands, way_out(model, picture));
    if (has_room_for(kTourCard, picture, lowest))
        tour_.draw(model, picture);
    shows_room_ = explains_room_ && has_room_for(kRoomCard, picture, lowest);
    if (shows_room_ && room_card(picture)) {
        shows_room_ = explains_room_ = false;
        room_explained_ = true;
    }
    if (!explains_room_ && !told && has_room_for(kHintCard, picture, lowest))
        introduce(picture, time);
    const std::size_t cards = 32 * tour_.step() + (explains_room_ ? 16 : 0) + (asks_name_ ? 8 : 0) +
                              (offers_earlier_ ? 4 : 0) + (newcomer_ ? 2 : 0) +
                              (model.notes.empty ? 1 : 0);
    turned_ |= std::exchange(cards_, cards) != cards;
    return commands;
}

/// Says why nothing is seen, and offers the way out. @return the commands of the way out
interaction::Commands OpenPages::way_out(const PanelModel& model, const PanelBox& picture) {
    const bool chosen = empty_card(model, picture);
    offers_way_out_ = model.notes.empty && !model.notes.empty->way.empty();
    return chosen ? model.notes.empty->commands : interaction::Commands();
}

void OpenPages::go_on_with(const PanelModel& model, const std::optional<std::size_t>& session) {
    if (session && *session < model.sessions.size())
        continued_ = model.sessions[*session];
}

void OpenPages::lay_out_name(const PanelBox& picture, float top) {
    const Answer answer = name_card(picture, top, name_);
    if (answer == Answer::none)
        return;
    asks_name_ = false;
    const std::size_t first = name_.find_first_not_of(' '), last = name_.find_last_not_of(' ');
    if (answer == Answer::yes && first != name_.npos)
        session_name_ = name_.substr(first, last - first + 1);
    name_.clear();
}

/// The hint for newcomers, who may ask for the tour there.
void OpenPages::introduce(const PanelBox& picture, Seconds time) {
    if (!newcomer_ || tour_.goes_on())
        return;
    if (!introduced_at_)
        introduced_at_ = time;
    bool held = false;
    const Answer answer = hint_card(picture, held);
    if (answer == Answer::yes)
        tour_.start();
    const bool over = begun_ && !held && time >= introduction_ends();
    if (answer == Answer::none && !over)
        return;
    newcomer_ = false;
    introduced_ = true;
}

} // namespace isochron::app
