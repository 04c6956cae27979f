// Counts blocks with active cells, and the cache lines of their values.
#include "tests/bench/measures/touched_lines.h"

#include <algorithm>

namespace isochron::bench {

TouchedBlocks touched_blocks(const std::vector<index::CellId>& ids, const index::Grid& grid,
                             const std::array<std::uint32_t, 3>& edges, std::size_t value_bytes) {
    constexpr std::size_t kLine = 64; // bytes
    const auto cells = grid.cells();
    std::array<std::size_t, 3> across{};
    for (std::size_t axis = 0; axis < 3; ++axis)
        across[axis] = (cells[axis] + edges[axis] - 1) / edges[axis];
    std::vector<bool> held(across[0] * across[1] * across[2]);
    for (const index::CellId id : ids) {
        const auto [x, y, z] = grid.cell_of(id);
        held[(z / edges[2] * across[1] + y / edges[1]) * across[0] + x / edges[0]] = true;
    }
    const std::size_t row = grid.vertices[0], plane = row * grid.vertices[1];
    std::vector<bool> lines(grid.vertex_count() * value_bytes / kLine + 1);
    for (std::size_t block = 0; block < held.size(); ++block) {
        if (!held[block])
            continue;
        const std::array<std::size_t, 3> at{block % across[0], block / across[0] % across[1],
                                            block / across[0] / across[1]};
        std::array<std::size_t, 3> first{}, last{}; // vertices
        for (std::size_t axis = 0; axis < 3; ++axis) {
            first[axis] = at[axis] * edges[axis];
            last[axis] = std::min<std::size_t>(first[axis] + edges[axis], cells[axis]);
        }
        for (std::size_t z = first[2]; z <= last[2]; ++z)
            for (std::size_t y = first[1]; y <= last[1]; ++y) {
                const std::size_t start = z * plane + y * row;
                const std::size_t end = ((start + last[0] + 1) * value_bytes - 1) / kLine;
                for (std::size_t line = (start + first[0]) * value_bytes / kLine; line <= end;
                     ++line)
                    lines[line] = true;
            }
    }
    return {held.size(), static_cast<std::size_t>(std::ranges::count(held, true)),
            static_cast<std::uint64_t>(std::ranges::count(lines, true)) * kLine};
}

} // namespace isochron::bench
