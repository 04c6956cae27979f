// The pages that lie over the picture beside the panel: help, the choice of data, the search of
// commands, and the introduction.
#pragma once

#include "app/frame/desktop_wish.h"
#include "app/panel/array_window.h"
#include "app/panel/file_window.h"
#include "app/panel/panel.h"
#include "app/panel/parts/key_search.h"
#include "app/panel/parts/tour.h"
#include "interaction/commands.h"
#include "interaction/input/window_event.h"
#include "interaction/pose.h"

#include <cstddef>
#include <filesystem>
#include <functional>
#include <optional>
#include <utility>
#include <vector>

namespace isochron::app {

class OpenPages {
  public:
    /// Shows the introduction's lines from now on, until the user begins.
    void introduce() { newcomer_ = true; }
    /// Offers to go on with a session before, until the user answers or changes something.
    void offer_earlier() { offers_earlier_ = true; }
    /// The session with which the user goes on; returned once.
    std::optional<OfferedSession> take_continued() { return std::exchange(continued_, {}); }
    /// The user goes on with this session. @param session empty: with none
    void go_on_with(const PanelModel& model, const std::optional<std::size_t>& session);
    /// Asks for the name of this session.
    void ask_session_name() { asks_name_ = true; }
    /// The name that the user has given; returned once.
    std::optional<std::string> take_session_name() { return std::exchange(session_name_, {}); }
    /// Shows what an emulated room is, until the user has read it.
    void explain_room() { explains_room_ = true; }
    /// Whether the user has read it since the last call.
    bool room_explained() { return std::exchange(room_explained_, false); }
    /// The user has pressed a key or a button.
    void begin() { begun_ = true; }
    /// Whether the introduction has gone since the last call.
    bool introduced() { return std::exchange(introduced_, false); }

    /// Lets the user open other data. @param recent returns the recently opened data
    void offer_files(std::function<std::vector<std::filesystem::path>()> recent) {
        recent_ = std::move(recent);
    }
    bool offers_files() const { return static_cast<bool>(recent_); }
    void offer_beside_files(FileWindow::Offers offers) { files_.offer(std::move(offers)); }
    /// Opens the page where the user chooses data.
    void open_files() { files_.open(recent_()); }
    void open_files_again() { files_.open_again(); } ///< at the folder where the page was left
    /// The data that the user has chosen; returned once.
    std::optional<std::filesystem::path> take_chosen() { return std::exchange(chosen_, {}); }

    /// Lets the user open the data anew with an array that cannot be shown with these.
    void offer_arrays(std::vector<ListedArray> others) { others_ = std::move(others); }
    bool offers_arrays() const { return !others_.empty(); }
    /// Opens the page with all arrays.
    void open_arrays();
    /// The array of `offer_arrays` that the user has chosen; returned once.
    std::optional<std::string> take_chosen_array() { return std::exchange(chosen_array_, {}); }

    /// When the introduction may go, as the user has begun; else a time that has passed.
    interaction::Seconds introduction_ends() const;

    void open_help() { help_ = true; }
    void open_messages() { messages_ = true; }
    /// What the user wants of the desktop; returned once.
    DesktopWish take_desktop_wish() { return std::exchange(desktop_wish_, {}); }
    DesktopWish& desktop_wish() { return desktop_wish_; }
    void open_search() { search_.open(); }
    void close_search() { search_.close(); }
    /// The field for the session's name is over the picture.
    bool shows_name() const { return asks_name_ && !any(); }
    /// A page or a card with a field that takes what is typed.
    bool takes_text() const {
        return !leaving_ && (search_.is_open() || files_.is_open() || shows_name());
    }
    /// A page with a list, through which the arrow keys go.
    bool has_list() const { return takes_text() || lists_arrays_; }
    /// Does what a key does, as if the user had pressed it.
    void press(interaction::Action action);
    /// The key events of the command that the user found; returned once.
    std::vector<interaction::WindowEvent> take_presses() { return std::exchange(presses_, {}); }
    bool has_presses() const { return !presses_.empty(); }

