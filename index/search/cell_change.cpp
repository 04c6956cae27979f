// Incremental search: finds the changes in the set of active cells from one query to another.
#include "index/search/cell_change.h"

#include "index/error.h"
#include "index/search/index_search.h"
#include "index/search/layer_search.h"
#include "index/search/staying_cells.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <limits>
#include <optional>
#include <utility>

namespace isochron::index {
namespace {

/// Moving fewer ids than this takes less time than counting the ids of a full search.
constexpr std::size_t kFew = 4096;
/// A longer chain of deltas touches more memory than a full search.
constexpr std::uint32_t kMaxChain = 8;
/// Where a smaller share of the chunks stays, a full search takes no longer than two of the others.
constexpr double kLeastStaying = 0.5;

using Cut = LevelMap::Cut;

} // namespace

struct ChangeSearch::WorkSpace {
    explicit WorkSpace(const std::shared_ptr<const IndexFile>& file)
        : scaling(file->info().scaling), cells(file->cells()),
          levels(cells ? &file->levels() : nullptr),
          steps(static_cast<std::uint32_t>(file->info().steps())),
          search(search_in(file, std::nullopt, Shading::none)), layers(file) {}

    /// The cut at an isovalue; keeps the last one, since playback repeats the same isovalue.
    const std::optional<Cut>& cut_at(double isovalue) {
        if (!(isovalue == last_isovalue)) {
            last_cut = levels->cut(scaling, isovalue);
            last_isovalue = isovalue;
        }
        return last_cut;
    }

    const Scaling& scaling;
    const CellTier* cells;
    const LevelMap* levels; ///< levels of the cells
    std::uint32_t steps;
    double last_isovalue = std::numeric_limits<double>::quiet_NaN();
    std::optional<Cut> last_cut;

    Search search; ///< for indices without cells
    std::vector<IdRun> added, removed, all, ambiguous;
    std::vector<CellId> added_ids, removed_ids, come, gone;
    CellSetPtr set; ///< set of an index without cells
    LayerSearch layers;

