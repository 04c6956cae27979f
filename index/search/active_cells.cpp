// Searches the parts of a step, with all cores.
#include "index/search/active_cells.h"

#include "index/scan/bricks.h"
#include "index/scan/scan.h"
#include "index/search/id_sort.h"
#include "index/search/near_blend.h"
#include "index/search/whole_layers.h"
#include "index/surface/cell_set.h"
#include "index/system/parallel.h"
#include "index/volume/cell_walk.h"

#include <algorithm>
#include <chrono>
#include <numeric>
#include <optional>
#include <utility>
#include <vector>

namespace isochron::index {
namespace {

using Clock = std::chrono::steady_clock;

constexpr std::size_t kScannedAtATime = 1 << 22; ///< cells of a part of a whole step

/// Planes of cells of a step that are scanned at a time.
std::uint32_t scanned_planes(const Grid& grid) {
    const auto [width, height, depth] = grid.cells();
    return static_cast<std::uint32_t>(
        std::clamp<std::uint64_t>(kScannedAtATime / (std::uint64_t{width} * height), 1, depth));
}
std::uint32_t scanned_parts(const Grid& grid) {
    const std::uint32_t planes = scanned_planes(grid);
    return (grid.cells()[2] + planes - 1) / planes;
}

/// The cells of a layer of bricks.
std::uint64_t cells_of_brick_layer(const Grid& grid) {
    const auto [width, height, depth] = grid.cells();
    return std::uint64_t{width} * height * BrickGrid::kCells[2];
}

/// What is done with each part of a step.
class PartsSearch {
  public:
    PartsSearch(LayerWork& work, const StepView& step, const ActiveCellsOrder& order,
                LayerResults& results, const std::stop_token& stop)
        : work_(work), step_(step), order_(order), stop_(stop), results_(results),
          levels_(order.by_bricks ? step.levels() : nullptr),
          cut_(levels_ ? levels_->cut(step.scaling(), order.query.isovalue) : std::nullopt) {}

    /// @return false when stopped
    bool operator()() {
        if (levels_ && !cut_)
            return true;
        if (!step_.by_chunks())
            return order_.staying && cut_ ? others_of_whole() : whole();
        if (!cut_)
            return scan_layers();
        return !order_.only && !order_.staying && NearBlend::worth(step_) ? by_blends()
                                                                          : by_candidates();
    }

  private:
    /// Searches the whole step by its bricks, or by a scan, some planes after the other.
    bool whole() {
        const LoadedStep& all = step_.whole(stop_);
        const StepPart step{.cells = all.values, .around = all.values, .bricks = all.bricks};
        if (cut_) {
            work_on(step, 0, results_.begin(), Clock::now());
            return !stop_.stop_requested();
        }
        const std::uint32_t planes = scanned_planes(step_.grid());
        const std::uint32_t depth = step_.grid().cells()[2];
        const std::uint32_t parts = scanned_parts(step_.grid());
        parallel_for(parts, std::min(parts, thread_count(0)),
                     [&](std::size_t number, unsigned) {
                         stop_if_asked(stop_);
                         const auto first = static_cast<std::uint32_t>(number) * planes;
                         work_on(step.planes(first, std::min(first + planes, depth)), number,
                                 results_.begin(), Clock::now());
                     },
                     {});
        return !stop_.stop_requested();
    }

    /// Searches the bricks of a whole step that hold cells which may have changed.
    bool others_of_whole() {
        const LoadedStep& all = step_.whole(stop_);
        const std::vector<std::uint8_t> bricks = bricks_of_others(all.bricks);
        LayerResult result = results_.begin();
        const auto begun = Clock::now();
        std::vector<CellId>& ids = result.cells.ids;
        result.cells.candidates = search_bricks(all.values, *levels_, bricks, order_.query, ids);
        stop_if_asked(stop_);
        sort_ids(ids, step_.grid().cell_count(), cells_of_brick_layer(step_.grid()));
        CellWalk walk(step_.grid());
        std::erase_if(ids, [&](CellId id) {
            walk.to(id);
            return order_.staying->has_cell(walk.x(), walk.y(), walk.z());
        });
        result.searching = Clock::now() - begun;
        shade(all.values, result);
        results_.add(0, std::move(result));
        return !stop_.stop_requested();
    }

    /// Bricks without candidates but for cells that do not stay.
    std::vector<std::uint8_t> bricks_of_others(std::span<const std::uint8_t> all) const {
        const BrickGrid grid(step_.grid());
        const std::size_t count = grid.count();
        std::vector<std::uint8_t> others(2 * count);
        std::fill_n(others.begin(), count, std::uint8_t{255});
        const ChunkGrid& chunks = step_.chunk_grid();
        for (std::uint32_t layer = 0; layer < chunks.layers(); ++layer) {
            const ChunkLayerPtr table = step_.layer(layer);
            for (const std::uint32_t place : LayerCandidates::places_of(*table, *cut_)) {
                const auto bricks =
                    LayerCandidates::bricks_at(order_.staying->others(layer, place));
                const auto [x, y] = chunks.at(place);
                for (std::uint32_t i = 0; i < kBricksOfChunk && bricks >> i; ++i)
                    if (bricks >> i & 1)
                        if (const auto brick = brick_of_chunk(grid, {x, y, layer}, i)) {
                            others[*brick] = all[*brick];
                            others[count + *brick] = all[count + *brick];
                        }
            }
        }
        return others;
    }

