// Works on the parts of a step in parallel.
#include "index/search/layer_search.h"

#include "index/error.h"
#include "index/scan/scan.h"
#include "index/search/active_cells.h"
#include "index/surface/cell_colors.h"
#include "index/surface/mesh_colors.h"
#include "index/surface/mesh_parts.h"
#include "index/system/parallel.h"
#include "index/volume/cell_walk.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <map>
#include <mutex>
#include <utility>

namespace isochron::index {
namespace {

using Clock = std::chrono::steady_clock;

constexpr std::size_t kCellsPerLook = 1 << 16;  ///< cells between two looks at the stop token
constexpr std::size_t kMeshedAtATime = 1 << 13; ///< fewer cells than are made anew: one part

/// Ids relative to a layer's first cell, from ids of the step.
std::vector<CellId> counted_from(CellId first, std::span<const CellId> ids) {
    std::vector<CellId> local(ids.size());
    std::ranges::transform(ids, local.begin(), [first](CellId id) { return id - first; });
    return local;
}

/// The id of a layer's first cell.
CellId first_of(const Grid& grid, std::uint32_t layer) {
    const auto n = grid.cells();
    return n[0] * n[1] * kChunkEdge * layer;
}

} // namespace

/// Parts of work on some cells. @param most of a step that is worked on as a whole
std::size_t LayerSearch::parts(const StepView& step, const Cells& cells, unsigned most) {
    if (step.by_chunks())
        return StepSlab::layers(step.grid());
    const bool some = cells.earlier && !cells.earlier->inner.empty();
    const std::size_t count =
        some ? static_cast<std::size_t>(std::ranges::count(cells.earlier->inner, 0))
             : cells.ids.size();
    return std::clamp<std::size_t>(count / kMeshedAtATime, 1, most);
}

/// Calls `work` for each part, also for one without cells.
/// @param normals whether `values` must hold the neighbors of the cells' vertices
bool LayerSearch::for_each_part(const StepView& step, const Cells& cells, bool normals,
                                unsigned most, const Work& work, const std::stop_token& stop) {
    if (!step.by_chunks()) {
        const StepValues& values = step.whole(stop).values;
        const auto pieces = cut_at_planes(values.grid, cells.ids, parts(step, cells, most));
        parallel_for(pieces.size(), static_cast<unsigned>(pieces.size()),
                     [&](std::size_t number, unsigned worker) {
                         const auto ids = pieces[number];
                         work({.values = values,
                               .ids = ids,
                               .before = static_cast<std::size_t>(ids.data() - cells.ids.data()),
                               .number = number,
                               .worker = worker});
                     },
                     {});
        return !stop.stop_requested();
    }
    const ChunkGrid& chunks = step.chunk_grid();
    std::vector<std::uint8_t> needed(chunks.chunks_of_layer());
    const auto places = [&](std::uint32_t layer) {
        std::ranges::fill(needed, std::uint8_t{0});
        CellWalk walk(step.grid());
        for (const CellId id : without_earlier(cells, of_layer(step, cells, layer))) {
            // As wide ids wrap, from one layer to the next.
            walk.to(id - first_of(step.grid(), layer));
            needed[chunks.place(walk.x() / kChunkEdge, walk.y() / kChunkEdge)] = 1;
        }
        std::vector<std::uint32_t> found;
        for (std::uint32_t place = 0; place < needed.size(); ++place)
            if (needed[place])
                found.push_back(place);
        return found;
    };
    const auto work_on_slab = [&](unsigned worker, std::uint32_t layer) {
        StepSlab& slab = work_.slab(worker);
        slab.begin(step, layer, stop);
        const auto ids = of_layer(step, cells, layer);
        const std::vector<CellId> local = counted_from(slab.first_around(), ids);
        if (!local.empty())
            slab.fill_around(cells.earlier
                                 ? counted_from(slab.first_around(), without_earlier(cells, ids))
                                 : local,
                             normals);
        work({.values = slab.around(),
              .first = slab.first_around(),
              .first_plane = slab.first_plane(),
              .ids = local,
              .before = static_cast<std::size_t>(ids.data() - cells.ids.data()),
              .number = layer,
              .worker = worker,
              .layer = layer});
    };
    return work_.for_each_layer(step, places, {}, work_on_slab, work_.threads(step), stop);
}

/// Which of some neighboring cells need values.
std::vector<CellId> LayerSearch::without_earlier(const Cells& cells, std::span<const CellId> some) {
    const auto first = static_cast<std::size_t>(some.data() - cells.ids.data());
    std::vector<CellId> others;
    others.reserve(some.size());
    for (std::size_t i = 0; i < some.size(); ++i)
        if (!cells.earlier || !cells.earlier->has(first + i))
            others.push_back(some[i]);
    return others;
}

std::span<const CellId> LayerSearch::of_layer(const StepView& step, const Cells& cells,
                                              std::uint32_t layer) const {
    const Grid& grid = step.grid();
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

bool LayerSearch::search(const StepView& step, CellSet& set, bool by_bricks, bool shaded,
                         const std::stop_token& stop, const ChunkFilter& only) {
    const auto started = Clock::now();
    LayerResults results(set, parts_to_search(step, by_bricks), stop);
    if (!find_active(work_, step, {set.query, by_bricks, shaded, only}, results, stop))
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

bool LayerSearch::search_others(const StepView& step, CellSet& set, const StayingCells& staying,
                                bool shaded, const std::stop_token& stop) {
    LayerResults results(set, parts_to_search(step, true), stop);
    const ChunkFilter only = [&](std::uint32_t layer, std::uint32_t place) {
        return staying.others(layer, place) != 0;
    };
    return find_active(work_, step, {set.query, true, shaded, only, &staying}, results, stop);
}

std::optional<std::uint64_t> LayerSearch::count(const StepView& step, const Query& query,
                                                bool by_bricks, const std::stop_token& stop) {
    LayerResults results(parts_to_search(step, by_bricks));
    return find_active(work_, step, {query, by_bricks}, results, stop)
               ? std::optional(results.cells)
               : std::nullopt;
}

bool LayerSearch::keep_active(const StepView& step, const Query& query, std::vector<CellId>& ids,
                              const std::stop_token& stop) {
    std::vector<std::vector<CellId>> kept(parts(step, {ids}, 1));
    const bool finished = for_each_part(
        step, {ids}, false, 1,
        [&](const CellsOfPart& part) {
            std::vector<CellId> some;
            for (std::size_t at = 0; at < part.ids.size(); at += kCellsPerLook) {
                stop_if_asked(stop);
                const auto next =
                    part.ids.subspan(at, std::min(kCellsPerLook, part.ids.size() - at));
                some.assign(next.begin(), next.end());
                index::keep_active(part.values, query, some);
                for (const CellId id : some)
                    kept[part.number].push_back(id + part.first);
            }
        },
        stop);
    ids.clear();
    for (const auto& of_part : kept)
        ids.insert(ids.end(), of_part.begin(), of_part.end());
    return finished;
}

bool LayerSearch::shade_cells(const StepView& step, CellSet& set, const std::stop_token& stop) {
    CellSet shaded;
    const Cells cells{set.ids};
    LayerResults results(shaded, static_cast<std::uint32_t>(parts(step, cells, 1)), stop);
    const bool finished = for_each_part(
        step, cells, true, 1,
        [&](const CellsOfPart& part) {
            LayerResult result = results.begin();
            result.first_plane = part.first_plane;
            if (!part.ids.empty() &&
                !index::shade_cells(part.values, set.query, part.ids, result.cells.points,
                                    result.cells.rows, stop))
                throw Stopped();
            results.add(static_cast<std::uint32_t>(part.number), std::move(result));
        },
        stop);
    set.points = std::move(shaded.points);
    set.rows = std::move(shaded.rows);
    return finished;
}

bool LayerSearch::make_mesh(const StepView& step, const CellSet& set, CellMesh& mesh,
                            const std::stop_token& stop, const VertexColors& colors,
                            const EarlierMesh& earlier) {
    const Cells cells{set.ids, set.points, earlier.mesh ? &earlier : nullptr};
    std::vector<MeshPart> made(parts(step, cells, thread_count(0)));
    const auto take = [&](std::size_t number, MeshPart part) { made[number] = std::move(part); };
    if (!make_parts(step, cells, set.query, take, stop, colors))
        return false;
    mesh = join_parts(std::move(made));
    return true;
}

bool LayerSearch::make_mesh_pieces(const StepView& step, const CellSet& set,
                                   const std::function<void(CellMesh piece)>& take,
                                   const std::stop_token& stop, const VertexColors& colors) {
    if (!step.by_chunks()) { // small, and where it is cut depends on the number of threads
        CellMesh mesh;
        if (!make_mesh(step, set, mesh, stop, colors))
            return false;
        take(std::move(mesh));
        return true;
    }
    const Cells cells{set.ids, set.points};
    std::mutex mutex;
    std::map<std::size_t, MeshPart> early; // whose turn has not come
    std::size_t next = 0;
    PartsJoiner joiner;
    const auto take_in_order = [&](std::size_t number, MeshPart part) {
        const std::lock_guard lock(mutex);
        early.emplace(number, std::move(part));
        for (; !early.empty() && early.begin()->first == next; ++next) {
            CellMesh piece;
            joiner.add(early.begin()->second, piece);
            early.erase(early.begin());
            if (!piece.cases.empty())
                take(std::move(piece));
        }
    };
    return make_parts(step, cells, set.query, take_in_order, stop, colors);
}

/// Makes the mesh of each part, also of those without cells, and hands it on from the part's thread.
bool LayerSearch::make_parts(const StepView& step, const Cells& cells, const Query& query,
                             const TakePart& take, const std::stop_token& stop,
                             const VertexColors& colors) {
    const auto other = colors.source ? std::optional(colors.source->step(step)) : std::nullopt;
    if (other && !other->by_chunks())
        other->whole(stop); // before there are several threads
    makers_.resize(thread_count(0));
    return for_each_part(
        step, cells, true, static_cast<unsigned>(makers_.size()),
        [&](const CellsOfPart& part) {
            MeshPart made;
            if (!part.ids.empty()) {
                const EarlierMesh all = cells.earlier ? *cells.earlier : EarlierMesh{};
                const EarlierMesh earlier = all.part(part.before, part.ids.size());
                MeshMaker& maker = makers_[part.worker];
                maker.make(part.values, query, part.ids, made, part.first_plane, stop, earlier);
                if (other)
                    color(*other, colors, part, earlier, maker.uncolored(), made, stop);
            }
            take(part.number, std::move(made));
        },
        stop);
}

/// Gives the vertices of a part what they get of an array, but for those that an earlier mesh colored.
void LayerSearch::color(const StepView& other, const VertexColors& colors, const CellsOfPart& part,
                        const EarlierMesh& earlier, std::span<const std::uint32_t> uncolored,
                        MeshPart& made, const std::stop_token& stop) {
    StepSlab slab;
    const auto values_of = [&](std::span<const CellId> cells,
                               std::span<const MeshVertex> vertices) {
        return values_at(around(other, part.layer, cells, slab, stop), other.at(), vertices,
                         part.first_plane);
    };
    const ColorArray& array = colors.source->array();
    if (!earlier.has_colors()) {
        made.values = values_of(part.ids, made.vertices);
        if (!colors.as_values)
            color_by_values(made, array.low, array.high);
        return;
    }
    if (uncolored.empty())
        return;
    std::vector<CellId> cells;
    for (std::size_t i = 0; i < part.ids.size(); ++i)
        if (!earlier.has_colors_of(i))
            cells.push_back(part.ids[i]);
    std::vector<MeshVertex> vertices;
    vertices.reserve(uncolored.size());
    for (const std::uint32_t number : uncolored)
        vertices.push_back(made.vertices[number]);
    const auto found = colors_of(values_of(cells, vertices), array.low, array.high);
    for (std::size_t i = 0; i < found.size(); ++i)
        made.colors[uncolored[i]] = found[i];
}

/// The values of another array at the vertices of cells of a part. @param slab that holds them
/// @param layer, ids of the part
StepValues LayerSearch::around(const StepView& other, std::uint32_t layer,
                               std::span<const CellId> ids, StepSlab& slab,
                               const std::stop_token& stop) {
    if (!other.by_chunks())
        return other.whole(stop).values;
    slab.begin(other, layer, stop);
    slab.fill_around(ids, false);
    return slab.around();
}

bool LayerSearch::color_cells(const StepView& step, const CellSet& set, const ColorSource& source,
                              std::span<std::uint16_t> out, const std::stop_token& stop,
                              std::span<std::uint16_t> corners) {
    const ColorArray& array = source.array();
    const StepView colors = source.step(step);
    return for_each_part(
        step, {set.ids, set.points}, false, 1,
        [&](const CellsOfPart& part) {
            if (part.ids.empty())
                return;
            StepSlab slab;
            const StepValues around_cells = around(colors, part.layer, part.ids, slab, stop);
            index::color_cells(part.values, around_cells, set.query, part.ids, array.low,
                               array.high, out.subspan(part.before, part.ids.size()), stop);
            if (!corners.empty())
                color_corners(around_cells, set.query.instant, part.ids, array.low, array.high,
                              corners.subspan(8 * part.before, 8 * part.ids.size()));
        },
        stop);
}

CellSet search_level(const std::shared_ptr<const IndexFile>& file, std::size_t level,
                     const Query& query) {
    if (level >= file->detail_levels())
        throw Error("level {}: expected 0 to {}", level, file->detail_levels() - 1);
    if (const std::size_t steps = file->info().steps(); query.instant.step >= steps)
        throw Error("step {}: expected 0 to {}", query.instant.step, steps - 1);
    const bool by_bricks = file->plan().tiers.has(Tier::bricks);
    CellSet set;
    set.query = query;
    set.method = by_bricks ? SearchMethod::bricks : SearchMethod::scan;
    const StepView step = step_in_chunks(*file, query.instant, level);
    if (std::isfinite(query.isovalue))
        LayerSearch(file).search(step, set, by_bricks, has_wide_ids(step.grid()), {});
    return set;
}

} // namespace isochron::index
