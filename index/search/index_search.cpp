// The search in an open index, as the worker runs it.
#include "index/search/index_search.h"

#include "index/error.h"
#include "index/file/step_view.h"
#include "index/search/first_visit.h"
#include "index/search/id_sort.h"
#include "index/search/layer_search.h"
#include "index/search/tree_of_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>

namespace isochron::index {
namespace {

class IndexSearch {
  public:
    IndexSearch(std::shared_ptr<const IndexFile> file, std::optional<SearchMethod> forced,
                Shading shading)
        : file_(std::move(file)), method_(forced ? *forced : cheapest_method(*file_)),
          free_(!forced), shading_(shading), answered_(file_->info().steps()),
          keys_(file_->info().type, file_->info().scaling), layers_(file_) {}

    bool operator()(const StepView& step, double isovalue, const std::stop_token& stop,
                    CellSet& set) {
        const auto started = Clock::now();
        set.query = {step.at(), isovalue};
        set.method = method_at(set.query);
        try {
            if (std::isfinite(isovalue) && !search(step, set, stop))
                return false;
            // A search by bricks or by a scan has also shaded, and has set both times.
            if (set.ids.empty() || set.points.empty()) {
                const auto found = Clock::now();
                if (shading_ != Shading::none && !set.ids.empty() &&
                    !layers_.shade_cells(step, set, stop))
                    return false;
                set.search_time = found - started;
                set.shading_time = Clock::now() - found;
            }
        } catch (const Stopped&) {
            return false;
        }
        if (!step.between()) {
            file_->chunks().worked_on(step.at().step);
            answered_[step.at().step] = true;
        }
        return true;
    }

  private:
    using Clock = std::chrono::steady_clock;

    /// The method for a query: appended steps may not have cells yet, the cells of a step may not
    /// have been read, and between steps only bricks help.
    SearchMethod method_at(const Query& query) const {
        const bool bricks = can_search(*file_, SearchMethod::bricks);
        if (query.instant.between()) // cells and tree are of steps alone
            return bricks && method_ != SearchMethod::scan ? SearchMethod::bricks
                                                           : SearchMethod::scan;
        if (method_ != SearchMethod::cells)
            return method_;
        if (!file_->has_cells(query.instant.step))
            return bricks ? SearchMethod::bricks : SearchMethod::scan;
        if (!free_ || !bricks || answered_[query.instant.step] || !std::isfinite(query.isovalue))
            return method_;
        const MissingBytes missing = missing_bytes(*file_, query, shading_ != Shading::none);
        return missing.bricks < missing.cells ? SearchMethod::bricks : method_;
    }

    bool search(const StepView& step, CellSet& set, const std::stop_token& stop) {
        switch (set.method) {
        case SearchMethod::cells: return search_cells(step, set, stop);
        case SearchMethod::tree: return search_tree(step, set, stop);
        case SearchMethod::bricks:
        case SearchMethod::scan: break;
        }
        return layers_.search(step, set, set.method == SearchMethod::bricks,
                              shading_ != Shading::none, stop);
    }

    bool search_cells(const StepView& step, CellSet& set, const std::stop_token& stop) {
        const auto cut = file_->levels().cut(step.scaling(), set.query.isovalue);
        if (!cut)
            return true;
        const auto held = file_->cells()->hold();
        certain_.clear();
        ambiguous_.clear();
        file_->cells()->search(set.query.instant.step, *cut, certain_, ambiguous_);
        assign_ids(certain_, set.ids);
        set.candidates = set.ids.size();
        if (!ambiguous_.empty()) {
            assign_ids(ambiguous_, candidates_);
            set.candidates += candidates_.size();
            if (!test_candidates(step, set, stop))
                return false;
        }
        sort_ids(set.ids, step.grid().cell_count());
        return !stop.stop_requested();
    }

    bool search_tree(const StepView& step, CellSet& set, const std::stop_token& stop) {
        if (!tree_)
            tree_ = tree_of(*file_);
        const auto reused = static_cast<std::ptrdiff_t>(tree_->search_incremental(
            cursor_, set.query.instant.step, keys_.threshold(set.query.isovalue)));
        const auto first = cursor_.cells.begin();
        set.candidates = cursor_.cells.size();
        candidates_.assign(first, first + reused);
        if (!test_candidates(step, set, stop))
            return false;
        set.reused = set.ids.size();
        candidates_.assign(first + reused, cursor_.cells.end());
        if (!test_candidates(step, set, stop))
            return false;
        std::ranges::inplace_merge(set.ids,
                                   set.ids.begin() + static_cast<std::ptrdiff_t>(set.reused));
        return true;
    }

    /// Appends the active ones of `candidates_`, ascending among themselves.
    bool test_candidates(const StepView& step, CellSet& set, const std::stop_token& stop) {
        // Sorts first, so that the test reads the volume in order.
        sort_ids(candidates_, step.grid().cell_count());
        if (!layers_.keep_active(step, set.query, candidates_, stop))
            return false;
        set.ids.insert(set.ids.end(), candidates_.begin(), candidates_.end());
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
    // Kept for their memory:
    std::vector<CellId> candidates_;
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

StepView step_of_query(const IndexFile& file, Instant at, std::span<const double> isovalues) {
    if (const std::size_t steps = file.info().steps(); at.step >= steps)
        throw Error(fmt::format("step {}: expected 0 to {}", at.step, steps - 1));
    return step_of(file, at, isovalues);
}

// `std::function` wants something that can be copied; the state of a search must not be.
SearchInto search_into(std::shared_ptr<const IndexFile> file, std::optional<SearchMethod> method,
                       Shading shading) {
    return [search = std::make_shared<IndexSearch>(std::move(file), method, shading)](
               const StepView& step, double isovalue, const std::stop_token& stop, CellSet& set) {
        return (*search)(step, isovalue, stop, set);
    };
}

Search search_in(std::shared_ptr<const IndexFile> file, std::optional<SearchMethod> method,
                 Shading shading) {
    return [file, search = search_into(file, method, shading)](
               const Query& query, const std::stop_token& stop) -> CellSetPtr {
        auto set = std::make_shared<CellSet>();
        const StepView step = step_of_query(*file, query.instant, {&query.isovalue, 1});
        return search(step, query.isovalue, stop, *set) ? set : nullptr;
    };
}

} // namespace isochron::index
