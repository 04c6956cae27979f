// The search in an open index, as the worker runs it.
#include "index/search/index_search.h"

#include "index/error.h"
#include "index/scan/bricks.h"
#include "index/scan/scan.h"
#include "index/search/first_visit.h"
#include "index/search/id_sort.h"
#include "index/search/layer_search.h"
#include "index/search/tree_of_file.h"
#include "index/surface/mesh_parts.h"
#include "index/system/parallel.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>

namespace isochron::index {
namespace {

constexpr std::size_t kCandidatesPerLook =
    1 << 16;                                ///< candidates between two looks at the stop token
constexpr std::size_t kScanChunk = 1 << 22; ///< cells between two looks at the stop token

class IndexSearch {
  public:
    IndexSearch(std::shared_ptr<const IndexFile> file, std::optional<SearchMethod> forced,
                Shading shading)
        : file_(std::move(file)), method_(forced ? *forced : cheapest_method(*file_)),
          free_(!forced), shading_(shading), answered_(file_->info().steps()),
          keys_(file_->info().type, file_->info().scaling), layers_(file_) {}

    bool operator()(const Query& query, const std::stop_token& stop, CellSet& set) {
        const std::size_t steps = file_->info().steps();
        if (query.step >= steps)
            throw Error(fmt::format("step {}: expected 0 to {}", query.step, steps - 1));
        const auto started = Clock::now();
        set.query = query;
        set.method = method_at(query);
        by_chunks_ = !file_->better_whole(query.step);
        step_.reset();
        try {
            if (std::isfinite(query.isovalue) && !search(set, stop))
                return false;
            // A search by layers has also shaded, and has set both times.
            if (set.ids.empty() || set.points.empty()) {
                const auto found = Clock::now();
                if (shading_ != Shading::none && !set.ids.empty() && !shade(set, stop))
                    return false;
                set.search_time = found - started;
                set.shading_time = Clock::now() - found;
            }
            if (!add_mesh(set, stop))
                return false;
        } catch (const Stopped&) {
            return false;
        }
        file_->chunks().worked_on(query.step);
        answered_[query.step] = true;
        return true;
    }

  private:
    using Clock = std::chrono::steady_clock;

    /// The method for a query: appended steps may not have cells yet, and those of a step may not
    /// have been read.
    SearchMethod method_at(const Query& query) const {
        if (method_ != SearchMethod::cells)
            return method_;
        const bool bricks = can_search(*file_, SearchMethod::bricks);
        if (!file_->has_cells(query.step))
            return bricks ? SearchMethod::bricks : SearchMethod::scan;
        if (!free_ || !bricks || answered_[query.step] || !std::isfinite(query.isovalue))
            return method_;
        const MissingBytes missing = missing_bytes(*file_, query, shading_ != Shading::none);
        return missing.bricks < missing.cells ? SearchMethod::bricks : method_;
    }

    bool search(CellSet& set, const std::stop_token& stop) {
        switch (set.method) {
        case SearchMethod::cells: return search_cells(set, stop);
        case SearchMethod::bricks: return search_bricks_of(set, stop);
        case SearchMethod::tree: return search_tree(set, stop);
        case SearchMethod::scan: break;
        }
        return search_all(set, stop);
    }

    /// Adds a mesh if one is asked for and possible. @return false when stopped
    bool add_mesh(CellSet& set, const std::stop_token& stop) {
        const std::uint64_t room = set.query.mesh_room;
        if (shading_ == Shading::none || set.ids.empty() || least_mesh_bytes(set.ids.size()) > room)
            return true;
        const auto started = Clock::now();
        CellMesh mesh;
        if (!(by_chunks_ ? layers_.make_mesh(set, mesh, stop)
                         : make_mesh(makers_, whole(set.query.step, stop).values, set.query,
                                     set.ids, mesh, stop)))
            return false;
        if (bytes_of(mesh) <= room)
            set.mesh = std::make_shared<const CellMesh>(std::move(mesh));
        set.shading_time += Clock::now() - started;
        return true;
    }

    bool shade(CellSet& set, const std::stop_token& stop) {
        return by_chunks_ ? layers_.shade_cells(set, stop)
                          : shade_cells(whole(set.query.step, stop).values, set, stop);
    }

    /// The whole step, loaded when first needed: loading may decode a file, and a step without
    /// active cells does not need it.
    const LoadedStep& whole(std::uint32_t step, const std::stop_token& stop) {
        if (!step_)
            step_ = file_->load(step, stop);
        return *step_;
    }

    bool search_cells(CellSet& set, const std::stop_token& stop) {
        const auto cut = file_->levels().cut(file_->info().scaling, set.query.isovalue);
        if (!cut)
            return true;
        const auto held = file_->cells()->hold();
        certain_.clear();
        ambiguous_.clear();
        file_->cells()->search(set.query.step, *cut, certain_, ambiguous_);
        assign_ids(certain_, set.ids);
        set.candidates = set.ids.size();
        if (!ambiguous_.empty()) {
            assign_ids(ambiguous_, candidates_);
            set.candidates += candidates_.size();
            if (!test_candidates(set, stop))
                return false;
        }
        sort_ids(set.ids, file_->info().grid.cell_count());
        return !stop.stop_requested();
    }

