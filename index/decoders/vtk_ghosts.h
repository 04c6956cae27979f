// What VTK's ghost flags hide: points and cells that belong to a neighbor's piece, or are blanked.
#pragma once

#include "index/formats/stored_scalar.h"

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

class vtkDataSet;

namespace isochron::index {

/// The arrays of flags; the second is that of VTK before 6.3.
inline constexpr std::array<const char*, 2> kGhostFlags{"vtkGhostType", "vtkGhostLevels"};

/// Nobody is offered the flags; where there are some, values of the others may be missing.
std::vector<StoredArray> without_flags(std::vector<StoredArray> arrays);

/// One number for each tuple of the chosen array, not 0 where a flag hides it; empty where an image
/// has no flags. Values at vertices are hidden where a point is, where all cells around it are, and
/// at every corner of a cell that would not be hidden by that.
/// @param image with its arrays of flags read
std::vector<std::uint8_t> hidden_by_flags(vtkDataSet& image, const ChosenScalar& chosen,
                                          const Grid& grid);

/// `1,331 of 8,000 vertices are hidden by ...`; nothing where none is.
std::vector<std::string> notes_on_hidden(std::span<const std::uint8_t> hidden, bool on_cells);

} // namespace isochron::index