    bool scan_layers() {
        const auto places = [&](std::uint32_t) {
            std::vector<std::uint32_t> all(step_.chunk_grid().chunks_of_layer());
            std::iota(all.begin(), all.end(), 0u);
            return all;
        };
        const auto scan_slab = [&](unsigned worker, std::uint32_t layer) {
            StepSlab& slab = work_.slab(worker);
            slab.begin(step_, layer, stop_);
            LayerResult result = results_.begin();
            const auto begun = Clock::now();
            slab.fill_all();
            work_on(slab.part(), layer, std::move(result), begun);
        };
        return work_.for_each_layer(step_, places, {}, scan_slab, work_.threads(step_), stop_);
    }

    /// Searches between two steps that are in memory.
    bool by_blends() {
        constexpr std::size_t kFew = 8192; ///< bricks for which threads are not worth their start
        const NearBlend blends(step_, *cut_, stop_);
        const std::uint32_t layers = blends.layers();
        const unsigned threads = blends.candidates() < kFew ? 1 : std::min(layers, thread_count(0));
        const auto for_each_layer = [&](const auto& work) {
            parallel_for(layers, threads,
                         [&](std::size_t layer, unsigned) {
                             stop_if_asked(stop_);
                             work(static_cast<std::uint32_t>(layer));
                         },
                         {});
        };
        if (blends.candidates() > 0)
            for_each_layer([&](std::uint32_t layer) { blends.blend(layer); });
        for_each_layer([&](std::uint32_t layer) {
            if (blends.has_candidates(layer))
                work_on(blends.part(layer), layer, results_.begin(), Clock::now());
            else
                results_.add(layer, {});
        });
        return !stop_.stop_requested();
    }

    bool by_candidates() {
        const std::uint32_t layers = StepSlab::layers(step_.grid());
        const bool may_need_all =
            !order_.only && &step_.store() == &work_.file().chunks() && !step_.was_worked_on();
        const unsigned threads = work_.threads(step_);
        if (const auto range = may_need_all ? WholeLayers::worth(step_, *cut_, threads,
                                                                 work_.file().cache().budget)
                                            : std::nullopt) {
            for (std::uint32_t layer = 0; layer < layers; ++layer)
                if (layer < range->first || layer >= range->end)
                    results_.add(layer, {});
            const auto work = [&](StepSlab& slab, std::uint32_t layer,
                                  std::chrono::nanoseconds decoding) {
                work_on(slab.part(), layer, results_.begin(), Clock::now() - decoding);
            };
            return WholeLayers(step_, *range, *cut_, threads).for_each(work, stop_);
        }
        PreparedCandidates candidates(layers, [&](std::uint32_t layer) {
            return LayerCandidates(step_, layer, *cut_, order_.shaded, stop_, order_.only,
                                   order_.staying);
        });
        const auto stored = step_.stored_cut(order_.query.isovalue);
        const auto search_cubes = [&](unsigned worker, std::uint32_t layer) {
            LayerResult result = results_.begin();
            const LayerCandidates prepared = candidates.take(layer);
            const auto begun = Clock::now() - prepared.time();
            if (stored && !prepared.places().empty())
                work_.cubes(worker).search(step_, prepared, order_.query, *stored, order_.shaded,
                                           stop_, result.cells, result.shading, order_.staying);
            result.searching = Clock::now() - begun - result.shading;
            results_.add(layer, std::move(result));
        };
        return work_.for_each_layer(
            step_,
            [&](std::uint32_t layer) {
                return LayerCandidates::places_of(*step_.layer(layer), *cut_, layer, order_.only);
            },
            [&](std::uint32_t layer) { candidates.prepare(layer); }, search_cubes,
            work_.threads_without_slabs(), stop_);
    }

    /// Finds the active cells of a part that is in memory, and shades them. @throws Stopped
    void work_on(const StepPart& part, std::size_t number, LayerResult result,
                 Clock::time_point begun) {
        std::vector<CellId>& ids = result.cells.ids;
        if (cut_) {
            const auto search = part.sparse ? test_bricks : search_bricks;
            result.cells.candidates = search(part.cells, *levels_, part.bricks, order_.query, ids);
            stop_if_asked(stop_);
            sort_ids(ids, part.cells.grid.cell_count(), cells_of_brick_layer(part.cells.grid));
        } else {
            scan(part.cells, order_.query, ids);
            result.cells.candidates = ids.size();
        }
        for (CellId& id : ids)
            id += part.first_cell - part.first_around;
        result.first = part.first_around;
        result.first_plane = part.first_plane;
        stop_if_asked(stop_);
        result.searching = Clock::now() - begun;
        if (order_.shaded && part.slab && !ids.empty())
            part.slab->fill_around(ids, true);
        shade(part.around, result);
        results_.add(static_cast<std::uint32_t>(number), std::move(result));
    }

    /// Adds points and rows to cells that have been found, if they are wanted. @throws Stopped
    void shade(const StepValues& values, LayerResult& result) const {
        if (!order_.shaded || result.cells.ids.empty())
            return;
        const auto begun = Clock::now();
        if (!index::shade_cells(values, order_.query, result.cells.ids, result.cells.points,
                                result.cells.rows, stop_))
            throw Stopped();
        result.shading = Clock::now() - begun;
    }

    LayerWork& work_;
    const StepView& step_;
    const ActiveCellsOrder& order_;
    const std::stop_token& stop_;
    LayerResults& results_;
    LevelMapPtr levels_; ///< levels of the bricks; null: without them
    std::optional<LevelMap::Cut> cut_;
};

} // namespace

std::uint32_t parts_to_search(const StepView& step, bool by_bricks) {
    if (step.by_chunks())
        return StepSlab::layers(step.grid());
    return by_bricks ? 1 : scanned_parts(step.grid());
}

bool find_active(LayerWork& work, const StepView& step, const ActiveCellsOrder& order,
                 LayerResults& results, const std::stop_token& stop) {
    return PartsSearch(work, step, order, results, stop)();
}

} // namespace isochron::index
