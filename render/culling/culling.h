// Occlusion culling by tiles, for software GL: one search for each kind of cells that hide others.
#pragma once

#include "render/culling/cell_squares.h"
#include "render/culling/picture_tiles.h"

#include <cstddef>
#include <cstdint>

namespace isochron::render {

/// A square of whole pixels of the viewport.
struct PixelSquare {
    std::uint32_t corner = 0; ///< its lower left pixel: x, and y from bit 16 on
    std::uint32_t size = 0;   ///< length of its sides [pixel]; 0 where it is not known
};

/// The cells from number `first`, a multiple of `CellSquares::kBlock`, to `end`.
struct CellRange {
    std::size_t first, end;
};

/// Opaque squares. Each tile of a few pixels has the depth of the nearest square that covers all of
/// it, like a hierarchical z-buffer (Greene, Kass and Miller 1993, doi:10.1145/166117.166147). A
/// cell is hidden if nearer squares cover all tiles that its square may touch.
/// @param seen takes the numbers of the visible cells, in the order of the squares; has room for all
/// @return number of visible cells
std::size_t find_squares(const CellSquares& squares, const TileNumbers& tiles, CellRange range,
                         std::uint32_t* seen);

/// Finds which quads that are cut at their cells are seen.
/// @param parts takes a square around what is seen of each
std::size_t find_cuts(const CellSquares& cuts, const TileNumbers& tiles, CellRange range,
                      std::uint32_t* seen, PixelSquare* parts);

/// Splats. Each tile of one or a few pixels has an upper bound of the light that the nearer splats
/// let through. If this is below half a step of an 8-bit picture in all tiles that a splat may
/// touch, then the splat and everything behind it do not show.
/// @param falloff log2 of the opacity on the footprint's outline, negative; opacity is 1 in the
/// middle
std::size_t find_splats(const CellSquares& splats, float falloff, const TileNumbers& tiles,
                        CellRange range, std::uint32_t* seen);

} // namespace isochron::render
