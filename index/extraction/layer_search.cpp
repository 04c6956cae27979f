// Work on the layers of a step, side by side.
#include "index/extraction/layer_search.h"

#include "index/error.h"
#include "index/extraction/cell_colors.h"
#include "index/extraction/id_sort.h"
#include "index/scan/bricks.h"
#include "index/scan/scan.h"
#include "index/system/parallel.h"
#include "index/system/read_ahead.h"
#include "index/volume/cell_walk.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <numeric>
#include <utility>

namespace isochron::index {
namespace {

using Clock = std::chrono::steady_clock;

/// Ids of a layer from those of the step.
std::vector<CellId> counted_from(CellId first, std::span<const CellId> ids) {
    std::vector<CellId> local(ids.size());
    std::ranges::transform(ids, local.begin(), [first](CellId id) { return id - first; });
    return local;
}

} // namespace

/// What is found in one layer.
struct LayerSearch::Part {
    std::vector<CellId> ids; ///< of the step
    std::vector<CellPoint> points;
    std::vector<CellRow> rows; ///< beginning within the part
    std::uint64_t tested = 0;
    std::chrono::nanoseconds searching{0}, shading{0};

    /// Gives the cells their points and rows.
    bool shade(const Query& query, StepSlab& slab, const std::stop_token& stop) {
        const auto started = Clock::now();
        CellSet local;
        local.query = query;
        local.ids = counted_from(slab.first_around(), ids);
        slab.fill_around(local.ids, true);
        if (!index::shade_cells(slab.around(), local, stop))
            return false;
        points = std::move(local.points);
        rows = std::move(local.rows);
        for (CellPoint& point : points)
            point.z = static_cast<std::uint16_t>(point.z + slab.first_plane());
        for (CellRow& row : rows)
            row.z = static_cast<std::uint16_t>(row.z + slab.first_plane());
        shading = Clock::now() - started;
        return true;
    }

