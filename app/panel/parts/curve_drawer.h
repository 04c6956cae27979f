// The drawer of curves: numbers of the shown surfaces over all steps, plotted and as a table.
#pragma once

#include "app/panel/panel_model.h"
#include "interaction/commands.h"

#include <string>
#include <string_view>

namespace isochron::app {

/// A measure's name, for people: `volume below`.
std::string words_of_measure(std::string_view name);

/// Lays it out across the current window: what is plotted, the plot, and beside it the numbers of the
/// present step. A press on the plot goes to a step, a press on a line of the table plots its measure.
void curve_drawer(const PanelModel& model, interaction::Commands& commands);

} // namespace isochron::app
