// The search in an open index, as the worker runs it.
#include "index/search/index_search.h"

#include "index/error.h"
#include "index/search/id_sort.h"
#include "index/search/layer_search.h"
#include "index/search/tree_of_file.h"

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
          shading_(shading), keys_(file_->info().type, file_->info().scaling), layers_(file_) {}

    bool operator()(const StepView& step, double isovalue, const std::stop_token& stop,
                    CellSet& set) {
        const auto started = Clock::now();
        set.query = {step.at(), isovalue};
        set.method = method_at(step);
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
        file_->chunks().worked_on(step.at().step);
        if (step.between())
            file_->chunks().worked_on(step.at().step + 1);
        return true;
    }

  private:
    using Clock = std::chrono::steady_clock;

    /// The method at a step, or between two, where only bricks help.
    SearchMethod method_at(const StepView& step) const {
        if (!step.between() || method_ == SearchMethod::scan)
            return method_;
        return can_search(*file_, SearchMethod::bricks) ? SearchMethod::bricks : SearchMethod::scan;
    }

    bool search(const StepView& step, CellSet& set, const std::stop_token& stop) {
        if (set.method == SearchMethod::tree)
            return search_tree(step, set, stop);
        return layers_.search(step, set, set.method == SearchMethod::bricks,
                              shading_ != Shading::none, stop);
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
    Shading shading_;
    KeyMap keys_;
    std::shared_ptr<const ThiTree> tree_; ///< once it is needed
    ThiTree::Cursor cursor_;
    LayerSearch layers_;
    std::vector<CellId> candidates_; ///< kept for its memory
};

} // namespace

bool can_search(const IndexFile& file, SearchMethod method) {
    switch (method) {
    case SearchMethod::bricks: return file.plan().tiers.has(Tier::bricks);
    case SearchMethod::tree: return file.stats().tree_bytes > 0;
    case SearchMethod::scan: break;
    }
    return true;
}

SearchMethod cheapest_method(const IndexFile& file) {
    for (const SearchMethod method : {SearchMethod::bricks, SearchMethod::tree})
        if (can_search(file, method))
            return method;
    return SearchMethod::scan;
}

StepView step_of_query(const IndexFile& file, Instant at, std::span<const double> isovalues) {
    if (const std::size_t steps = file.info().steps(); at.step >= steps)
        throw Error("step {}: expected 0 to {}", at.step, steps - 1);
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
