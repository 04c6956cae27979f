// The histogram of all values, with a line for each surface that the user drags.
#pragma once

#include "app/panel/panel_model.h"
#include "interaction/commands.h"

#include <imgui.h>

#include <cstdint>
#include <vector>

namespace isochron::app {

/// Lays it out across the section. A press near a line takes that surface's line; elsewhere it takes
/// the picked surface's. Counts are linear or logarithmic, as the user chose in this panel.
void histogram(const PanelModel& model, interaction::Commands& commands);

/// How many values the columns stand for: the bins of the histogram. Where there are fewer whole
/// numbers than bins, the column of each number reaches to the next one.
std::vector<std::uint64_t> column_counts(const PanelModel& model);

/// The color of a surface, so that its line and swatch are seen on the panel.
ImU32 line_color(const interaction::Isosurface& surface);
/// Light lines have a dark rim and dark ones a light rim, so that each is seen on any columns.
ImU32 rim_of(ImU32 color);

} // namespace isochron::app
