// Coordinates along an axis, as formats give them, turned into what a grid has.
#pragma once

#include "index/volume/grid.h"

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace isochron::index {

/// Vertices along an axis, spread evenly.
struct AxisSpread {
    double first = 0; ///< where the first vertex lies
    double step = 1;  ///< to the next, on the whole; negative where coordinates fall
    /// `step` between them on the whole, where they are not even: what a note says
    std::optional<std::string> note = {};
};

/// @param label names the axis in messages: `z (lev)`
/// @param unit of the coordinates, for the note; may be empty
/// @throws Error naming the file: coordinates that neither all rise nor all fall
AxisSpread spread_of(const std::vector<double>& at, const std::string& label,
                     const std::string& unit, const std::string& file);

/// Sets the positions of an axis that is not even; spacing and direction are already set.
/// @param factor of the coordinates' unit
void set_positions(Grid& grid, std::size_t axis, const std::vector<double>& at, double factor = 1);

} // namespace isochron::index
