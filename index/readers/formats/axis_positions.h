// Turns coordinates along an axis, as files give them, into origin and spacing of a grid.
#pragma once

#include "index/volume/grid.h"

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace isochron::index {

/// How the vertices along an axis are spread.
struct AxisSpread {
    double first = 0;    ///< coordinate of the first vertex
    double step = 1;     ///< mean distance to the next; negative if coordinates decrease
    bool uneven = false; ///< the grid needs positions, see `set_positions`
    /// A note for the user, if the coordinates are far from even.
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

/// An axis' name as it is shown: `longitude (degrees)`; without a unit of its own the name alone.
std::string with_own_unit(const std::string& name, const std::string& unit);

} // namespace isochron::index
