// Messages over the picture: how exact it is, what goes wrong, what is waited for, and questions.
#pragma once

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
/// statistics below it. @param open whether they are open
/// @return the right end of the chip
float state_chip(const PanelModel& model, const PanelBox& picture, bool& open);

/// At the lower edge of the picture, between its scale bar and its legend: between which steps the
/// moment lies, or that a gap is held.
void gap_window(const PanelModel& model, const PanelBox& picture);

/// What is said at the top of the picture.
struct Said {
    std::string failure; ///< stays until the user closes it
    std::string standing;
    std::string message; ///< for a moment
};
/// Says it; empty parts are left out. @param top lowest place where it may begin
/// @return whether the user has closed the failure
bool message_window(const Said& said, const PanelBox& picture, float top);

/// Why the picture shows no surface, in the middle of the picture, with its way out as a button; nothing
/// where it shows one. @param least how far below the picture's upper edge its middle is, at least
/// @return whether the way out was chosen
bool empty_card(const PanelModel& model, const PanelBox& picture, float least);
/// The sentence and the button as rows of a panel that has no picture. @return as `empty_card`
bool empty_rows(const PanelModel& model);

/// The progress of something that the user waits for, in the middle of the picture.
/// @param fraction 0 to 1
void progress_window(const std::string& name, const std::string& line, float fraction);
/// The question whether to leave the program, in the middle of the picture.
void leaving_window(const PanelModel& model, interaction::Commands& commands);

} // namespace isochron::app
