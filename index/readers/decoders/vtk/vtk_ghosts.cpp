// Reads VTK's ghost flags (vtkDataSetAttributes.h: PointGhostTypes, CellGhostTypes).
#include "index/readers/decoders/vtk/vtk_ghosts.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace isochron::index {
namespace {

/// Flags of points and of cells that hide them (vtkDataSetAttributes.h).
constexpr int kDuplicatePoint = 1, kHiddenPoint = 2;
constexpr int kDuplicateCell = 1, kRefinedCell = 8, kHiddenCell = 32;

/// A number for each tuple, not 0 if a flag of `hiding` is set.
std::vector<std::uint8_t> flagged(std::vector<std::uint8_t> flags, int hiding) {
    for (std::uint8_t& flag : flags)
        flag = (flag & hiding) != 0;
    return flags;
}

/// Calls `visit` with each corner of a cell.
template <class Visit>
void at_corners(const Grid& grid, std::uint32_t x, std::uint32_t y, std::uint32_t z, Visit visit) {
    const auto [nx, ny, nz] = grid.vertices;
    for (std::uint32_t corner = 0; corner < 8; ++corner)
        visit((std::size_t{z + (corner >> 2)} * ny + y + (corner >> 1 & 1)) * nx + x +
              (corner & 1));
}

template <class Visit>
void for_each_cell(const Grid& grid, Visit visit) {
    const auto [cx, cy, cz] = grid.cells();
    std::size_t cell = 0;
    for (std::uint32_t z = 0; z < cz; ++z)
        for (std::uint32_t y = 0; y < cy; ++y)
            for (std::uint32_t x = 0; x < cx; ++x)
                visit(cell++, x, y, z);
}

/// Hides vertices so that each of these cells is inactive. A simple rule keeps their number small.
void hide_cells(const std::vector<std::uint8_t>& cells, const Grid& grid,
                std::vector<std::uint8_t>& vertices) {
    std::vector<std::uint8_t> in_sight(grid.vertex_count());
    for_each_cell(grid, [&](std::size_t cell, std::uint32_t x, std::uint32_t y, std::uint32_t z) {
        if (!cells[cell])
            at_corners(grid, x, y, z, [&](std::size_t vertex) { in_sight[vertex] = 1; });
    });
    for (std::size_t i = 0; i < vertices.size(); ++i)
        vertices[i] |= !in_sight[i];
    const std::vector<std::uint8_t> before = vertices;
    for_each_cell(grid, [&](std::size_t cell, std::uint32_t x, std::uint32_t y, std::uint32_t z) {
        if (!cells[cell])
            return;
        bool inactive = false;
        at_corners(grid, x, y, z, [&](std::size_t vertex) { inactive |= before[vertex] != 0; });
        if (!inactive)
            at_corners(grid, x, y, z, [&](std::size_t vertex) { vertices[vertex] = 1; });
    });
}

} // namespace

std::vector<StoredArray> without_flags(std::vector<StoredArray> arrays) {
    const auto flags = std::erase_if(arrays, [](const StoredArray& array) {
        return std::ranges::find(kGhostFlags, array.name) != kGhostFlags.end();
    });
    for (StoredArray& array : arrays)
        array.gaps = flags > 0;
    return arrays;
}

std::uint8_t ghost_flag(std::string_view name, double value) {
    constexpr std::uint8_t kAll = 255;
    // vtkGhostLevels has the distance from the nearest value that is no ghost: not 0 is a ghost.
    if (name != kGhostFlags[0])
        return value != 0 ? kAll : 0;
    return value > 0 && value <= kAll ? static_cast<std::uint8_t>(value) : 0;
}

std::vector<std::uint8_t> hidden_by_flags(GhostFlags flags, const ChosenScalar& chosen,
                                          const Grid& grid) {
    std::vector<std::uint8_t> cells =
        flagged(std::move(flags.cells), kDuplicateCell | kRefinedCell | kHiddenCell);
    if (chosen.array.on_cells)
        return cells;
    std::vector<std::uint8_t> points =
        flagged(std::move(flags.points), kDuplicatePoint | kHiddenPoint);
    if (!cells.empty()) {
        points.resize(grid.vertex_count());
        hide_cells(cells, grid, points);
    }
    return points;
}

std::vector<std::string> notes_on_hidden(std::span<const std::uint8_t> hidden, bool on_cells,
                                         bool resampled) {
    const auto count = std::ranges::count_if(hidden, [](std::uint8_t each) { return each != 0; });
    if (count == 0)
        return {};
    if (resampled)
        return {fmt::format("{} of {} points of the regular grid lie outside the mesh, or in cells "
                            "that it hides: their values are missing",
                            count, hidden.size())};
    return {fmt::format("{} of {} {} are ghosts or blanked: their values are missing", count,
                        hidden.size(), on_cells ? "cells" : "vertices")};
}

} // namespace isochron::index