    bool search_bricks_of(CellSet& set, const std::stop_token& stop) {
        if (by_chunks_)
            return layers_.search(set, true, shading_ != Shading::none, stop);
        const LoadedStep& loaded = whole(set.query.step, stop);
        const LevelMapPtr levels = file_->chunks().levels(set.query.step);
        set.candidates = search_bricks(loaded.values, *levels, loaded.bricks, set.query, set.ids);
        sort_ids(set.ids, file_->info().grid.cell_count());
        return !stop.stop_requested();
    }

    bool search_tree(CellSet& set, const std::stop_token& stop) {
        if (!tree_)
            tree_ = tree_of(*file_);
        set.reused = tree_->search_incremental(cursor_, set.query.step,
                                                       keys_.threshold(set.query.isovalue));
        candidates_ = cursor_.cells;
        set.candidates = candidates_.size();
        return test_candidates(set, stop);
    }

    /// Appends the active ones of `candidates_`, ascending.
    bool test_candidates(CellSet& set, const std::stop_token& stop) {
        // Sorts first, so that the test reads the volume in order.
        sort_ids(candidates_, file_->info().grid.cell_count());
        if (by_chunks_) {
            if (!layers_.keep_active(set.query, candidates_, stop))
                return false;
            set.ids.insert(set.ids.end(), candidates_.begin(), candidates_.end());
            return true;
        }
        const StepValues& values = whole(set.query.step, stop).values;
        set.ids.reserve(set.ids.size() + candidates_.size());
        for (std::size_t at = 0; at < candidates_.size(); at += kCandidatesPerLook) {
            if (stop.stop_requested())
                return false;
            const auto first = candidates_.begin() + static_cast<std::ptrdiff_t>(at);
            chunk_.assign(first, first + static_cast<std::ptrdiff_t>(std::min(
                                             kCandidatesPerLook, candidates_.size() - at)));
            keep_active(values, set.query, chunk_);
            set.ids.insert(set.ids.end(), chunk_.begin(), chunk_.end());
        }
        return !stop.stop_requested();
    }

    /// Scans some z layers at a time, so that a stop is noticed between them.
    bool search_all(CellSet& set, const std::stop_token& stop) {
        if (by_chunks_)
            return layers_.search(set, false, shading_ != Shading::none, stop);
        const StepValues& values = whole(set.query.step, stop).values;
        StepValues slab = values;
        const auto [width, height, depth] = slab.grid.cells();
        const std::uint64_t layer_cells = std::uint64_t{width} * height;
        const std::uint64_t layer_bytes =
            std::uint64_t{slab.grid.vertices[0]} * slab.grid.vertices[1] * size_of(slab.type);
        const auto layers = static_cast<std::uint32_t>(
            std::clamp<std::uint64_t>(kScanChunk / layer_cells, 1, depth));
        for (std::uint32_t z = 0; z < depth; z += layers) {
            if (stop.stop_requested())
                return false;
            slab.first = values.first + z * layer_bytes;
            slab.grid.vertices[2] = std::min(layers, depth - z) + 1;
            chunk_.clear();
            scan(slab, set.query, chunk_);
            for (const CellId id : chunk_)
                set.ids.push_back(static_cast<CellId>(id + z * layer_cells));
        }
        set.candidates = set.ids.size();
        return true;
    }

    std::shared_ptr<const IndexFile> file_;
    SearchMethod method_;
    bool free_; ///< to search by bricks instead of cells
    Shading shading_;
    std::vector<bool> answered_; ///< by step
    KeyMap keys_;
    std::shared_ptr<const ThiTree> tree_; ///< once it is needed
    ThiTree::Cursor cursor_;
    LayerSearch layers_;
    std::vector<MeshMaker> makers_{thread_count(0)};
    bool by_chunks_ = false;         ///< works on the chunks of the query's step
    std::optional<LoadedStep> step_; ///< else the whole step, once it is needed
    // Kept for their memory:
    std::vector<CellId> candidates_, chunk_;
    std::vector<IdRun> certain_, ambiguous_;
};

} // namespace

bool can_search(const IndexFile& file, SearchMethod method) {
    switch (method) {
    case SearchMethod::cells: return file.cells();
    case SearchMethod::bricks: return file.plan().tiers.has(Tier::bricks);
    case SearchMethod::tree: return file.stats().tree_bytes > 0;
    case SearchMethod::scan: break;
    }
    return true;
}

SearchMethod cheapest_method(const IndexFile& file) {
    for (const SearchMethod method :
         {SearchMethod::cells, SearchMethod::bricks, SearchMethod::tree})
        if (can_search(file, method))
            return method;
    return SearchMethod::scan;
}

// `std::function` wants something that can be copied; the state of a search must not be.
SearchInto search_into(std::shared_ptr<const IndexFile> file, std::optional<SearchMethod> method,
                       Shading shading) {
    return [search = std::make_shared<IndexSearch>(std::move(file), method, shading)](
               const Query& query, const std::stop_token& stop, CellSet& set) {
        return (*search)(query, stop, set);
    };
}

Search search_in(std::shared_ptr<const IndexFile> file, std::optional<SearchMethod> method,
                 Shading shading) {
    return [search = search_into(std::move(file), method, shading)](
               const Query& query, const std::stop_token& stop) -> CellSetPtr {
        auto set = std::make_shared<CellSet>();
        return search(query, stop, *set) ? set : nullptr;
    };
}

} // namespace isochron::index
