// Marks and copies volume bricks.
#include "index/extraction/volume_bricks.h"

#include "index/system/parallel.h"
#include "index/volume/cell_walk.h"

#include <xxhash.h>

#include <algorithm>
#include <cstring>
#include <iterator>

namespace isochron::index {
namespace {

/// First and last brick of a cell's two vertices along one axis.
std::array<std::uint32_t, 2> inner(std::uint32_t cell) {
    return {cell / kBrickEdge, (cell + 1) / kBrickEdge};
}
/// The same for the vertices and their outer neighbors.
std::array<std::uint32_t, 2> outer(std::uint32_t cell, std::uint32_t vertices) {
    return {(cell == 0 ? 0 : cell - 1) / kBrickEdge, std::min(cell + 2, vertices - 1) / kBrickEdge};
}

/// Copies the rows of a brick inside the grid, as stored; the size of a row is a constant.
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

void BrickGatherer::need(const CellSet& set) {
    if (has_wide_ids(grid_))
        return mark(set.points.size(), [&](std::size_t i) -> std::array<std::uint32_t, 3> {
            const CellPoint& point = set.points[i];
            return {point.x, point.y, point.z};
        });
    CellWalk walk(grid_);
    mark(set.ids.size(), [&](std::size_t i) -> std::array<std::uint32_t, 3> {
        walk.to(set.ids[i]);
        return {walk.x(), walk.y(), walk.z()};
    });
}

/// Marks the bricks of cells whose places ascend from row to row.
template <class PlaceOf>
void BrickGatherer::mark(std::size_t cells, PlaceOf&& place_of) {
    std::uint32_t y = 0, z = 0;
    for (std::size_t i = 0; i < cells; ++i) {
        const auto [at_x, at_y, at_z] = place_of(i);
        if (i > 0 && (at_y != y || at_z != z))
            mark_row(y, z);
        y = at_y, z = at_z;
        const auto near_x = inner(at_x), wide_x = outer(at_x, grid_.vertices[0]);
        row_inner_[near_x[0]] = row_inner_[near_x[1]] = 1;
        row_outer_[wide_x[0]] = row_outer_[wide_x[1]] = 1;
    }
    if (cells > 0)
        mark_row(y, z);
}

/// Marks the bricks that the cells of a row need, from its bricks along x, and clears these.
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

/// The stored values of a brick: the first one, strides, and the number along each axis.
struct BrickGatherer::Box {
    const std::byte* first;
    std::size_t row, plane; ///< bytes from one to the next
    std::array<std::uint32_t, 3> size;
};

/// Coordinates of a brick, in bricks.
std::array<std::uint32_t, 3> BrickGatherer::at(BrickId brick) const {
    const auto& n = tiling_.bricks;
    return {brick % n[0], brick / n[0] % n[1], brick / n[0] / n[1]};
}

void BrickGatherer::copy(const Box& from, const BrickLevels& levels, VolumeBricks& bricks,
                         std::size_t i) const {
    const std::size_t held = size_of(values_.held()), bytes = bricks.brick_bytes();
    std::byte* out = bricks.bytes.data() + i * bytes;
    const bool inside =
        from.size == std::array<std::uint32_t, 3>{kBrickEdge, kBrickEdge, kBrickEdge};
    if (inside && values_.stored() == values_.held()) {
        switch (held) {
        case 1: copy_rows<kBrickEdge>(from.first, from.row, from.plane, out); break;
        case 2: copy_rows<2 * kBrickEdge>(from.first, from.row, from.plane, out); break;
        default: copy_rows<4 * kBrickEdge>(from.first, from.row, from.plane, out);
        }
    } else {
        for (std::uint32_t z = 0; z < from.size[2]; ++z)
            for (std::uint32_t y = 0; y < from.size[1]; ++y)
                values_.convert(from.first + z * from.plane + y * from.row, from.size[0], levels,
                                out + (z * kBrickEdge + y) * kBrickEdge * held);
    }
    const XXH128_hash_t hash = XXH3_128bits(out, bytes);
    bricks.digests[i] = {hash.low64, hash.high64};
}

VolumeBricks BrickGatherer::none() const {
    VolumeBricks bricks;
    bricks.held = values_.held();
    bricks.factor = values_.factor();
    bricks.range = values_.range();
    return bricks;
}

void BrickGatherer::take_marked(VolumeBricks& bricks) {
    bricks = none();
    for (auto it = needed_.begin(); (it = std::find(it, needed_.end(), 1)) != needed_.end(); ++it) {
        bricks.ids.push_back(static_cast<BrickId>(it - needed_.begin()));
        *it = 0;
    }
    bricks.bytes.assign(bricks.ids.size() * bricks.brick_bytes(), std::byte{0});
    bricks.digests.resize(bricks.ids.size());
}

bool BrickGatherer::gather(const StepView& step, const BrickLevels& levels, VolumeBricks& bricks,
                           const std::stop_token& stop) {
    return step.by_chunks() ? gather_chunks(step, levels, bricks, stop)
                            : gather(step.whole(stop).values, step.at(), levels, bricks, stop);
}

bool BrickGatherer::gather(const StepValues& step, Instant at_step, const BrickLevels& levels,
                           VolumeBricks& bricks, const std::stop_token& stop) {
    take_marked(bricks);
    const std::byte* first = step.step_bytes(at_step).data();
    const auto& n = grid_.vertices;
    const std::size_t size = size_of(values_.stored()), row = n[0] * size, plane = n[1] * row;
    for (std::size_t i = 0; i < bricks.ids.size(); ++i) {
        if (i % 256 == 0 && stop.stop_requested())
            return false;
        Box box{first, row, plane, {}};
        auto corner = at(bricks.ids[i]);
        for (std::size_t axis = 0; axis < 3; ++axis) {
            corner[axis] *= kBrickEdge;
            box.size[axis] = std::min(kBrickEdge, n[axis] - corner[axis]);
        }
        box.first += corner[2] * plane + corner[1] * row + corner[0] * size;
        copy(box, levels, bricks, i);
    }
    return true;
}

bool BrickGatherer::gather_chunks(const StepView& step, const BrickLevels& levels,
                                  VolumeBricks& bricks, const std::stop_token& stop) {
    static_assert(kChunkEdge % kBrickEdge == 0);
    constexpr std::uint32_t kAcross = kChunkEdge / kBrickEdge;
    take_marked(bricks);
    const std::size_t size = size_of(values_.stored());
    const std::uint64_t layer_bricks =
        std::uint64_t{tiling_.bricks[0]} * tiling_.bricks[1] * kAcross;
    parallel_for(
        step.chunk_grid().layers(), thread_count(0),
        [&](std::size_t layer, unsigned) {
            const auto first = std::ranges::lower_bound(bricks.ids, layer * layer_bricks);
            const auto last =
                std::ranges::lower_bound(first, bricks.ids.end(), (layer + 1) * layer_bricks);
            if (first == last || stop.stop_requested())
                return;
            const auto place_of = [&](BrickId brick) {
                const auto [x, y, z] = at(brick);
                return step.chunk_grid().place(x / kAcross, y / kAcross);
            };
            std::vector<std::uint32_t> places;
            std::transform(first, last, std::back_inserter(places), place_of);
            std::ranges::sort(places);
            places.erase(std::unique(places.begin(), places.end()), places.end());
            const auto at_layer = static_cast<std::uint32_t>(layer);
            step.expect(at_layer, places);
            const auto found = step.chunks(at_layer, places, stop);
            for (auto brick = first; brick != last; ++brick) {
                if ((brick - first) % 256 == 0 && stop.stop_requested())
                    return;
                const auto place = std::ranges::lower_bound(places, place_of(*brick));
                const Chunk& chunk = *found[static_cast<std::size_t>(place - places.begin())];
                auto corner = at(*brick);
                Box box{chunk.values.data(),
                        chunk.size[0] * size,
                        chunk.size[0] * chunk.size[1] * size,
                        {}};
                for (std::size_t axis = 0; axis < 3; ++axis) {
                    corner[axis] = corner[axis] % kAcross * kBrickEdge;
                    box.size[axis] = std::min(kBrickEdge, chunk.size[axis] - corner[axis]);
                }
                box.first += corner[2] * box.plane + corner[1] * box.row + corner[0] * size;
                copy(box, levels, bricks, static_cast<std::size_t>(brick - bricks.ids.begin()));
            }
        },
        {});
    return !stop.stop_requested();
}

} // namespace isochron::index
