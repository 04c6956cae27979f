// Rows for written pictures and movies: what they show, their size and their folder.
#pragma once

#include "app/panel/panel_model.h"
#include "interaction/commands.h"

#include <optional>

namespace isochron::app {

/// Rows of the parts and the size of pictures, in the current window.
void picture_rows(const PanelModel& model, interaction::Commands& commands);

/// A row with the folder of all that a session writes.
void folder_row(interaction::WrittenPictures& pictures);

/// Rows about movies, and buttons that make them or give one up. @return what the user wants
std::optional<MovieWish> movie_rows(const PanelModel& model, interaction::Commands& commands);

} // namespace isochron::app
