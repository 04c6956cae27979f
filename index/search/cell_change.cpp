// Incremental search: finds the changes in the set of active cells from one query to another.
#include "index/search/cell_change.h"

#include "index/error.h"
#include "index/search/index_search.h"
#include "index/search/layer_search.h"
#include "index/search/staying_cells.h"

#include <algorithm>
#include <array>
#include <iterator>
#include <utility>
#include <vector>

namespace isochron::index {
namespace {

/// Where a smaller share of the chunks stays, a full search takes no longer than two of the others.
constexpr double kLeastStaying = 0.5;

} // namespace

struct ChangeSearch::WorkSpace {
    explicit WorkSpace(const std::shared_ptr<const IndexFile>& file)
        : search(search_in(file, std::nullopt, Shading::none)), layers(file) {}

    Search search;
    LayerSearch layers;
    CellSetPtr set; ///< result of a full search
    std::vector<CellId> come, gone;
};

ChangeSearch::ChangeSearch(std::shared_ptr<const IndexFile> file)
    : file_(std::move(file)), work_(std::make_unique<WorkSpace>(file_)) {}

ChangeSearch::~ChangeSearch() = default;

CellChange ChangeSearch::searched(const Query& to) {
    work_->set = work_->search(to, {});
    return {true, work_->set->ids, {}};
}

/// Searches both steps where chunks differ. @return nothing if most of them do
std::optional<CellChange> ChangeSearch::where_chunks_change(const Query& from, const Query& to) {
    const StepView before = part_of_step(*file_, from.instant),
                   after = part_of_step(*file_, to.instant);
    if (staying_share(after, from.instant, std::array{to.isovalue}) < kLeastStaying)
        return std::nullopt;
    const StayingCells staying(after, from.instant, false);
    CellSet gone, come;
    gone.query = from;
    come.query = to;
    for (const auto& [step, set] : {std::pair{&before, &gone}, std::pair{&after, &come}}) {
        if (!step->by_chunks())
            step->whole({}); // before there are several threads
        work_->layers.search_others(*step, *set, staying, false, {});
    }
    work_->come.clear();
    work_->gone.clear();
    std::ranges::set_difference(come.ids, gone.ids, std::back_inserter(work_->come));
    std::ranges::set_difference(gone.ids, come.ids, std::back_inserter(work_->gone));
    return CellChange{false, work_->come, work_->gone};
}

CellChange ChangeSearch::operator()(const Query& from, const Query& to) {
    const std::size_t steps = file_->info().steps();
    if (const std::uint32_t last = std::max(from.instant.step, to.instant.step); last >= steps)
        throw Error("step {}: expected 0 to {}", last, steps - 1);
    if (from == to)
        return {};
    if (from.instant != to.instant && !from.instant.between() && !to.instant.between() &&
        from.isovalue == to.isovalue && file_->has_since() &&
        can_search(*file_, SearchMethod::bricks))
        if (const auto change = where_chunks_change(from, to))
            return *change;
    return searched(to);
}

} // namespace isochron::index
