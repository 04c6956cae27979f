// The panel's sections on tools, undo and leaving.
#pragma once

#include "app/panel/panel_model.h"
#include "interaction/commands.h"
#include "interaction/pose.h"

#include <optional>
#include <string>

namespace isochron::app {

/// Undo and redo.
void history_section(const PanelModel& model, interaction::Commands& commands);
/// The tools of mouse and hands, and their results.
void tools_section(const PanelModel& model, interaction::Commands& commands);
/// Marks the steps that can be shown without a search, below the slider that was laid out last.
/// @param last step
void mark_steps_at_hand(const PanelModel& model, int last);
/// Buttons that start movies, and the progress of the movie that is being made.
/// @return what the user wants
std::optional<MovieWish> movie_section(const PanelModel& model);
/// At the bottom of the picture: the standing note, and the newest message. Empty ones are left out.
void message_window(const std::string& standing, const std::string& message);
/// The progress of something that the user waits for, in the middle of the picture.
/// @param fraction 0 to 1
void progress_window(const std::string& name, const std::string& line, float fraction);
/// The question whether to leave the program, in the middle of the picture.
void leaving_window(const PanelModel& model, interaction::Commands& commands);

} // namespace isochron::app
