// Works on the layers of a step in parallel.
#include "index/search/layer_search.h"

#include "index/error.h"
#include "index/scan/bricks.h"
#include "index/scan/scan.h"
#include "index/search/id_sort.h"
#include "index/search/whole_layers.h"
#include "index/surface/cell_colors.h"
#include "index/surface/mesh_parts.h"
#include "index/system/parallel.h"
#include "index/system/read_ahead.h"
#include "index/volume/cell_walk.h"
#include "index/volume/stored_cut.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <numeric>
#include <utility>

namespace isochron::index {
namespace {

using Clock = std::chrono::steady_clock;

/// Ids relative to a layer's first cell, from ids of the step.
std::vector<CellId> counted_from(CellId first, std::span<const CellId> ids) {
    std::vector<CellId> local(ids.size());
    std::ranges::transform(ids, local.begin(), [first](CellId id) { return id - first; });
    return local;
}

} // namespace

/// Adds points and rows to the result of a layer. @throws Stopped
void LayerSearch::shade(StepSlab& slab, const Query& query, LayerResult& result,
                        const std::stop_token& stop) {
    const auto started = Clock::now();
    result.cells.query = query;
    slab.fill_around(result.cells.ids, true);
    if (!index::shade_cells(slab.around(), result.cells, stop))
        throw Stopped();
    result.shading = Clock::now() - started;
}

LayerSearch::LayerSearch(std::shared_ptr<const IndexFile> file, std::size_t level)
    : file_(std::move(file)), level_(level), store_(file_->chunks(level)) {
    // The slabs of all threads together take at most a quarter of the cache's budget.
    const std::uint64_t room = file_->cache().budget / 4 / StepSlab::bytes(store_.info()) + 1;
    slabs_.resize(std::min<std::uint64_t>(thread_count(0), room));
    cubes_.resize(slabs_.size());
}

StepSlab& LayerSearch::slab(unsigned thread) {
    if (!slabs_[thread])
        slabs_[thread] = std::make_unique<StepSlab>(store_);
    return *slabs_[thread];
}

/// @param places gives the places of a layer whose chunks will be needed
bool LayerSearch::for_each_layer(std::uint32_t step, const PlacesOf& places, const Prepare& prepare,
                                 const WorkOfThread& work, const std::stop_token& stop) {
    const std::uint32_t layers = StepSlab::layers(store_.info().grid);
    ReadAhead ahead(layers, [&](std::uint32_t layer) {
        stop_if_asked(stop);
        return store_.fetch(step, layer, places(layer), stop);
    });
    const unsigned threads = this->threads();
    // Each item prepares a layer, and works on one that has been prepared a while ago.
    const unsigned before = prepare ? threads : 0;
    try {
        parallel_for(std::size_t{layers} + before, threads,
                     [&](std::size_t item, unsigned worker) {
                         stop_if_asked(stop);
                         if (item < layers) {
                             ahead.reach(static_cast<std::uint32_t>(item));
                             if (prepare)
                                 prepare(static_cast<std::uint32_t>(item));
                         }
                         if (item < before)
                             return;
                         work(worker, static_cast<std::uint32_t>(item - before));
                     },
                     {});
    } catch (const Stopped&) {
        return false;
    }
    return !stop.stop_requested();
}

/// @param cells whose chunks will be needed
bool LayerSearch::for_each_layer_of(std::uint32_t step, const Cells& cells, const Work& work,
                                    const std::stop_token& stop) {
    std::vector<std::uint8_t> needed(store_.grid().chunks_of_layer());
    const auto places = [&](std::uint32_t layer) {
        std::ranges::fill(needed, std::uint8_t{0});
        CellWalk walk(store_.info().grid);
        for (const CellId id : of_layer(cells, layer)) {
            walk.to(id - first_of(layer)); // as wide ids wrap, from one layer to the next
            needed[store_.grid().place(walk.x() / kChunkEdge, walk.y() / kChunkEdge)] = 1;
        }
        std::vector<std::uint32_t> found;
        for (std::uint32_t place = 0; place < needed.size(); ++place)
            if (needed[place])
                found.push_back(place);
        return found;
    };
    const auto work_on_slab = [&](unsigned thread, std::uint32_t layer) {
        slab(thread).begin(step, layer, stop);
        work(slab(thread), layer);
    };
    return for_each_layer(step, places, {}, work_on_slab, stop);
}

/// The id of a layer's first cell.
CellId LayerSearch::first_of(std::uint32_t layer) const {
    const auto n = store_.info().grid.cells();
    return n[0] * n[1] * kChunkEdge * layer;
}

std::span<const CellId> LayerSearch::of_layer(const Cells& cells, std::uint32_t layer) const {
    const Grid& grid = store_.info().grid;
    if (has_wide_ids(grid)) { // which are ascending within each layer only
        const auto layer_of = [](const CellPoint& point) { return point.z / kChunkEdge; };
        const auto found = std::ranges::equal_range(cells.points, layer, {}, layer_of);
        return cells.ids.subspan(static_cast<std::size_t>(found.begin() - cells.points.begin()),
                                 found.size());
    }
    const auto n = grid.cells();
    const std::uint64_t of_layer = std::uint64_t{n[0]} * n[1] * kChunkEdge;
    const auto first = std::ranges::lower_bound(cells.ids, layer * of_layer);
    const auto last = std::ranges::lower_bound(first, cells.ids.end(), (layer + 1) * of_layer);
    return {first, last};
}

bool LayerSearch::search(CellSet& set, bool by_bricks, bool shaded, const std::stop_token& stop,
                         const ChunkFilter& only) {
    const auto started = Clock::now();
    LayerResults results(set, StepSlab::layers(store_.info().grid), stop);
    if (!run(set.query, by_bricks, shaded, stop, only, results))
        return false;
    // Search and shading ran in parallel: the elapsed time is divided by their shares.
    const auto passed = std::chrono::duration<double>(Clock::now() - started);
    const auto both =
        std::max<double>(1, static_cast<double>((results.searching + results.shading).count()));
    set.search_time = std::chrono::duration_cast<std::chrono::nanoseconds>(
        passed * (static_cast<double>(results.searching.count()) / both));
    set.shading_time =
        std::chrono::duration_cast<std::chrono::nanoseconds>(passed) - set.search_time;
    return true;
}

std::optional<std::uint64_t> LayerSearch::count(const Query& query, bool by_bricks,
                                                const std::stop_token& stop) {
    LayerResults results(StepSlab::layers(store_.info().grid));
    return run(query, by_bricks, false, stop, {}, results) ? std::optional(results.cells)
                                                           : std::nullopt;
}

bool LayerSearch::run(const Query& query, bool by_bricks, bool shaded, const std::stop_token& stop,
                      const ChunkFilter& only, LayerResults& results) {
    const LevelMapPtr levels = by_bricks ? store_.levels(query.step) : nullptr;
    const auto cut = levels ? levels->cut(store_.info().scaling, query.isovalue) : std::nullopt;
    if (levels && !cut)
        return true;
    const std::uint32_t layers = StepSlab::layers(store_.info().grid);
    const auto places = [&](std::uint32_t layer) {
        if (cut)
            return LayerCandidates::places_of(*store_.layer(query.step, layer), *cut, layer, only);
        std::vector<std::uint32_t> all(store_.grid().chunks_of_layer());
        std::iota(all.begin(), all.end(), 0u);
        return all;
    };
    PreparedCandidates candidates(layers, [&](std::uint32_t layer) {
        return LayerCandidates(store_, query.step, layer, *cut, shaded, stop, only);
    });
    const auto prepare = [&](std::uint32_t layer) {
        if (cut)
            candidates.prepare(layer);
    };
    const auto find = [&](StepSlab& slab, LayerResult& result) {
        result.cells.candidates =
            test_bricks(slab.cells(), *levels, slab.bricks(), query, result.cells.ids);
        stop_if_asked(stop);
        sort_ids(result.cells.ids, slab.cells().grid.cell_count());
    };
    const auto finish = [&](StepSlab& slab, std::uint32_t layer, LayerResult& result,
                            Clock::time_point begun) {
        result.first = slab.first_around();
        result.first_plane = slab.first_plane();
        for (CellId& id : result.cells.ids)
            id += slab.first_cell() - slab.first_around();
        stop_if_asked(stop);
        result.searching += Clock::now() - begun;
        if (shaded && !result.cells.ids.empty())
            shade(slab, query, result, stop);
        results.add(layer, std::move(result));
    };
    const auto scan_slab = [&](unsigned thread, std::uint32_t layer) {
        StepSlab& slab = this->slab(thread);
        slab.begin(query.step, layer, stop);
        LayerResult result = results.begin();
        const auto begun = Clock::now();
        slab.fill_all();
        scan(slab.cells(), query, result.cells.ids);
        result.cells.candidates = result.cells.ids.size();
        finish(slab, layer, result, begun);
    };
    const auto divided = stored_cut(store_.info().type, store_.info().scaling, query.isovalue);
    const auto search_cubes = [&](unsigned thread, std::uint32_t layer) {
        if (!cubes_[thread])
            cubes_[thread] = std::make_unique<CubeSearch>(store_);
        LayerResult result = results.begin();
        const LayerCandidates prepared = candidates.take(layer);
        const auto begun = Clock::now() - prepared.time();
        if (divided && !prepared.places().empty())
            cubes_[thread]->search(prepared, query, *divided, shaded, stop, result.cells,
                                   result.shading);
        result.searching = Clock::now() - begun - result.shading;
        results.add(layer, std::move(result));
    };
    const WorkOfThread work = cut ? WorkOfThread(search_cubes) : WorkOfThread(scan_slab);
    const auto whole =
        cut && !only && level_ == 0 && !store_.was_worked_on(query.step)
            ? WholeLayers::worth(store_, query.step, *cut, threads(), file_->cache().budget)
            : std::nullopt;
    if (whole) {
        for (std::uint32_t layer = 0; layer < layers; ++layer)
            if (layer < whole->first || layer >= whole->end)
                results.add(layer, {});
        WholeLayers all(store_, query.step, *whole, *cut, threads());
        const auto work_on_whole = [&](StepSlab& slab, std::uint32_t layer,
                                       std::chrono::nanoseconds decoding) {
            LayerResult result = results.begin();
            const auto begun = Clock::now() - decoding;
            find(slab, result);
            finish(slab, layer, result, begun);
        };
        if (!all.for_each(work_on_whole, stop))
            return false;
    } else if (!for_each_layer(query.step, places, prepare, work, stop)) {
        return false;
    }
    return true;
}

bool LayerSearch::keep_active(const Query& query, std::vector<CellId>& ids,
                              const std::stop_token& stop) {
    std::vector<std::vector<CellId>> kept(StepSlab::layers(store_.info().grid));
    const bool finished = for_each_layer_of(
        query.step, {ids},
        [&](StepSlab& slab, std::uint32_t layer) {
            kept[layer] = counted_from(slab.first_around(), of_layer({ids}, layer));
            slab.fill_around(kept[layer], false);
            index::keep_active(slab.around(), query, kept[layer]);
            for (CellId& id : kept[layer])
                id += slab.first_around();
        },
        stop);
    ids.clear();
    for (const auto& layer : kept)
        ids.insert(ids.end(), layer.begin(), layer.end());
    return finished;
}

bool LayerSearch::shade_cells(CellSet& set, const std::stop_token& stop) {
    CellSet shaded;
    LayerResults results(shaded, StepSlab::layers(store_.info().grid), stop);
    const bool finished = for_each_layer_of(
        set.query.step, {set.ids},
        [&](StepSlab& slab, std::uint32_t layer) {
            LayerResult result = results.begin();
            const auto ids = of_layer({set.ids}, layer);
            result.cells.ids = counted_from(slab.first_around(), ids);
            result.first = slab.first_around();
            result.first_plane = slab.first_plane();
            if (!ids.empty())
                shade(slab, set.query, result, stop);
            results.add(layer, std::move(result));
        },
        stop);
    set.points = std::move(shaded.points);
    set.rows = std::move(shaded.rows);
    return finished;
}

bool LayerSearch::make_mesh(const CellSet& set, CellMesh& mesh, const std::stop_token& stop) {
    const Cells cells{set.ids, set.points};
    std::vector<MeshPart> parts(StepSlab::layers(store_.info().grid));
    makers_.resize(slabs_.size());
    const bool finished = for_each_layer_of(
        set.query.step, cells,
        [&](StepSlab& slab, std::uint32_t layer) {
            const std::vector<CellId> local =
                counted_from(slab.first_around(), of_layer(cells, layer));
            if (local.empty())
                return;
            const auto worker = std::ranges::find(slabs_, &slab, &std::unique_ptr<StepSlab>::get);
            MeshMaker& maker = makers_[static_cast<std::size_t>(worker - slabs_.begin())];
            slab.fill_around(local, true);
            maker.make(slab.around(), set.query, local, parts[layer], slab.first_plane(), stop);
        },
        stop);
    if (finished)
        mesh = join_parts(std::move(parts));
    return finished;
}

bool LayerSearch::color_cells(const CellSet& set, const ColorSource& source,
                              std::span<std::uint16_t> out, const std::stop_token& stop) {
    const ColorArray& array = source.array();
    const Cells cells{set.ids, set.points};
    return for_each_layer_of(
        set.query.step, cells,
        [&](StepSlab& slab, std::uint32_t layer) {
            const auto ids = of_layer(cells, layer);
            if (ids.empty())
                return;
            const std::vector<CellId> local = counted_from(slab.first_around(), ids);
            StepSlab colors(*source.chunks(level_));
            colors.begin(set.query.step, layer, stop);
            slab.fill_around(local, false);
            colors.fill_around(local, false);
            const auto first = static_cast<std::size_t>(ids.data() - cells.ids.data());
            index::color_cells(slab.around(), colors.around(), set.query, local, array.low,
                               array.high, out.subspan(first, ids.size()), stop);
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
    if (std::isfinite(query.isovalue))
        LayerSearch(file, level)
            .search(set, by_bricks, has_wide_ids(file->chunks(level).info().grid), {});
    return set;
}

} // namespace isochron::index
