// Marking and copying of bricks.
#include "index/extraction/volume_bricks.h"

#include "index/volume/cell_walk.h"

#include <xxhash.h>

#include <algorithm>
#include <cstring>

namespace isochron::index {
namespace {

/// Bricks of a cell's two vertices along one axis, first and last.
std::array<std::uint32_t, 2> inner(std::uint32_t cell) {
    return {cell / kBrickEdge, (cell + 1) / kBrickEdge};
}
/// Of these and their outer neighbors.
std::array<std::uint32_t, 2> outer(std::uint32_t cell, std::uint32_t vertices) {
    return {(cell == 0 ? 0 : cell - 1) / kBrickEdge, std::min(cell + 2, vertices - 1) / kBrickEdge};
}

/// Rows of a brick that lies within the grid, as they are stored: a row at a time, of known size.
template <std::size_t kRow>
void copy_rows(const std::byte* from, std::size_t row, std::size_t slice, std::byte* out) {
    for (std::uint32_t z = 0; z < kBrickEdge; ++z)
        for (std::uint32_t y = 0; y < kBrickEdge; ++y, out += kRow)
            std::memcpy(out, from + z * slice + y * row, kRow);
}

} // namespace

BrickTiling::BrickTiling(const Grid& grid) {
    std::ranges::transform(grid.vertices, bricks.begin(),
                           [](std::uint32_t n) { return (n + kBrickEdge - 1) / kBrickEdge; });
}

BrickGatherer::BrickGatherer(const Grid& grid, const BrickValues& values)
    : grid_(grid), tiling_(grid), values_(values), needed_(tiling_.count()),
      row_inner_(tiling_.bricks[0]), row_outer_(tiling_.bricks[0]) {}

void BrickGatherer::need(std::span<const CellId> cells) {
    const auto& n = grid_.vertices;
    CellWalk walk(grid_);
    std::uint32_t y = 0, z = 0;
    for (const CellId id : cells) {
        const bool new_row = walk.to(id);
        if (new_row && id != cells.front())
            mark_row(y, z);
        y = walk.y(), z = walk.z();
        const auto near_x = inner(walk.x()), wide_x = outer(walk.x(), n[0]);
        row_inner_[near_x[0]] = row_inner_[near_x[1]] = 1;
        row_outer_[wide_x[0]] = row_outer_[wide_x[1]] = 1;
    }
    if (!cells.empty())
        mark_row(y, z);
}

/// Marks what the cells of a row need, of which the bricks along x are known, and forgets them.
void BrickGatherer::mark_row(std::uint32_t y, std::uint32_t z) {
    const auto mark = [&](const std::vector<std::uint8_t>& row, const auto& ys, const auto& zs) {
        for (std::uint32_t at_z = zs[0]; at_z <= zs[1]; ++at_z)
            for (std::uint32_t at_y = ys[0]; at_y <= ys[1]; ++at_y) {
                std::uint8_t* needed =
                    needed_.data() +
                    (std::size_t{at_z} * tiling_.bricks[1] + at_y) * tiling_.bricks[0];
                for (std::size_t x = 0; x < row.size(); ++x)
                    needed[x] |= row[x];
            }
    };
    mark(row_outer_, inner(y), inner(z));
    mark(row_inner_, outer(y, grid_.vertices[1]), inner(z));
    mark(row_inner_, inner(y), outer(z, grid_.vertices[2]));
    std::ranges::fill(row_inner_, std::uint8_t{0});
    std::ranges::fill(row_outer_, std::uint8_t{0});
}

void BrickGatherer::copy(const std::byte* first, BrickId brick, const BrickLevels& levels,
                         std::byte* out) const {
    const auto& n = grid_.vertices;
    const auto& tiles = tiling_.bricks;
    const std::array<std::uint32_t, 3> at{brick % tiles[0] * kBrickEdge,
                                          brick / tiles[0] % tiles[1] * kBrickEdge,
                                          brick / tiles[0] / tiles[1] * kBrickEdge};
    const std::size_t stored = size_of(values_.stored()), held = size_of(values_.held());
    const bool inside =
        at[0] + kBrickEdge <= n[0] && at[1] + kBrickEdge <= n[1] && at[2] + kBrickEdge <= n[2];
    if (inside && values_.stored() == values_.held()) {
        const std::size_t row = n[0] * stored, slice = n[1] * row;
        const std::byte* from = first + at[2] * slice + at[1] * row + at[0] * stored;
        switch (stored) {
        case 1: return copy_rows<kBrickEdge>(from, row, slice, out);
        case 2: return copy_rows<2 * kBrickEdge>(from, row, slice, out);
        default: return copy_rows<4 * kBrickEdge>(from, row, slice, out);
        }
    }
    const std::uint32_t width = std::min(kBrickEdge, n[0] - at[0]);
    for (std::uint32_t z = at[2]; z < std::min(at[2] + kBrickEdge, n[2]); ++z)
        for (std::uint32_t y = at[1]; y < std::min(at[1] + kBrickEdge, n[1]); ++y) {
            const std::size_t from = (std::size_t{z} * n[1] + y) * n[0] + at[0];
            const std::size_t to = ((z - at[2]) * kBrickEdge + (y - at[1])) * kBrickEdge;
            values_.convert(first + from * stored, width, levels, out + to * held);
        }
}

VolumeBricks BrickGatherer::none() const {
    VolumeBricks bricks;
    bricks.held = values_.held();
    bricks.factor = values_.factor();
    bricks.range = values_.range();
    return bricks;
}

bool BrickGatherer::gather(const StepValues& step, std::uint32_t number, const BrickLevels& levels,
                           VolumeBricks& bricks, const std::stop_token& stop) {
    bricks = none();
    for (auto at = needed_.begin(); (at = std::find(at, needed_.end(), 1)) != needed_.end(); ++at) {
        bricks.ids.push_back(static_cast<BrickId>(at - needed_.begin()));
        *at = 0;
    }
    const std::size_t size = bricks.brick_bytes();
    bricks.bytes.assign(bricks.ids.size() * size, std::byte{0});
    bricks.digests.resize(bricks.ids.size());
    const std::byte* first = step.step_bytes(number).data();
    for (std::size_t i = 0; i < bricks.ids.size(); ++i) {
        if (i % 256 == 0 && stop.stop_requested())
            return false;
        copy(first, bricks.ids[i], levels, bricks.bytes.data() + i * size);
        const XXH128_hash_t hash = XXH3_128bits(bricks.bytes.data() + i * size, size);
        bricks.digests[i] = {hash.low64, hash.high64};
    }
    return true;
}

} // namespace isochron::index
