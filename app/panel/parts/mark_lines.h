// The mark in words, and keeping it.
#pragma once

#include "app/panel/panel_model.h"
#include "interaction/commands.h"

#include <vector>

namespace isochron::app {

/// Whether there is a mark that is none of those that were kept.
bool has_loose_mark(const interaction::Settings& settings);

/// The marks with another one under the next free number, and the array whose value it is.
std::vector<interaction::NamedMark> with_mark(std::vector<interaction::NamedMark> marks,
                                              interaction::MarkedPoint point,
                                              const index::SeriesInfo& info);

/// Commands that go to the time of a mark and point it out.
interaction::Commands way_to_mark(const PanelModel& model, const interaction::MarkedPoint& point);

/// A line in the current window while there is a mark: as much of it as there is room for, and what
/// can be done with it. @param width of the line, panel pixels
void mark_lines(const PanelModel& model, float width, interaction::Commands& commands);

} // namespace isochron::app
