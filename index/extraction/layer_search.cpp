// Work on the layers of a step, side by side.
#include "index/extraction/layer_search.h"

#include "index/error.h"
#include "index/extraction/cell_colors.h"
#include "index/extraction/id_sort.h"
#include "index/scan/bricks.h"
#include "index/scan/scan.h"
#include "index/system/parallel.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>

namespace isochron::index {
namespace {

/// Ids of a layer from those of the step.
std::vector<CellId> counted_from(CellId first, std::span<const CellId> ids) {
    std::vector<CellId> local(ids.size());
    std::ranges::transform(ids, local.begin(), [first](CellId id) { return id - first; });
    return local;
}

/// Appends what was found in each layer.
std::vector<CellId> joined(const std::vector<std::vector<CellId>>& layers) {
    std::size_t count = 0;
    for (const auto& ids : layers)
        count += ids.size();
    std::vector<CellId> all;
    all.reserve(count);
    for (const auto& ids : layers)
        all.insert(all.end(), ids.begin(), ids.end());
    return all;
}

} // namespace

LayerSearch::LayerSearch(std::shared_ptr<const IndexFile> file, std::size_t level)
    : file_(std::move(file)), store_(file_->chunks(level)) {
    // Slabs of all threads together take no more than a part of what chunks may take.
    const std::uint64_t room = file_->cache().budget / 4 / StepSlab::bytes(store_.info()) + 1;
    slabs_.resize(std::min<std::uint64_t>(thread_count(0), room));
}

bool LayerSearch::for_each_layer(std::uint32_t step, const Work& work,
                                 const std::stop_token& stop) {
    parallel_for(StepSlab::layers(store_.info().grid), static_cast<unsigned>(slabs_.size()),
                 [&](std::size_t layer, unsigned worker) {
                     if (stop.stop_requested())
                         return;
                     if (!slabs_[worker])
                         slabs_[worker] = std::make_unique<StepSlab>(store_);
                     slabs_[worker]->begin(step, static_cast<std::uint32_t>(layer));
                     work(*slabs_[worker], static_cast<std::uint32_t>(layer));
                 },
                 {});
    return !stop.stop_requested();
}

std::span<const CellId> LayerSearch::of_layer(std::span<const CellId> ids,
                                              std::uint32_t layer) const {
    const auto n = store_.info().grid.cells();
    const std::uint64_t cells = std::uint64_t{n[0]} * n[1] * kChunkEdge;
    const auto first = std::ranges::lower_bound(ids, layer * cells);
    const auto last = std::ranges::lower_bound(first, ids.end(), (layer + 1) * cells);
    return {first, last};
}

bool LayerSearch::search(const Query& query, bool by_bricks, std::vector<CellId>& out,
                         std::uint64_t& candidates, const std::stop_token& stop) {
    out.clear();
    candidates = 0;
    const LevelMapPtr levels = by_bricks ? store_.levels(query.step) : nullptr;
    const auto cut = levels ? levels->cut(store_.info().scaling, query.isovalue) : std::nullopt;
    if (levels && !cut)
        return true;
    std::vector<std::vector<CellId>> found(StepSlab::layers(store_.info().grid));
    std::vector<std::uint64_t> tested(found.size());
    const bool finished = for_each_layer(
        query.step,
        [&](StepSlab& slab, std::uint32_t layer) {
            std::vector<CellId>& ids = found[layer];
            if (by_bricks) {
                if (!slab.fill_candidates(*cut))
                    return;
                tested[layer] = test_bricks(slab.cells(), *levels, slab.bricks(), query, ids);
                sort_ids(ids, slab.cells().grid.cell_count());
            } else {
                slab.fill_all();
                scan(slab.cells(), query, ids);
                tested[layer] = ids.size();
            }
            for (CellId& id : ids)
                id += slab.first_cell();
        },
        stop);
    out = joined(found);
    for (const std::uint64_t count : tested)
        candidates += count;
    return finished;
}

bool LayerSearch::keep_active(const Query& query, std::vector<CellId>& ids,
                              const std::stop_token& stop) {
    std::vector<std::vector<CellId>> kept(StepSlab::layers(store_.info().grid));
    const bool finished = for_each_layer(
        query.step,
        [&](StepSlab& slab, std::uint32_t layer) {
            kept[layer] = counted_from(slab.first_around(), of_layer(ids, layer));
            slab.fill_around(kept[layer], false);
            index::keep_active(slab.around(), query, kept[layer]);
            for (CellId& id : kept[layer])
                id += slab.first_around();
        },
        stop);
    ids = joined(kept);
    return finished;
}

bool LayerSearch::shade_cells(CellSet& set, const std::stop_token& stop) {
    set.points.resize(set.ids.size());
    std::vector<std::vector<CellRow>> rows(StepSlab::layers(store_.info().grid));
    const bool finished = for_each_layer(
        set.query.step,
        [&](StepSlab& slab, std::uint32_t layer) {
            const auto ids = of_layer(set.ids, layer);
            if (ids.empty())
                return;
            CellSet part;
            part.query = set.query;
            part.ids = counted_from(slab.first_around(), ids);
            slab.fill_around(part.ids, true);
            if (!index::shade_cells(slab.around(), part, stop))
                return;
            const auto first = static_cast<std::uint32_t>(ids.data() - set.ids.data());
            const auto plane = static_cast<std::uint16_t>(slab.first_plane());
            for (std::size_t i = 0; i < part.points.size(); ++i) {
                part.points[i].z = static_cast<std::uint16_t>(part.points[i].z + plane);
                set.points[first + i] = part.points[i];
            }
            for (const CellRow& row : part.rows)
                rows[layer].push_back(
                    {row.y, static_cast<std::uint16_t>(row.z + plane), first + row.begin});
        },
        stop);
    set.rows.clear();
    for (const auto& layer : rows)
        set.rows.insert(set.rows.end(), layer.begin(), layer.end());
    return finished;
}

bool LayerSearch::color_cells(const Query& query, std::span<const CellId> cells,
                              std::span<std::uint16_t> out, const std::stop_token& stop) {
    const ColorArray& array = *file_->color();
    return for_each_layer(
        query.step,
        [&](StepSlab& slab, std::uint32_t layer) {
            const auto ids = of_layer(cells, layer);
            if (ids.empty())
                return;
            const std::vector<CellId> local = counted_from(slab.first_around(), ids);
            StepSlab colors(*file_->color_chunks());
            colors.begin(query.step, layer);
            slab.fill_around(local, false);
            colors.fill_around(local, false);
            const auto first = static_cast<std::size_t>(ids.data() - cells.data());
            index::color_cells(slab.around(), colors.around(), query, local, array.low, array.high,
                               out.subspan(first, ids.size()), stop);
        },
        stop);
}

CellSet search_level(const std::shared_ptr<const IndexFile>& file, std::size_t level,
                     const Query& query) {
    if (level >= file->detail_levels())
        throw Error(fmt::format("level {}: expected 0 to {}", level, file->detail_levels() - 1));
    if (const std::size_t steps = file->info().steps(); query.step >= steps)
        throw Error(fmt::format("step {}: expected 0 to {}", query.step, steps - 1));
    const bool by_bricks = file->plan().tiers.has(Tier::bricks);
    CellSet set;
    set.query = query;
    set.method = by_bricks ? SearchMethod::bricks : SearchMethod::scan;
    const auto started = std::chrono::steady_clock::now();
    if (std::isfinite(query.isovalue))
        LayerSearch(file, level).search(query, by_bricks, set.ids, set.candidates, {});
    set.search_time = std::chrono::steady_clock::now() - started;
    return set;
}

} // namespace isochron::index