    /// The command that the user found on the panel in the room; returned once.
    std::optional<interaction::Action> take_action() { return std::exchange(action_, {}); }

    /// What the user found that is not on a page: a section to point at, the figures, a movie.
    struct FoundControl {
        std::optional<std::size_t>
            section; ///< section of the panel; kSections: the bar of the time
        bool statistics = false;
        std::optional<MovieWish> movie;
    };
    /// Returned once.
    FoundControl take_found() { return std::exchange(found_, {}); }

    /// Whether the user is asked whether to quit.
    bool leaving() const { return leaving_; }

    /// Whether cards have come, gone or changed in the last layout: Dear ImGui shows new windows late.
    bool turned() const { return turned_; }

    /// A page lies over the picture, which Escape closes; cards are no pages.
    bool any() const {
        return help_ || messages_ || search_.is_open() || files_.is_open() || lists_arrays_;
    }

    /// Obeys F1, `?`, Ctrl + K, Ctrl + O and Ctrl + Shift + A, wherever the mouse is, Escape, which
    /// closes a page, and Enter, which takes the way out of an empty picture.
    /// @param popup a popup is open, which Escape closes before a page
    /// @return whether the event was one of them
    bool turn(const interaction::WindowEvent& event, bool popup);

    /// Lays the pages out in the current Dear ImGui frame.
    /// @param picture where the panel leaves the picture free
    /// @param lowest what lies at the top of the picture ends there
    /// @return commands of the user
    interaction::Commands lay_out(const PanelModel& model, const PanelBox& picture, float lowest,
                                  interaction::Seconds time);
    /// Lays out the choice of data alone.
    void lay_out_files();
    ArrayWindow& arrays() { return arrays_; }

  private:
    void introduce(const PanelBox& picture, interaction::Seconds time);
    interaction::Commands way_out(const PanelModel& model, const PanelBox& picture);
    void lay_out_name(const PanelBox& picture, float top);
    bool turn_with_control(interaction::Key key, bool shift);
    bool answer_by(const interaction::WindowEvent& event);
    interaction::Commands run(const SearchLine& found, bool in_room);
    interaction::Commands lay_out_arrays(const PanelModel& model, const PanelBox& picture);

    bool help_ = false, messages_ = false; ///< these pages are open
    DesktopWish desktop_wish_;
    FileWindow files_;
    ArrayWindow arrays_;
    bool lists_arrays_ = false; ///< the page with all arrays is open
    std::vector<ListedArray> others_;
    std::optional<std::string> chosen_array_;
    bool has_session_ = false; ///< there are data, whose arrays can be listed
    KeySearch search_;
    std::vector<interaction::WindowEvent> presses_;
    std::optional<interaction::Action> action_;
    FoundControl found_;
    std::function<std::vector<std::filesystem::path>()>
        recent_; ///< empty: the user cannot open other data
    std::optional<std::filesystem::path> chosen_;
    bool newcomer_ = false, begun_ = false, introduced_ = false;
    bool explains_room_ = false, room_explained_ = false;
    bool shows_room_ = false;      ///< the last layout had its explanation
    bool leaving_ = false;         ///< the user is asked whether to quit
    bool asks_ = false;            ///< the last layout had the question of the sessions before
    Answer answer_ = Answer::none; ///< answer to it by a key
    Tour tour_;
    bool offers_way_out_ = false, takes_way_out_ = false;
    bool turned_ = false;
    std::size_t cards_ = 0;       ///< number of cards in the last layout
    bool offers_earlier_ = false; ///< the sessions before are offered
    std::optional<OfferedSession> continued_;
    bool asks_name_ = false; ///< the question for the session's name is open
    std::string name_;       ///< in its field
    std::optional<std::string> session_name_;
    std::optional<interaction::Seconds> introduced_at_; ///< when the introduction appeared
};

} // namespace isochron::app
