// Marks and copies volume blocks.
#include "index/extraction/volume_blocks.h"

#include "index/system/huge_pages.h"
#include "index/system/parallel.h"
#include "index/volume/cell_walk.h"

#include <xxhash.h>

#include <algorithm>
#include <bit>
#include <cstring>
#include <iterator>
#include <utility>

namespace isochron::index {
namespace {

static_assert(kChunkEdge % kBlockEdge == 0);
constexpr std::uint32_t kAcross = kChunkEdge / kBlockEdge; ///< blocks of a chunk along each axis

/// Blocks keep at most so many memories of earlier ones, and so many bytes beside twice their own.
constexpr std::size_t kMostMemories = 16;
constexpr std::uint64_t kSpare = 1 << 20;

/// First and last block of a cell's two vertices along one axis.
std::array<std::uint32_t, 2> inner(std::uint32_t cell) {
    return {cell / kBlockEdge, (cell + 1) / kBlockEdge};
}
/// The blocks of a cell's vertices and their outer neighbors.
std::array<std::uint32_t, 2> outer(std::uint32_t cell, std::uint32_t vertices) {
    return {(cell == 0 ? 0 : cell - 1) / kBlockEdge, std::min(cell + 2, vertices - 1) / kBlockEdge};
}

void set_bits(std::vector<std::uint64_t>& bits, const std::array<std::uint32_t, 2>& places) {
    for (const std::uint32_t place : places)
        bits[place / 64] |= std::uint64_t{1} << place % 64;
}

/// Copies the rows of a block inside the grid, as stored; the size of a row is a constant.
template <std::size_t kRow>
void copy_rows(const std::byte* from, std::size_t row, std::size_t slice, std::byte* out) {
    for (std::uint32_t z = 0; z < kBlockEdge; ++z)
        for (std::uint32_t y = 0; y < kBlockEdge; ++y, out += kRow)
            std::memcpy(out, from + z * slice + y * row, kRow);
}

} // namespace

std::vector<std::byte> VolumeBlocks::joined() const {
    std::vector<std::byte> all;
    for (std::size_t i = 0; i < ids.size(); ++i)
        all.insert(all.end(), block(i).begin(), block(i).end());
    return all;
}

BlockTiling::BlockTiling(const Grid& grid) {
    std::ranges::transform(grid.vertices, blocks.begin(),
                           [](std::uint32_t n) { return (n + kBlockEdge - 1) / kBlockEdge; });
}

BlockGatherer::BlockGatherer(const Grid& grid, const BlockValues& values)
    : grid_(grid), tiling_(grid), values_(values), row_words_((tiling_.blocks[0] + 63) / 64),
      needed_(row_words_ * tiling_.blocks[1] * tiling_.blocks[2]), row_inner_(row_words_),
      row_outer_(row_words_) {}

void BlockGatherer::need(const CellSet& set) {
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

/// Marks the blocks of cells whose places ascend from row to row.
template <class PlaceOf>
void BlockGatherer::mark(std::size_t cells, PlaceOf&& place_of) {
    std::uint32_t y = 0, z = 0;
    for (std::size_t i = 0; i < cells; ++i) {
        const auto [at_x, at_y, at_z] = place_of(i);
        if (i > 0 && (at_y != y || at_z != z))
            mark_row(y, z);
        y = at_y, z = at_z;
        const auto near_x = inner(at_x), wide_x = outer(at_x, grid_.vertices[0]);
        set_bits(row_inner_, near_x);
        set_bits(row_outer_, wide_x);
    }
    if (cells > 0)
        mark_row(y, z);
}

/// Marks the blocks that the cells of a row need, from its blocks along x, and clears these.
void BlockGatherer::mark_row(std::uint32_t y, std::uint32_t z) {
    const auto mark = [&](const std::vector<std::uint64_t>& row, const auto& ys, const auto& zs) {
        for (std::uint32_t at_z = zs[0]; at_z <= zs[1]; ++at_z)
            for (std::uint32_t at_y = ys[0]; at_y <= ys[1]; ++at_y) {
                std::uint64_t* const needed =
                    needed_.data() + (std::size_t{at_z} * tiling_.blocks[1] + at_y) * row_words_;
                for (std::size_t word = 0; word < row_words_; ++word)
                    needed[word] |= row[word];
            }
    };
    mark(row_outer_, inner(y), inner(z));
    mark(row_inner_, outer(y, grid_.vertices[1]), inner(z));
    mark(row_inner_, inner(y), outer(z, grid_.vertices[2]));
    std::ranges::fill(row_inner_, std::uint64_t{0});
    std::ranges::fill(row_outer_, std::uint64_t{0});
}

/// The stored values of a block: the first one, strides, and the number along each axis.
struct BlockGatherer::Box {
    const std::byte* first;
    std::size_t row, plane; ///< bytes from one to the next
    std::array<std::uint32_t, 3> size;
};

/// Coordinates of a block, in blocks.
std::array<std::uint32_t, 3> BlockGatherer::at(BlockId block) const {
    const auto& n = tiling_.blocks;
    return {block % n[0], block / n[0] % n[1], block / n[0] / n[1]};
}

void BlockGatherer::copy(const Box& from, const BlockLevels& levels, std::byte* out,
                         BlockDigest& digest) const {
    const std::size_t held = size_of(values_.held()), bytes = kBlockVertices * held;
    const bool inside =
        from.size == std::array<std::uint32_t, 3>{kBlockEdge, kBlockEdge, kBlockEdge};
    if (inside && values_.stored() == values_.held()) {
        switch (held) {
        case 1: copy_rows<kBlockEdge>(from.first, from.row, from.plane, out); break;
        case 2: copy_rows<2 * kBlockEdge>(from.first, from.row, from.plane, out); break;
        default: copy_rows<4 * kBlockEdge>(from.first, from.row, from.plane, out);
        }
    } else {
        if (!inside)
            std::fill_n(out, bytes, std::byte{0});
        for (std::uint32_t z = 0; z < from.size[2]; ++z)
            for (std::uint32_t y = 0; y < from.size[1]; ++y)
                values_.convert(from.first + z * from.plane + y * from.row, from.size[0], levels,
                                out + (z * kBlockEdge + y) * kBlockEdge * held);
    }
    const XXH128_hash_t hash = XXH3_128bits(out, bytes);
    digest = {hash.low64, hash.high64};
}

VolumeBlocks BlockGatherer::none() const {
    VolumeBlocks blocks;
    blocks.held = values_.held();
    blocks.factor = values_.factor();
    blocks.range = values_.range();
    return blocks;
}

void BlockGatherer::take_marked(VolumeBlocks& blocks) {
    blocks = none();
    for (std::size_t at = 0; at < needed_.size(); ++at) {
        const std::size_t first = at / row_words_ * tiling_.blocks[0] + at % row_words_ * 64;
        for (std::uint64_t bits = std::exchange(needed_[at], 0); bits; bits &= bits - 1)
            blocks.ids.push_back(
                static_cast<BlockId>(first + static_cast<std::size_t>(std::countr_zero(bits))));
    }
    blocks.places.resize(blocks.ids.size());
    blocks.digests.resize(blocks.ids.size());
}

bool BlockGatherer::gather(const StepView& step, const BlockLevels& levels, VolumeBlocks& blocks,
                           const std::stop_token& stop, const KnownBlocks& known) {
    return step.by_chunks() ? gather_chunks(step, levels, blocks, stop, known)
                            : gather_whole(step.whole(stop).values, step.at(), levels, blocks, stop,
                                           known, known.blocks ? &step.chunk_grid() : nullptr);
}

bool BlockGatherer::gather(const StepValues& step, Instant at_step, const BlockLevels& levels,
                           VolumeBlocks& blocks, const std::stop_token& stop) {
    return gather_whole(step, at_step, levels, blocks, stop, {}, nullptr);
}

/// @param chunks null if no blocks are known
bool BlockGatherer::gather_whole(const StepValues& step, Instant at_step, const BlockLevels& levels,
                                 VolumeBlocks& blocks, const std::stop_token& stop,
                                 const KnownBlocks& known, const ChunkGrid* chunks) {
    take_marked(blocks);
    const Room room = take_known(known, chunks, blocks);
    const std::byte* first = step.step_bytes(at_step.step).data();
    const auto& n = grid_.vertices;
    const std::size_t size = size_of(values_.stored()), row = n[0] * size, plane = n[1] * row;
    for (std::size_t k = 0; k < room.others.size(); ++k) {
        if (k % 256 == 0 && stop.stop_requested())
            return false;
        const std::uint32_t i = room.others[k];
        Box box{first, row, plane, {}};
        auto corner = at(blocks.ids[i]);
        for (std::size_t axis = 0; axis < 3; ++axis) {
            corner[axis] *= kBlockEdge;
            box.size[axis] = std::min(kBlockEdge, n[axis] - corner[axis]);
        }
        box.first += corner[2] * plane + corner[1] * row + corner[0] * size;
        copy(box, levels, room.first + k * blocks.block_bytes(), blocks.digests[i]);
    }
    return true;
}

/// Takes over the blocks that are known, and finds room for all others.
/// @param chunks null if none are known
BlockGatherer::Room BlockGatherer::take_known(const KnownBlocks& known, const ChunkGrid* chunks,
                                              VolumeBlocks& blocks) const {
    Room room;
    std::size_t at_known = 0;
    for (std::uint32_t i = 0; i < blocks.ids.size(); ++i) {
        const BlockId id = blocks.ids[i];
        while (known.blocks && at_known < known.blocks->ids.size() &&
               known.blocks->ids[at_known] < id)
            ++at_known;
        const auto [x, y, z] = at(id);
        if (known.blocks && at_known < known.blocks->ids.size() &&
            known.blocks->ids[at_known] == id &&
            known.staying->has(z / kAcross, chunks->place(x / kAcross, y / kAcross))) {
            blocks.places[i] = known.blocks->places[at_known];
            blocks.digests[i] = known.blocks->digests[at_known];
        } else {
            room.others.push_back(i);
        }
    }
    const std::size_t bytes = blocks.block_bytes();
    if (room.others.size() < blocks.ids.size())
        blocks.memory = known.blocks->memory;
    std::uint64_t held = room.others.size() * bytes;
    for (const BlockMemory& memory : blocks.memory)
        held += memory.bytes;
    // Memory of earlier blocks may hold many that are no longer needed.
    const bool copies = held > 2 * blocks.bytes() + kSpare || blocks.memory.size() >= kMostMemories;
    const std::size_t count = copies ? blocks.ids.size() : room.others.size();
    LargeMemory memory = large_memory(count * bytes);
    room.first = memory.get();
    std::byte* to = room.first + room.others.size() * bytes;
    for (std::uint32_t i = 0, other = 0; copies && i < blocks.ids.size(); ++i) {
        if (other < room.others.size() && room.others[other] == i) {
            ++other;
            continue;
        }
        std::memcpy(to, blocks.places[i], bytes);
        blocks.places[i] = to;
        to += bytes;
    }
    if (copies)
        blocks.memory.clear();
    for (std::size_t k = 0; k < room.others.size(); ++k)
        blocks.places[room.others[k]] = room.first + k * bytes;
    if (count > 0) {
        const std::shared_ptr<std::byte[]> owner(std::move(memory));
        blocks.memory.push_back(
            {std::shared_ptr<const std::byte>(owner, owner.get()), count * bytes});
    }
    return room;
}

bool BlockGatherer::gather_chunks(const StepView& step, const BlockLevels& levels,
                                  VolumeBlocks& blocks, const std::stop_token& stop,
                                  const KnownBlocks& known) {
    take_marked(blocks);
    const Room room = take_known(known, &step.chunk_grid(), blocks);
    const std::vector<std::uint32_t>& others = room.others;
    const std::size_t bytes = blocks.block_bytes();
    const auto id_of = [&](std::uint32_t i) { return blocks.ids[i]; };
    const std::size_t size = size_of(values_.stored());
    const std::uint64_t layer_blocks =
        std::uint64_t{tiling_.blocks[0]} * tiling_.blocks[1] * kAcross;
    parallel_for(
        step.chunk_grid().layers(), thread_count(0),
        [&](std::size_t layer, unsigned) {
            const auto first = std::ranges::lower_bound(others, layer * layer_blocks, {}, id_of);
            const auto last = std::ranges::lower_bound(first, others.end(),
                                                       (layer + 1) * layer_blocks, {}, id_of);
            if (first == last || stop.stop_requested())
                return;
            const auto place_of = [&](std::uint32_t i) {
                const auto [x, y, z] = at(blocks.ids[i]);
                return step.chunk_grid().place(x / kAcross, y / kAcross);
            };
            std::vector<std::uint32_t> places;
            std::transform(first, last, std::back_inserter(places), place_of);
            std::ranges::sort(places);
            places.erase(std::unique(places.begin(), places.end()), places.end());
            const auto at_layer = static_cast<std::uint32_t>(layer);
            step.expect(at_layer, {&places, 1});
            const auto found = step.chunks(at_layer, places, stop);
            for (auto block = first; block != last; ++block) {
                if ((block - first) % 256 == 0 && stop.stop_requested())
                    return;
                const auto place = std::ranges::lower_bound(places, place_of(*block));
                const Chunk& chunk = *found[static_cast<std::size_t>(place - places.begin())];
                auto corner = at(blocks.ids[*block]);
                Box box{chunk.values.data(),
                        chunk.size[0] * size,
                        chunk.size[0] * chunk.size[1] * size,
                        {}};
                for (std::size_t axis = 0; axis < 3; ++axis) {
                    corner[axis] = corner[axis] % kAcross * kBlockEdge;
                    box.size[axis] = std::min(kBlockEdge, chunk.size[axis] - corner[axis]);
                }
                box.first += corner[2] * box.plane + corner[1] * box.row + corner[0] * size;
                copy(box, levels,
                     room.first + static_cast<std::size_t>(block - others.begin()) * bytes,
                     blocks.digests[*block]);
            }
        },
        {});
    return !stop.stop_requested();
}

} // namespace isochron::index
