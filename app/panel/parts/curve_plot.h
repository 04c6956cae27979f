// A plot of curves over time or over a way: axes with round numbers, lines, and the present time.
#pragma once

#include "index/volume/instant.h"

#include <imgui.h>

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace isochron::app {

/// The numbers of all steps; NaN where there is none.
struct PlottedLine {
    std::span<const double> values;
    ImU32 color;
    bool picked = false; ///< drawn over the others, and thicker
};
/// A number that a line across the plot shows, with a dot wherever a curve crosses it.
struct PlottedLevel {
    double value;
    ImU32 color;
};
struct PlottedCurves {
    std::span<const double> times; ///< times of the steps, or a way, increasing; not empty
    std::string time_unit, unit;
    std::vector<PlottedLine> lines;
    std::vector<PlottedLevel> levels;
    bool logarithmic = false;            ///< numbers above 0 alone are plotted
    std::optional<index::Instant> now{}; ///< none over a way
};

/// What the mouse does with the plot.
struct PlotUse {
    std::optional<std::uint32_t> pointed; ///< step nearest to the mouse
    bool pressed = false;                 ///< the user wants to go there
};

/// Lays the plot out at the cursor. The wheel zooms along the axis of time.
PlotUse curve_plot(const PlottedCurves& curves, const ImVec2& size);

/// Where a curve crosses a level: between which steps, by linear interpolation.
struct Crossing {
    std::uint32_t step; ///< the one before, or at the level
    double share;       ///< way to the next one, 0 to below 1
    bool rises;
};
/// A step at the level counts as above it, as with surfaces.
std::vector<Crossing> crossings_of(std::span<const double> values, double level);

} // namespace isochron::app