    /// @return false when stopped
    static bool join(std::vector<Part>& parts, CellSet& set, const std::stop_token& stop) {
        std::size_t ids = 0, points = 0, rows = 0;
        for (const Part& part : parts) {
            ids += part.ids.size();
            points += part.points.size();
            rows += part.rows.size();
        }
        set.ids.clear();
        set.points.clear();
        set.rows.clear();
        set.ids.reserve(ids);
        set.points.reserve(points);
        set.rows.reserve(rows);
        for (Part& part : parts) {
            if (stop.stop_requested())
                return false;
            const auto first = static_cast<std::uint32_t>(set.ids.size());
            set.ids.insert(set.ids.end(), part.ids.begin(), part.ids.end());
            set.points.insert(set.points.end(), part.points.begin(), part.points.end());
            for (const CellRow& row : part.rows)
                set.rows.push_back({row.y, row.z, first + row.begin});
            part = {};
        }
        return true;
    }
};

LayerSearch::LayerSearch(std::shared_ptr<const IndexFile> file, std::size_t level)
    : file_(std::move(file)), store_(file_->chunks(level)) {
    // Slabs of all threads together take no more than a part of what chunks may take.
    const std::uint64_t room = file_->cache().budget / 4 / StepSlab::bytes(store_.info()) + 1;
    slabs_.resize(std::min<std::uint64_t>(thread_count(0), room));
}

/// @param places of a layer, whose chunks are going to be needed
bool LayerSearch::for_each_layer(std::uint32_t step, const PlacesOf& places, const Work& work,
                                 const std::stop_token& stop) {
    const std::uint32_t layers = StepSlab::layers(store_.info().grid);
    ReadAhead ahead(layers,
                    [&](std::uint32_t layer) { return store_.expect(step, layer, places(layer)); });
    try {
        parallel_for(layers, static_cast<unsigned>(slabs_.size()),
                     [&](std::size_t at, unsigned worker) {
                         if (stop.stop_requested())
                             throw Stopped();
                         const auto layer = static_cast<std::uint32_t>(at);
                         ahead.reach(layer);
                         if (!slabs_[worker])
                             slabs_[worker] = std::make_unique<StepSlab>(store_);
                         slabs_[worker]->begin(step, layer, stop);
                         work(*slabs_[worker], layer);
                     },
                     {});
    } catch (const Stopped&) {
        return false;
    }
    return !stop.stop_requested();
}

/// @param cells ascending, whose chunks are going to be needed
bool LayerSearch::for_each_layer_of(std::uint32_t step, std::span<const CellId> cells,
                                    const Work& work, const std::stop_token& stop) {
    std::vector<std::uint8_t> needed(store_.grid().chunks_of_layer());
    const auto places = [&](std::uint32_t layer) {
        std::ranges::fill(needed, std::uint8_t{0});
        CellWalk walk(store_.info().grid);
        for (const CellId id : of_layer(cells, layer)) {
            walk.to(id);
            needed[store_.grid().place(walk.x() / kChunkEdge, walk.y() / kChunkEdge)] = 1;
        }
        std::vector<std::uint32_t> found;
        for (std::uint32_t place = 0; place < needed.size(); ++place)
            if (needed[place])
                found.push_back(place);
        return found;
    };
    return for_each_layer(step, places, work, stop);
}

std::span<const CellId> LayerSearch::of_layer(std::span<const CellId> ids,
                                              std::uint32_t layer) const {
    const auto n = store_.info().grid.cells();
    const std::uint64_t cells = std::uint64_t{n[0]} * n[1] * kChunkEdge;
    const auto first = std::ranges::lower_bound(ids, layer * cells);
    const auto last = std::ranges::lower_bound(first, ids.end(), (layer + 1) * cells);
    return {first, last};
}

bool LayerSearch::search(CellSet& set, bool by_bricks, bool shaded, const std::stop_token& stop) {
    const Query& query = set.query;
    const LevelMapPtr levels = by_bricks ? store_.levels(query.step) : nullptr;
    const auto cut = levels ? levels->cut(store_.info().scaling, query.isovalue) : std::nullopt;
    if (levels && !cut)
        return true;
    const auto started = Clock::now();
    std::vector<Part> parts(StepSlab::layers(store_.info().grid));
    const auto places = [&](std::uint32_t layer) {
        if (cut)
            return StepSlab::candidate_chunks(*store_.layer(query.step, layer), *cut);
        std::vector<std::uint32_t> all(store_.grid().chunks_of_layer());
        std::iota(all.begin(), all.end(), 0u);
        return all;
    };
    const auto work = [&](StepSlab& slab, std::uint32_t layer) {
        Part& part = parts[layer];
        const auto begun = Clock::now();
        if (by_bricks) {
            if (!slab.fill_candidates(*cut))
                return;
            part.tested = test_bricks(slab.cells(), *levels, slab.bricks(), query, part.ids);
            sort_ids(part.ids, slab.cells().grid.cell_count());
        } else {
            slab.fill_all();
            scan(slab.cells(), query, part.ids);
            part.tested = part.ids.size();
        }
        for (CellId& id : part.ids)
            id += slab.first_cell();
        part.searching = Clock::now() - begun;
        if (shaded && !part.ids.empty() && !part.shade(query, slab, stop))
            throw Stopped();
    };
    if (!for_each_layer(query.step, places, work, stop))
        return false;
    std::chrono::nanoseconds searching{0}, shading{0};
    set.candidates = 0;
    for (const Part& part : parts) {
        set.candidates += part.tested;
        searching += part.searching;
        shading += part.shading;
    }
    if (!Part::join(parts, set, stop))
        return false;
    // Both went on side by side: each gets its share of the time that passed.
    const auto passed = std::chrono::duration<double>(Clock::now() - started);
    const auto both = std::max<double>(1, static_cast<double>((searching + shading).count()));
    set.search_time = std::chrono::duration_cast<std::chrono::nanoseconds>(
        passed * (static_cast<double>(searching.count()) / both));
    set.shading_time =
        std::chrono::duration_cast<std::chrono::nanoseconds>(passed) - set.search_time;
    return true;
}

bool LayerSearch::keep_active(const Query& query, std::vector<CellId>& ids,
                              const std::stop_token& stop) {
    std::vector<std::vector<CellId>> kept(StepSlab::layers(store_.info().grid));
    const bool finished = for_each_layer_of(
        query.step, ids,
        [&](StepSlab& slab, std::uint32_t layer) {
            kept[layer] = counted_from(slab.first_around(), of_layer(ids, layer));
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
    std::vector<Part> parts(StepSlab::layers(store_.info().grid));
    const bool finished = for_each_layer_of(
        set.query.step, set.ids,
        [&](StepSlab& slab, std::uint32_t layer) {
            const auto ids = of_layer(set.ids, layer);
            parts[layer].ids.assign(ids.begin(), ids.end());
            if (!ids.empty() && !parts[layer].shade(set.query, slab, stop))
                throw Stopped();
        },
        stop);
    return finished && Part::join(parts, set, stop);
}

bool LayerSearch::color_cells(const Query& query, std::span<const CellId> cells,
                              std::span<std::uint16_t> out, const std::stop_token& stop) {
    const ColorArray& array = *file_->color();
    return for_each_layer_of(
        query.step, cells,
        [&](StepSlab& slab, std::uint32_t layer) {
            const auto ids = of_layer(cells, layer);
            if (ids.empty())
                return;
            const std::vector<CellId> local = counted_from(slab.first_around(), ids);
            StepSlab colors(*file_->color_chunks());
            colors.begin(query.step, layer, stop);
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
    if (std::isfinite(query.isovalue))
        LayerSearch(file, level).search(set, by_bricks, false, {});
    return set;
}

} // namespace isochron::index
