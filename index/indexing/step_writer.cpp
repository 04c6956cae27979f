// Packs a step and its levels of detail.
#include "index/indexing/step_writer.h"

#include "index/file/sections/step_levels.h"
#include "index/indexing/value_extremes.h"
#include "index/scan/bricks.h"
#include "index/system/parallel.h"

#include <algorithm>
#include <utility>

namespace isochron::index {
namespace {

constexpr std::size_t kWorthThreads = 1 << 20; ///< [bytes] of a layer for which threads pay

} // namespace

StepWriter::Level::Level(const Grid& level_grid, ValueType type, const ChunkContents& contents,
                         const WriterMeans& means)
    : grid(level_grid), packer(grid, type, contents.codec, means.threads, contents.wide_rows),
      coarseners(means.threads, Coarsener(type, grid)), chooser(type),
      waiting(grid.vertex_count() * size_of(type), means.waiting_bytes, means.beside) {
    if (!has_step_levels(type))
        map = LevelMap::of_type(type);
}

StepWriter::StepWriter(const SeriesInfo& info, const ChunkContents& contents,
                       const WriterMeans& means)
    : type_(info.type), contents_(contents), threads_(means.threads), lends_(means.lends),
      own_levels_(contents.bricks && has_step_levels(type_)) {
    for (const Grid& grid : detail_grids(info.grid))
        levels_.emplace_back(grid, type_, contents, means);
    if (!contents.since)
        for (Level& level : levels_)
            level.packer.write_without_since();
}

void StepWriter::begin_at(std::uint32_t step) {
    for (Level& level : levels_)
        level.packer.begin_at(step);
}

std::vector<std::uint32_t> StepWriter::since() const {
    std::vector<std::uint32_t> all;
    for (const Level& level : levels_)
        all.insert(all.end(), level.packer.history().since.begin(),
                   level.packer.history().since.end());
    return all;
}

void StepWriter::set_since(std::span<const std::uint32_t> since) {
    for (Level& level : levels_) {
        std::vector<std::uint32_t>& own = level.packer.history().since;
        std::ranges::copy(since.first(own.size()), own.begin());
        since = since.subspan(own.size());
    }
}

void StepWriter::for_each_table(std::size_t level, const StepEntry& entry,
                                const TablePlace& f) const {
    std::size_t before = 0;
    for (std::size_t finer = 0; finer < level; ++finer)
        before += ChunkGrid(levels_[finer].grid).count();
    const ChunkGrid chunks(levels_[level].grid);
    const std::uint32_t count = chunks.chunks_of_layer();
    for (std::uint32_t layer = 0; layer < chunks.layers(); ++layer)
        f(entry.tables + layer * layer_table_bytes(count), count,
          before + std::size_t{layer} * count);
}

/// Whether planes of a level wait until the step is complete. Those of the finest level do only if
/// its bricks' levels depend on all its values.
bool StepWriter::waits(std::size_t level) const {
    return level > 0 || own_levels_;
}

void StepWriter::look(Level& level, std::uint32_t first_plane,
                      std::span<const std::byte> planes) const {
    if (!own_levels_)
        return;
    const std::size_t plane = std::size_t{level.grid.vertices[0]} * level.grid.vertices[1];
    const std::size_t first = first_plane * plane;
    if (contents_.since)
        add_extremes(type_, planes, level.extremes);
    level.chooser.add({first, first + planes.size() / size_of(type_), level.grid.vertex_count()},
                      planes);
}

void StepWriter::take(const LayerView& layer, PartWriter& parts, std::vector<StepEntry>& entries) {
    if (layer.begin == 0)
        begin_ = parts.align(kPartAlignment);
    if (waits(0)) {
        look(levels_[0], layer.begin, layer.own());
        levels_[0].waiting.append(layer.own());
    } else {
        pack(0, layer, &parts);
    }
    if (layer.end < levels_[0].grid.vertices[2])
        return;
    if (waits(0))
        pack_waiting(0, &parts);
    entries.push_back(finish(0, begin_, parts));
    for (std::size_t level = 1; level < levels_.size(); ++level) {
        const std::uint64_t begin = parts.align(kPartAlignment);
        pack_waiting(level, &parts);
        entries.push_back(finish(level, begin, parts));
    }
}

void StepWriter::look(const LayerView& layer) {
    pack(0, layer, nullptr);
    for (std::size_t level = 1; layer.end == levels_[0].grid.vertices[2] && level < levels_.size();
         ++level)
        pack_waiting(level, nullptr);
}

/// @param parts null to look only
void StepWriter::pack_waiting(std::size_t level, PartWriter* parts) {
    Level& it = levels_[level];
    if (own_levels_ && parts) {
        it.map = it.chooser.choose();
        if (const auto extremes = std::exchange(it.extremes, std::nullopt);
            extremes && !it.map->lossless())
            it.map->set_extremes(*extremes);
        it.chooser = LevelChooser(type_);
    }
    LayerCutter cutter(it.grid, type_);
    it.waiting.drain([&](std::span<const std::byte> piece) {
        cutter.add(piece, [&](const LayerView& layer) { pack(level, layer, parts); });
    });
    if (lends_)
        it.waiting.release();
}

/// @param parts null to look only
void StepWriter::pack(std::size_t level, const LayerView& layer, PartWriter* parts) {
    Level& it = levels_[level];
    // Builds the bricks of the cells up to the plane after this layer, brick layer by brick layer.
    constexpr std::uint32_t kPlanes = BrickGrid::kCells[2];
    Grid slab = it.grid;
    slab.vertices[2] = kPlanes + 1;
    const std::size_t brick_bytes = BrickGrid(slab).bytes_per_step();
    const std::uint32_t brick_layers =
        contents_.bricks && parts ? (layer.last - 1 - layer.begin + kPlanes - 1) / kPlanes : 0;
    bricks_.resize(brick_bytes * brick_layers);
    const auto build_layer_of_bricks = [&](std::uint32_t i) {
        const std::uint32_t from = layer.begin + i * kPlanes;
        const std::uint32_t to = std::min(from + kPlanes + 1, layer.last);
        Grid planes = it.grid;
        planes.vertices[2] = to - from;
        const auto stored = layer.planes(from, to);
        build_bricks({.grid = planes,
                      .type = type_,
                      .scaling = {},
                      .steps = 1,
                      .first = stored.data(),
                      .stride = stored.size()},
                     *it.map, 0, std::span(bricks_).subspan(i * brick_bytes, brick_bytes));
    };
    // Makes planes of the next level, a contiguous range on each thread.
    const unsigned threads = layer.own().size() >= kWorthThreads ? threads_ : 1;
    const bool coarser = level + 1 < levels_.size();
    const Coarsener& any = it.coarseners.front();
    const std::uint32_t first = any.made_of(layer.begin);
    const std::uint32_t count = coarser ? any.made_of(layer.end) - first : 0;
    const std::uint32_t runs = std::min<std::uint32_t>(threads, count);
    const std::size_t plane = coarser ? std::size_t{levels_[level + 1].grid.vertices[0]} *
                                            levels_[level + 1].grid.vertices[1] * size_of(type_)
                                      : 0;
    coarse_.resize((count * plane + 7) / 8);
    const auto coarse = std::as_writable_bytes(std::span(coarse_)).first(count * plane);
    parallel_for(brick_layers + runs, threads,
                 [&](std::size_t item, unsigned worker) {
                     if (item >= runs)
                         return build_layer_of_bricks(static_cast<std::uint32_t>(item - runs));
                     const auto run = static_cast<std::uint32_t>(item);
                     const std::uint32_t from = run * count / runs, to = (run + 1) * count / runs;
                     it.coarseners[worker].make(layer.planes(layer.first, layer.last), layer.first,
                                                first + from, first + to,
                                                coarse.subspan(from * plane, (to - from) * plane));
                 },
                 {});
    if (coarser) {
        if (parts)
            look(levels_[level + 1], first, coarse);
        levels_[level + 1].waiting.append(coarse);
    }
    if (!parts)
        return it.packer.look(layer.own());
    it.packer.pack({.stored = layer.own(),
                    .carries = contents_.values || level > 0,
                    .bricks = bricks_,
                    .brick_layers = brick_layers,
                    .with_bricks = contents_.bricks},
                   [&](std::span<const std::byte> bytes) { parts->append(bytes); });
}

StepEntry StepWriter::finish(std::size_t level, std::uint64_t begin, PartWriter& parts) {
    const auto append = [&](std::span<const std::byte> bytes) { parts.append(bytes); };
    StepEntry entry = levels_[level].packer.finish(append);
    if (own_levels_) {
        const std::vector<std::byte> map = bytes_of(*levels_[level].map);
        append(map);
        entry.bytes += map.size();
    }
    entry.offset = begin;
    return entry;
}

std::vector<StepEntry> agreed_steps(std::vector<StepEntry> mine, std::uint64_t begin,
                                    std::size_t levels, Team& team) {
    for (StepEntry& step : mine)
        step.offset += begin;
    const std::vector<StepEntry> by_step = team.gather_items(mine);
    std::vector<StepEntry> entries;
    for (std::size_t level = 0; level < levels; ++level)
        for (std::size_t i = level; i < by_step.size(); i += levels)
            entries.push_back(by_step[i]);
    return entries;
}

} // namespace isochron::index
