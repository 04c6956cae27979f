// Searches the stretches of an epoch, and checks every table at its first use.
#include "index/cells/cell_tier.h"

#include "index/error.h"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <string_view>
#include <utility>

namespace isochron::index {
namespace {

constexpr std::uint32_t kEpoch = TimePath::kMaxSteps;

template <class Unit>
std::vector<Unit> views(std::string_view kind, const CellTier::Units& units,
                        const Stretches& stretches, std::size_t expected) {
    if (units.size() != expected)
        throw Error(fmt::format("{}: {} units, {} expected", kind, units.size(), expected));
    std::vector<Unit> all;
    for (std::size_t i = 0; i < units.size(); ++i)
        all.emplace_back(units[i],
                         stretches.first_cell(static_cast<std::uint32_t>(i % stretches.count())));
    return all;
}

[[noreturn]] void refuse(std::string_view kind, std::uint32_t epoch, std::uint32_t stretch) {
    throw Error(fmt::format("{} of chunk {} in epoch {}: damaged", kind, stretch, epoch));
}

} // namespace

CellTier::CellTier(const Stretches& stretches, std::uint32_t steps, const Units& cells,
                   const Units& deltas, const Pages* pages, std::uint64_t budget)
    : stretches_(stretches), steps_(steps),
      cells_(views<CellUnit>("cells", cells, stretches,
                             std::size_t{stretches.count()} * epoch_count(steps))),
      deltas_(views<DeltaUnit>("deltas", deltas, stretches, deltas.empty() ? 0 : cells.size())),
      sound_steps_(cells.size() * kEpoch), sound_tables_(cells.size() * 2 * kEpoch),
      sound_transitions_(deltas.size() * kEpoch), pages_(pages), budget_(budget) {}

std::uint64_t CellTier::held_bytes() const {
    std::uint64_t bytes = 0;
    if (pages_)
        for (const auto& pages : *pages_)
            bytes += pages->held();
    return bytes;
}

std::shared_lock<std::shared_mutex> CellTier::hold() const {
    if (pages_ && held_bytes() > budget_)
        if (const std::unique_lock alone(held_, std::try_to_lock); alone) {
            for (Marks* marks : {&sound_steps_, &sound_tables_, &sound_transitions_})
                marks->clear();
            for (const auto& pages : *pages_)
                pages->drop();
        }
    return std::shared_lock(held_);
}

std::uint32_t CellTier::epoch_steps(std::uint32_t epoch) const {
    return std::min(kEpoch, steps_ - epoch * kEpoch);
}

TimePath CellTier::path_to(std::uint32_t step) const {
    return {TimeNode::root(epoch_steps(step / kEpoch)), step % kEpoch};
}

/// Checks what a search at a step needs of a unit, if it has not been checked for other steps.
void CellTier::check_cells(std::uint32_t epoch, std::uint32_t stretch, std::uint32_t step) const {
    const std::size_t i = std::size_t{epoch} * stretches_.count() + stretch;
    const CellUnit& unit = cells_[i];
    need(epoch, unit.head_bytes(epoch_steps(epoch)));
    if (!unit.check_head(epoch_steps(epoch), stretches_.cells(stretch)))
        refuse("cells", epoch, stretch);
    for (const std::uint32_t node : path_to(step)) {
        const std::size_t mark = i * 2 * kEpoch + node;
        if (sound_tables_[mark])
            continue;
        need(epoch, unit.table_bytes(node));
        if (!unit.check_table(node))
            refuse("cells", epoch, stretch);
        sound_tables_.set(mark);
    }
    sound_steps_.set(i * kEpoch + step % kEpoch);
}

void CellTier::check_deltas(std::uint32_t epoch, std::uint32_t stretch, std::uint32_t step) const {
    const std::size_t i = std::size_t{epoch} * stretches_.count() + stretch;
    const DeltaUnit& unit = deltas_[i];
    need(epoch, unit.head_bytes(epoch_steps(epoch)));
    if (!unit.check_head(epoch_steps(epoch), stretches_.cells(stretch)))
        refuse("deltas", epoch, stretch);
    need(epoch, unit.table_bytes(2 * (step % kEpoch)));
    need(epoch, unit.table_bytes(2 * (step % kEpoch) + 1));
    if (!unit.check_transition(step % kEpoch))
        refuse("deltas", epoch, stretch);
    sound_transitions_.set(i * kEpoch + step % kEpoch);
}

/// Announces the heads that a first search at a step needs, so that the disk works on all of them.
void CellTier::expect_cells(std::uint32_t step) const {
    const std::size_t begin = std::size_t{step / kEpoch} * stretches_.count();
    for (std::uint32_t stretch = 0; stretch < stretches_.count(); ++stretch)
        if (!sound_steps_[(begin + stretch) * kEpoch + step % kEpoch])
            (*pages_)[step / kEpoch]->expect(
                cells_[begin + stretch].head_bytes(epoch_steps(step / kEpoch)));
}

/// Calls `f` with the cells of every stretch, checked as far as the step needs them, while the
/// references of the stretch after the next and the next one's tables are prefetched.
template <class F>
void CellTier::for_each_cells(std::uint32_t step, F&& f) const {
    assert(step < steps_);
    const std::uint32_t epoch = step / kEpoch, stretches = stretches_.count();
    const TimePath path = path_to(step);
    const std::size_t begin = std::size_t{epoch} * stretches;
    if (pages_ && !sound_steps_[begin * kEpoch + step % kEpoch])
        expect_cells(step);
    for (std::uint32_t stretch = 0; stretch < stretches; ++stretch) {
        if (stretch + 2 < stretches)
            cells_[begin + stretch + 2].prefetch(path);
        // Only tables that have been checked: others may still be on their way from the file.
        if (stretch + 1 < stretches && sound_steps_[(begin + stretch + 1) * kEpoch + step % kEpoch])
            cells_[begin + stretch + 1].prefetch_tables(path);
        if (!sound_steps_[(begin + stretch) * kEpoch + step % kEpoch])
            check_cells(epoch, stretch, step);
        f(cells_[begin + stretch]);
    }
}

void CellTier::search(std::uint32_t step, LevelMap::Cut cut, std::vector<IdRun>& certain,
                      std::vector<IdRun>& ambiguous) const {
    const TimePath path = path_to(step);
    RunBuffer certain_runs(certain), ambiguous_runs(ambiguous);
    for_each_cells(
        step, [&](const CellUnit& unit) { unit.search(path, cut, certain_runs, ambiguous_runs); });
}

std::uint64_t CellTier::missing_bytes(std::uint32_t step) const {
    constexpr std::uint32_t kSampled = 8;
    if (!pages_)
        return 0;
    const std::uint32_t epoch = step / kEpoch, stretches = stretches_.count();
    const LazyPart& pages = *(*pages_)[epoch];
    const std::uint32_t sampled = std::min(kSampled, stretches);
    std::uint64_t missing = 0;
    for (std::uint32_t i = 0; i < sampled; ++i) {
        const auto stretch =
            static_cast<std::uint32_t>((std::uint64_t{2} * i + 1) * stretches / (2 * sampled));
        const CellUnit& unit = cells_[std::size_t{epoch} * stretches + stretch];
        const auto head = unit.head_bytes(epoch_steps(epoch));
        missing += pages.missing(head);
        pages.need(head);
        if (!unit.check_head(epoch_steps(epoch), stretches_.cells(stretch)))
            return 0;
        for (const std::uint32_t node : path_to(step))
            missing += pages.missing(unit.table_bytes(node));
    }
    return missing * stretches / sampled;
}

void CellTier::change(std::uint32_t from, std::uint32_t to, LevelMap::Cut cut,
                      std::vector<IdRun>& added, std::vector<IdRun>& removed) const {
    assert(std::max(from, to) == std::min(from, to) + 1 && cut.exact && has_deltas());
    if (from > to)
        return change(to, from, cut, removed, added);
    assert(to < steps_);
    const std::uint32_t epoch = to / kEpoch, stretches = stretches_.count(), into = to % kEpoch;
    const std::size_t begin = std::size_t{epoch} * stretches;
    RunBuffer added_runs(added), removed_runs(removed);
    for (std::uint32_t stretch = 0; stretch < stretches; ++stretch) {
        if (stretch + 1 < stretches)
            deltas_[begin + stretch + 1].prefetch(into);
        if (!sound_transitions_[(begin + stretch) * kEpoch + into])
            check_deltas(epoch, stretch, to);
        deltas_[begin + stretch].change(into, cut, added_runs, removed_runs);
    }
}

void CellTier::difference(std::uint32_t step_a, std::uint32_t step_b, LevelMap::Cut cut,
                          std::vector<IdRun>& only_a, std::vector<IdRun>& only_b) const {
    assert(step_a < steps_ && step_b < steps_ && cut.exact);
    if (step_a == step_b)
        return;
    std::vector<IdRun> none; // stays empty
    const std::uint32_t epoch = step_a / kEpoch;
    if (epoch != step_b / kEpoch) {
        search(step_a, cut, only_a, none);
        search(step_b, cut, only_b, none);
        return;
    }
    const TimeNode common = TimePath::common(epoch_steps(epoch), step_a % kEpoch, step_b % kEpoch);
    for (const auto& [step, out] : {std::pair(step_a, &only_a), std::pair(step_b, &only_b)}) {
        const TimePath path(common.towards(step % kEpoch), step % kEpoch);
        RunBuffer runs(*out), none_runs(none);
        for_each_cells(step,
                       [&](const CellUnit& unit) { unit.search(path, cut, runs, none_runs); });
    }
}

void CellTier::level_difference(std::uint32_t step, LevelMap::Cut from, LevelMap::Cut to,
                                std::vector<IdRun>& added, std::vector<IdRun>& removed) const {
    const TimePath path = path_to(step);
    RunBuffer added_runs(added), removed_runs(removed);
    for_each_cells(step, [&](const CellUnit& unit) {
        unit.level_difference(path, from, to, added_runs, removed_runs);
    });
}

void CellTier::verify() const {
    for (std::size_t unit = 0; unit < cells_.size(); ++unit)
        verify_unit(unit);
}

void CellTier::verify_unit(std::size_t unit) const {
    const auto epoch = static_cast<std::uint32_t>(unit / stretches_.count());
    const auto stretch = static_cast<std::uint32_t>(unit % stretches_.count());
    const std::uint32_t steps = epoch_steps(epoch), cells = stretches_.cells(stretch);
    if (!cells_[unit].check(steps, cells))
        refuse("cells", epoch, stretch);
    if (has_deltas() && !deltas_[unit].check(steps, cells))
        refuse("deltas", epoch, stretch);
}

std::vector<TimeNodeCells> CellTier::nodes() const {
    std::vector<TimeNodeCells> all;
    for (std::uint32_t epoch = 0; epoch < epoch_count(steps_); ++epoch) {
        std::vector<std::uint64_t> cells(TimeNode::count(epoch_steps(epoch)));
        for (std::uint32_t stretch = 0; stretch < stretches_.count(); ++stretch) {
            const CellUnit& unit = cells_[std::size_t{epoch} * stretches_.count() + stretch];
            need(epoch, unit.head_bytes(epoch_steps(epoch)));
            if (!unit.check_head(epoch_steps(epoch), stretches_.cells(stretch)))
                refuse("cells", epoch, stretch);
            for (std::uint32_t node = 0; node < cells.size(); ++node)
                if (const auto table = unit.table_bytes(node); !table.empty())
                    need(epoch, table.first(sizeof(CellTableHead)));
            const std::vector<std::uint32_t> entries = unit.entries();
            for (std::size_t node = 0; node < cells.size(); ++node)
                cells[node] += entries[node];
        }
        const auto add = [&](const auto& self, const TimeNode& node) -> void {
            all.push_back({epoch * kEpoch + node.first, epoch * kEpoch + node.last, node.depth,
                           cells[node.number]});
            if (node.is_leaf())
                return;
            self(self, node.left());
            self(self, node.right());
        };
        add(add, TimeNode::root(epoch_steps(epoch)));
    }
    return all;
}

} // namespace isochron::index