    void clear() {
        added.clear();
        removed.clear();
    }
};

ChangeSearch::ChangeSearch(std::shared_ptr<const IndexFile> file)
    : file_(std::move(file)), work_(std::make_unique<WorkSpace>(file_)) {}

ChangeSearch::~ChangeSearch() = default;

namespace {

/// Copies the ids of the runs into memory that only grows.
std::span<CellId> ids_of(const std::vector<IdRun>& runs, std::vector<CellId>& memory) {
    const std::size_t wanted = count_ids(runs) + IdRun::kSlack;
    if (memory.size() < wanted)
        memory.resize(wanted);
    return {memory.data(), copy_ids(runs, memory)};
}

/// Removes ids that are in both sets. A cell that came and went is in both sets; a cell that
/// changed several times is in one set once more than in the other.
void drop_common(std::span<CellId> added, std::span<CellId> removed, std::vector<CellId>& come,
                 std::vector<CellId>& gone) {
    std::sort(added.begin(), added.end());
    std::sort(removed.begin(), removed.end());
    come.clear();
    gone.clear();
    std::set_difference(added.begin(), added.end(), removed.begin(), removed.end(),
                        std::back_inserter(come));
    std::set_difference(removed.begin(), removed.end(), added.begin(), added.end(),
                        std::back_inserter(gone));
}

} // namespace

CellChange ChangeSearch::searched(const Query& to) {
    work_->set = work_->search(to, {});
    return {true, work_->set->ids, {}};
}

/// Without cells, bricks can tell only whether two isovalues lie between the same values of a step.
CellChange ChangeSearch::without_cells(const Query& from, const Query& to) {
    if (from.step == to.step && can_search(*file_, SearchMethod::bricks)) {
        const LevelMapPtr levels = file_->chunks().levels(to.step);
        const auto from_cut = levels->cut(work_->scaling, from.isovalue);
        const auto to_cut = levels->cut(work_->scaling, to.isovalue);
        if (!to_cut)
            return {true, {}, {}};
        if (from_cut == to_cut && to_cut->exact)
            return {};
    }
    if (from.step != to.step && from.isovalue == to.isovalue && file_->has_since() &&
        can_search(*file_, SearchMethod::bricks))
        if (const auto change = where_chunks_change(from, to))
            return *change;
    return searched(to);
}

/// Searches both steps where chunks differ. @return nothing if most of them do
std::optional<CellChange> ChangeSearch::where_chunks_change(const Query& from, const Query& to) {
    const StepView before = part_of_step(*file_, from.step), after = part_of_step(*file_, to.step);
    if (staying_share(after, from.step, std::array{to.isovalue}) < kLeastStaying)
        return std::nullopt;
    const StayingCells staying(after, from.step, false);
    CellSet gone, come;
    gone.query = from;
    come.query = to;
    for (const auto& [step, set] : {std::pair{&before, &gone}, std::pair{&after, &come}}) {
        if (!step->by_chunks())
            step->whole({}); // before there are several threads
        work_->layers.search_others(*step, *set, staying, false, {});
    }
    drop_common(come.ids, gone.ids, work_->come, work_->gone);
    return CellChange{false, work_->come, work_->gone};
}

CellChange ChangeSearch::operator()(const Query& from, const Query& to) {
    WorkSpace& work = *work_;
    if (const std::uint32_t last = std::max(from.step, to.step); last >= work.steps)
        throw Error(fmt::format("step {}: expected 0 to {}", last, work.steps - 1));
    if (from.step.between() || to.step.between())
        return from == to ? CellChange{} : searched(to);
    if (!file_->has_cells(from.step) || !file_->has_cells(to.step))
        return without_cells(from, to);
    const CellTier* cells = work.cells;
    const std::optional<Cut> from_cut = work.cut_at(from.isovalue);
    const std::optional<Cut> to_cut =
        from.isovalue == to.isovalue ? from_cut : work.cut_at(to.isovalue);
    if (!to_cut)
        return {true, {}, {}}; // nothing is active any more
    if (from.step == to.step && from_cut == to_cut && to_cut->exact)
        return {};
    if (!to_cut->exact || !from_cut || !from_cut->exact)
        return searched(to);
    const auto held = cells->hold();
    work.clear();
    bool disjoint = true; // each cell is in at most one of the runs
    bool found = true;
    const std::uint32_t steps = from.step < to.step ? to.step - from.step : from.step - to.step;
    if (steps == 0) {
        cells->level_difference(to.step, *from_cut, *to_cut, work.added, work.removed);
    } else if (*from_cut == *to_cut && cells->has_deltas() && steps <= kMaxChain) {
        const bool forwards = from.step < to.step;
        for (std::uint32_t step = from.step; step != to.step;) {
            const std::uint32_t next = forwards ? step + 1 : step - 1;
            cells->change(step, next, *to_cut, work.added, work.removed);
            step = next;
        }
        disjoint = steps == 1;
    } else if (*from_cut == *to_cut) {
        cells->difference(from.step, to.step, *to_cut, work.removed, work.added);
        disjoint = false;
    } else {
        found = false;
    }
    const std::span added = ids_of(work.added, work.added_ids);
    const std::span removed = ids_of(work.removed, work.removed_ids);
    if (!found || added.size() + removed.size() > kFew) {
        work.all.clear();
        work.ambiguous.clear();
        cells->search(to.step, *to_cut, work.all, work.ambiguous);
        if (!found || added.size() + removed.size() > count_ids(work.all))
            return {true, ids_of(work.all, work.added_ids), {}};
    }
    if (disjoint)
        return {false, added, removed};
    drop_common(added, removed, work.come, work.gone);
    return {false, work.come, work.gone};
}

} // namespace isochron::index
