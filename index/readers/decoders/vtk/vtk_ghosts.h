// Finds values that VTK's ghost flags hide: of points and cells that belong to a neighboring piece,
// or are blanked.
#pragma once

#include "index/readers/formats/stored_scalar.h"

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace isochron::index {

/// The names of arrays of flags; the second is from VTK before 6.3.
inline constexpr std::array<const char*, 2> kGhostFlags{"vtkGhostType", "vtkGhostLevels"};

/// Removes the arrays of flags from a list. If there were some, marks the other arrays as arrays in
/// which values may be missing.
std::vector<StoredArray> without_flags(std::vector<StoredArray> arrays);

/// Flags of an image's points and cells, one for each; empty where there are none.
struct GhostFlags {
    std::vector<std::uint8_t> points, cells;
};

/// The flag of a value in one of `kGhostFlags`, which may have any type.
std::uint8_t ghost_flag(std::string_view name, double value);

/// One number for each tuple of the chosen array, not 0 if a flag hides it; empty if the image has
/// no flags. A vertex is hidden if its own point is flagged, or all cells around it are. If a
/// flagged cell would then still have no hidden vertex, all its vertices are hidden.
std::vector<std::uint8_t> hidden_by_flags(GhostFlags flags, const ChosenScalar& chosen,
                                          const Grid& grid);

/// `1,331 of 8,000 vertices are hidden by ...`; nothing if none is hidden.
std::vector<std::string> notes_on_hidden(std::span<const std::uint8_t> hidden, bool on_cells,
                                         bool resampled = false);

} // namespace isochron::index
