// Occlusion culling of quads that are cut at their cells.
#pragma once

#include "render/culling/cell_squares.h"
#include "render/culling/picture_tiles.h"
#include "render/culling/seen_slots.h"

#include <cstddef>
#include <cstdint>

namespace isochron::render {

/// Finds the visible ones of the cuts from number `from`, a multiple of the block, to `end`.
/// @param seen takes their numbers in the order of the cuts; has room for all of them
/// @param parts takes a square around what is seen of each
/// @return how many these are
std::size_t find_cuts(const CellSquares& cuts, const TileNumbers& tiles, std::size_t from,
                      std::size_t end, std::uint32_t* seen, PixelSquare* parts);

} // namespace isochron::render
