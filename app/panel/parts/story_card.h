// The card of a story: the text of the step that is told, and the way to the other steps.
#pragma once

#include "app/panel/panel_model.h"
#include "app/panel/parts/panel_layout.h"
#include "interaction/commands.h"

namespace isochron::app {

/// Lays the card out at the lower left of the picture, with a line to the place that its text is
/// about; nothing while no story is told. A text that is too long is scrolled.
/// @param lowest lower end of what lies over the top of the picture, below which the card stays
/// @return whether one is told
bool story_card(const PanelModel& model, const PanelBox& picture, float lowest,
                interaction::Commands& commands);
/// How far it reaches to the right; the left end of the picture while no story is told.
float story_card_end(const PanelModel& model, const PanelBox& picture);

/// Lays the step's text and buttons out in the current window, for panels without a picture.
void story_rows(const PanelModel& model, interaction::Commands& commands);

} // namespace isochron::app
