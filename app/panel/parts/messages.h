// Messages over the picture: how exact it is, what goes wrong, what is waited for, and questions.
#pragma once

#include "app/frame/desktop_wish.h"
#include "app/panel/panel_model.h"
#include "app/panel/parts/panel_layout.h"
#include "interaction/commands.h"

#include <string>

namespace isochron::app {

/// How exact the picture is: `exact`, `preview 2 of 4`.
struct StateWords {
    std::string words;
    bool exact = false;
};
StateWords state_words(const FrameReport& frame, interaction::QualityMode mode);

/// How the picture is drawn, and why: `settled: surface, 7.2 of 11.1 ms`.
std::string quality_line(const FrameReport& frame);

/// The chip with these words at the upper left of the picture; a click opens and closes the
/// statistics. @param open whether they are open
/// @return right lower corner of the room that the chip takes
glm::vec2 state_chip(const PanelModel& model, const PanelBox& picture, bool& open);
/// The figures behind these words, at the left of the picture. @param top where they begin
/// @param highest more lines are reached by scrolling
/// @return their right lower corner
glm::vec2 statistics_window(const PanelModel& model, const PanelBox& picture, float top,
                            float highest, PanelPages& pages);
/// Where they end at the right.
float statistics_end(const PanelBox& picture);

/// At the lower edge of the picture, between its scale bar and its legend: between which steps the
/// moment lies, or that a gap is held. A low picture has no room for it, nor one whose story's card
/// reaches so far; then the field of the step says it.
/// @param lowest lower end of what lies over the top of the picture
void gap_window(const PanelModel& model, const PanelBox& picture, float lowest);

/// What is said at the top of the picture.
struct Said {
    std::string failure; ///< stays until the user closes it
    std::string standing;
    std::string message; ///< for a moment
};
/// Says it; empty parts are left out. @param free part of the picture, at whose top it begins
/// @param wish with the path that a message names, if the user wants it
/// @return whether the user has closed the failure
bool message_window(const Said& said, const PanelBox& free, DesktopWish& wish);

/// The page on which messages can be read again, with their times.
/// @return whether it stays open
bool messages_page(const PanelModel& model, DesktopWish& wish);

/// Why the picture shows no surface, in the middle of the picture, with its way out as a button; nothing
/// where it shows one. @return whether the way out was chosen
bool empty_card(const PanelModel& model, const PanelBox& picture);
/// The sentence and the button as rows of a panel that has no picture. @return as `empty_card`
bool empty_rows(const PanelModel& model);

/// The progress of something that the user waits for, in the middle of the picture.
/// @param fraction 0 to 1
void progress_window(const std::string& name, const std::string& line, float fraction);
/// Darkens all that was laid out before, and takes the mouse from it: a question follows.
void dim_rest();
/// Shows a question that begins to be asked above all else; it has the keyboard then.
void bring_forward();
/// The question whether to leave the program, in the middle of the picture.
void leaving_window(const PanelModel& model, interaction::Commands& commands);

} // namespace isochron::app
