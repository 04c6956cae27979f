// Fills slabs with chunks.
#include "index/search/step_slab.h"

#include "index/scan/bricks.h"
#include "index/search/chunk_reach.h"
#include "index/volume/cell_walk.h"

#include <algorithm>
#include <bit>
#include <cassert>
#include <cstring>
#include <utility>

namespace isochron::index {
namespace {

/// Planes of a slab: a chunk's planes, and for cells and normals one below and two above.
constexpr std::uint32_t kMostPlanes = kChunkEdge + 3;

/// Chunks next to each other along x: the addresses of their values, and their number.
struct Neighbors {
    static constexpr std::size_t kMost = 8; ///< streams that a processor can prefetch
    std::array<const std::byte*, kMost> from;
    std::size_t count = 0;
};

template <std::size_t kWidth>
void copy_rows_of(const Neighbors& chunks, std::size_t offset, std::uint32_t rows, std::byte* to,
                  std::size_t stride) {
    for (std::uint32_t y = 0; y < rows; ++y, offset += kWidth, to += stride)
        for (std::size_t i = 0; i < chunks.count; ++i)
            std::memcpy(to + i * kWidth, chunks.from[i] + offset, kWidth);
}

/// Copies contiguous rows, at `offset` bytes in the chunks, to rows `stride` bytes apart. Copies a
/// row of all chunks before the next, since the next row is in another part of the memory. The
/// usual widths are compile-time constants.
void copy_rows(const Neighbors& chunks, std::size_t offset, std::size_t width, std::uint32_t rows,
               std::byte* to, std::size_t stride) {
    switch (width) {
    case kChunkEdge: return copy_rows_of<kChunkEdge>(chunks, offset, rows, to, stride);
    case 2 * kChunkEdge: return copy_rows_of<2 * kChunkEdge>(chunks, offset, rows, to, stride);
    case 4 * kChunkEdge: return copy_rows_of<4 * kChunkEdge>(chunks, offset, rows, to, stride);
    case 8 * kChunkEdge: return copy_rows_of<8 * kChunkEdge>(chunks, offset, rows, to, stride);
    default: break;
    }
    for (std::uint32_t y = 0; y < rows; ++y, offset += width, to += stride)
        for (std::size_t i = 0; i < chunks.count; ++i)
            std::memcpy(to + i * width, chunks.from[i] + offset, width);
}

} // namespace

std::uint64_t StepSlab::bytes(const Grid& grid, ValueType type) {
    const auto& n = grid.vertices;
    return std::uint64_t{n[0]} * n[1] * std::min(n[2], kMostPlanes) * size_of(type);
}

/// Gets memory for a step, unless there is enough from an earlier one.
void StepSlab::fit(const StepView& step) {
    step_ = &step;
    chunks_ = &step.chunk_grid();
    plane_cells_ = step.grid().cells()[0] * step.grid().cells()[1];
    if (const std::uint64_t wanted = bytes(step.grid(), step.type()); wanted > room_) {
        values_ = large_memory(wanted);
        room_ = wanted;
    }
}

void StepSlab::begin(const StepView& step, std::uint32_t layer, std::stop_token stop) {
    fit(step);
    for (auto& of_layer : state_)
        of_layer.assign(chunks_->chunks_of_layer(), std::uint8_t{vacant});
    whole_ = false;
    stop_ = std::move(stop);
    layer_ = layer;
    const std::uint32_t first = layer * kChunkEdge;
    first_plane_ = first - (layer > 0 ? 1 : 0);
    end_plane_ = std::min(first + kChunkEdge + 2, step.grid().vertices[2]);
}

StepValues StepSlab::planes(std::uint32_t first, std::uint32_t end) const {
    StepValues values{.grid = step_->grid().planes(first, end),
                      .type = step_->type(),
                      .scaling = step_->scaling(),
                      .steps = step_->steps(),
                      .first_step = step_->at().step};
    const std::uint64_t plane =
        std::uint64_t{step_->grid().vertices[0]} * step_->grid().vertices[1] * size_of(values.type);
    values.first = values_.get() + (first - first_plane_) * plane;
    values.stride = (end - first) * plane;
    return values;
}

StepValues StepSlab::cells() const {
    const std::uint32_t first = layer_ * kChunkEdge;
    return planes(first, std::min(first + kChunkEdge + 1, step_->grid().vertices[2]));
}
StepValues StepSlab::around() const {
    return planes(first_plane_, end_plane_);
}

StepPart StepSlab::part() {
    return {.cells = cells(),
            .first_cell = first_cell(),
            .around = around(),
            .first_around = first_around(),
            .first_plane = first_plane_,
            .bricks = whole_ ? bricks() : std::span<const std::uint8_t>(),
            .slab = this};
}

StepPart StepPart::planes(std::uint32_t first, std::uint32_t end) const {
    StepPart some = *this;
    const auto& n = cells.grid.vertices;
    some.cells.grid = cells.grid.planes(first, end + 1);
    some.cells.first += std::uint64_t{n[0]} * n[1] * first * size_of(cells.type);
    some.first_cell += cells.grid.cells()[0] * cells.grid.cells()[1] * first;
    some.bricks = {};
    return some;
}

void StepSlab::forget_bricks() {
    const BrickGrid grid(cells().grid);
    bricks_.assign(grid.bytes_per_step(), 0);
    std::fill_n(bricks_.begin(), grid.count(), std::uint8_t{255});
}

void StepSlab::set_bricks(const Chunk& chunk, std::uint32_t x, std::uint32_t y,
                          BricksOfChunk candidates) {
    const BrickGrid grid(cells().grid);
    const auto& n = grid.bricks();
    for (; candidates; candidates &= candidates - 1) {
        const auto i = static_cast<std::uint32_t>(std::countr_zero(candidates));
        const std::uint32_t bx = x * kChunkBricks[0] + i % kChunkBricks[0];
        const std::uint32_t by = y * kChunkBricks[1] + i / kChunkBricks[0] % kChunkBricks[1];
        const std::uint32_t bz = i / kChunkBricks[0] / kChunkBricks[1];
        if (bx >= n[0] || by >= n[1] || bz >= n[2])
            continue; // only a damaged file says that there are cells
        const std::size_t brick = (std::size_t{bz} * n[1] + by) * n[0] + bx;
        bricks_[brick] = chunk.bricks[i];
        bricks_[grid.count() + brick] = chunk.bricks[kBricksOfChunk + i];
    }
}

/// Marks for each chunk the sides at which it has cells, then the chunks that these need.
void StepSlab::fill_around(std::span<const CellId> cells, bool normals) {
    if (whole_)
        return;
    const auto& n = chunks_->counts();
    sides_.assign(std::size_t{n[0]} * n[1], 0);
    CellWalk walk(around().grid);
    std::uint64_t* of_row = nullptr;
    unsigned row_side = 0;
    for (const CellId id : cells) {
        if (walk.to(id)) {
            const std::uint32_t y = walk.y(), z = walk.z() + first_plane_;
            assert(z / kChunkEdge == layer_);
            row_side = kSides * (kSide[y % kChunkEdge] + kSides * kSide[z % kChunkEdge]);
            of_row = sides_.data() + std::size_t{y / kChunkEdge} * n[0];
        }
        const std::uint32_t x = walk.x();
        of_row[x / kChunkEdge] |= std::uint64_t{1} << (row_side + kSide[x % kChunkEdge]);
    }
    for (std::uint32_t i = 0; i < sides_.size(); ++i)
        for_each_around(chunks_around(sides_[i], normals), {i % n[0], i / n[0], layer_}, *chunks_,
                        [&](std::uint32_t, std::uint32_t x, std::uint32_t y, std::uint32_t layer) {
                            need(x, y, layer);
                        });
    fill();
}

void StepSlab::begin_whole(const StepView& step, std::uint32_t layer, std::stop_token stop) {
    begin(step, layer, std::move(stop));
    whole_ = true;
    if (layer < layers(step.grid()))
        forget_bricks();
}

void StepSlab::put(const Chunk& chunk, std::uint32_t place, BricksOfChunk candidates) {
    const auto [x, y] = chunks_->at(place);
    set_bricks(chunk, x, y, candidates);
    const std::size_t size = size_of(step_->type()), width = chunk.size[0] * size;
    const std::size_t row = step_->grid().vertices[0] * size,
                      plane = step_->grid().vertices[1] * row;
    const Neighbors alone{{chunk.values.data()}, 1};
    std::byte* to = values_.get() + (layer_ * kChunkEdge - first_plane_) * plane +
                    y * kChunkEdge * row + x * kChunkEdge * size;
    for (std::uint32_t z = 0; z < chunk.size[2]; ++z, to += plane)
        copy_rows(alone, z * chunk.size[1] * width, width, chunk.size[1], to, row);
}

void StepSlab::fill_from(const StepSlab& next) {
    const std::uint32_t bottom = next.layer_ * kChunkEdge;
    const std::uint32_t first = std::max(bottom, first_plane_);
    const std::uint32_t end = std::min(bottom + kChunkEdge, end_plane_);
    const std::size_t plane =
        std::size_t{step_->grid().vertices[0]} * step_->grid().vertices[1] * size_of(step_->type());
    std::memcpy(values_.get() + (first - first_plane_) * plane,
                next.values_.get() + (first - next.first_plane_) * plane, (end - first) * plane);
}

void StepSlab::fill_all() {
    const std::uint32_t end = std::min(layer_ + 2, chunks_->layers());
    for (std::uint32_t layer = layer_; layer < end; ++layer)
        for (std::uint8_t& state : state_[layer + 1 - layer_])
            if (state == vacant)
                state = needed;
    fill();
}

/// Reads the needed chunks and copies them to their places.
void StepSlab::fill() {
    std::array<std::vector<std::uint32_t>, 3> places;
    for (std::uint32_t i = 0; i < state_.size(); ++i) {
        for (std::uint32_t place = 0; place < state_[i].size(); ++place)
            if (state_[i][place] == needed)
                places[i].push_back(place);
    }
    step_->expect(layer_ - 1, places); // all of them before waiting for any
    for (std::uint32_t i = 0; i < state_.size(); ++i) {
        if (places[i].empty())
            continue;
        const std::uint32_t layer = layer_ + i - 1;
        copy(layer, places[i], step_->chunks(layer, places[i], stop_));
    }
}

/// Copies chunks into the slab, as far as it reaches, unless they are filled already.
void StepSlab::copy(std::uint32_t layer, std::span<const std::uint32_t> places,
                    std::span<const ChunkPtr> chunks) {
    std::vector<std::uint8_t>& state = state_[layer + 1 - layer_];
    by_column_.assign(state.size(), nullptr);
    const std::uint32_t across = chunks_->counts()[0];
    for (std::size_t i = 0; i < places.size(); ++i)
        if (std::uint8_t& of_chunk = state[places[i]]; of_chunk != filled) {
            const auto [x, y] = chunks_->at(places[i]);
            by_column_[std::size_t{y} * across + x] = chunks[i].get();
            of_chunk = filled;
        }
    const std::size_t size = size_of(step_->type());
    const std::size_t row = step_->grid().vertices[0] * size,
                      plane = step_->grid().vertices[1] * row;
    const std::uint32_t bottom = layer * kChunkEdge;
    const std::uint32_t first = std::max(bottom, first_plane_);
    for (std::uint32_t i = 0; i < by_column_.size();) {
        const Chunk* const chunk = by_column_[i];
        if (!chunk) {
            ++i;
            continue;
        }
        const std::uint32_t x = i % across, y = i / across;
        Neighbors neighbors;
        do {
            neighbors.from[neighbors.count++] = by_column_[i++]->values.data();
        } while (neighbors.count < Neighbors::kMost && i % across != 0 && by_column_[i] &&
                 by_column_[i]->size == chunk->size);
        const std::size_t width = chunk->size[0] * size;
        const std::uint32_t end = std::min(bottom + chunk->size[2], end_plane_);
        auto* const out = values_.get() + y * kChunkEdge * row + x * kChunkEdge * size;
        for (std::uint32_t z = first; z < end; ++z)
            copy_rows(neighbors, (z - bottom) * chunk->size[1] * width, width, chunk->size[1],
                      out + (z - first_plane_) * plane, row);
    }
}

} // namespace isochron::index
