// The cells of an extraction that a filter of pieces keeps.
#pragma once

#include "index/extraction/extraction.h"
#include "index/measure/kept_pieces.h"

#include <span>

namespace isochron::index {

/// The kept cells of a surface, without a mesh. @param kept by its mesh
CellSet cells_of_kept(const CellSet& from, const KeptPieces& kept);

/// Removes the cells of mixed levels that stand for no kept cell: those that hold none, and hold some
/// that is not kept, or else have no kept one in the cells of their level around them.
/// @param whole the surfaces' cells of the volume itself @param kept of each of them
void keep_levels(const Grid& grid, std::span<const CellSet> whole, std::span<const KeptPieces> kept,
                 Extraction& coarse);

} // namespace isochron::index
