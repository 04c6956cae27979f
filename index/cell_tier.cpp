// Search over the chunks of an epoch, with a check of every unit at its first use.
#include "index/cell_tier.h"

#include "index/error.h"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <utility>

namespace isochron::index {

constexpr std::uint32_t kEpoch = TimePath::kMaxSteps;

CellTier::CellTier(const Chunking& chunking, std::uint32_t steps, const Units& cells,
                   const Units& deltas, FirstTouch first_touch)
    : chunking_(chunking), steps_(steps), first_touch_(std::move(first_touch)),
      cells_(unchecked<CellUnit>("cells", cells)), deltas_(unchecked<DeltaUnit>("deltas", deltas)) {
    const std::size_t expected = std::size_t{chunking.count()} * ((steps + kEpoch - 1) / kEpoch);
    if (cells.size() != expected)
        throw Error(fmt::format("cells: {} units, {} expected", cells.size(), expected));
    if (!deltas.empty() && deltas.size() != expected)
        throw Error(fmt::format("deltas: {} units, {} expected", deltas.size(), expected));
}

template <class Unit>
CellTier::Checked<Unit> CellTier::unchecked(const char* kind, const Units& bytes) const {
    Checked<Unit> all{kind, bytes, {}, std::make_unique<std::atomic<bool>[]>(bytes.size())};
    for (std::size_t i = 0; i < bytes.size(); ++i)
        all.units.emplace_back(
            bytes[i], chunking_.first_cell(static_cast<std::uint32_t>(i % chunking_.count())));
    return all;
}

/// The unit, which its first use checks; several threads may do so at once.
template <class Unit>
const Unit& CellTier::unit(const Checked<Unit>& all, std::uint32_t epoch,
                           std::uint32_t chunk) const {
    const std::size_t i = std::size_t{epoch} * chunking_.count() + chunk;
    if (!all.sound[i].load(std::memory_order_acquire)) {
        if (first_touch_)
            first_touch_(all.bytes[i]);
        if (!all.units[i].check(epoch_steps(epoch), chunking_.cells(chunk)))
            throw Error(fmt::format("{} of chunk {} in epoch {}: damaged", all.kind, chunk, epoch));
        all.sound[i].store(true, std::memory_order_release);
    }
    return all.units[i];
}

std::uint32_t CellTier::epoch_steps(std::uint32_t epoch) const {
    return std::min(kEpoch, steps_ - epoch * kEpoch);
}

/// Calls `f` with the unit of every chunk in an epoch, while the next one's first bytes are on
/// their way.
template <class Unit, class Prefetch, class F>
void CellTier::for_each_chunk(const Checked<Unit>& all, std::uint32_t epoch, Prefetch&& prefetch,
                              F&& f) const {
    const Unit* units = all.units.data() + std::size_t{epoch} * chunking_.count();
    for (std::uint32_t chunk = 0; chunk < chunking_.count(); ++chunk) {
        if (chunk + 1 < chunking_.count())
            prefetch(units[chunk + 1]);
        f(unit(all, epoch, chunk));
    }
}

template <class F>
void CellTier::for_each_chunk(const TimePath& path, std::uint32_t epoch, F&& f) const {
    for_each_chunk(
        cells_, epoch, [&](const CellUnit& next) { next.prefetch(path); }, f);
}

void CellTier::search(std::uint32_t step, LevelMap::Cut cut, std::vector<IdRun>& certain,
                      std::vector<IdRun>& ambiguous) const {
    assert(step < steps_);
    const std::uint32_t epoch = step / kEpoch;
    const TimePath path(TimeNode::root(epoch_steps(epoch)), step % kEpoch);
    for_each_chunk(path, epoch,
                   [&](const CellUnit& unit) { unit.search(path, cut, certain, ambiguous); });
}

void CellTier::change(std::uint32_t from, std::uint32_t to, LevelMap::Cut cut,
                      std::vector<IdRun>& added, std::vector<IdRun>& removed) const {
    assert(std::max(from, to) == std::min(from, to) + 1 && cut.exact && has_deltas());
    if (from > to)
        return change(to, from, cut, removed, added);
    assert(to < steps_);
    const std::uint32_t into = to % kEpoch;
    for_each_chunk(
        deltas_, to / kEpoch, [&](const DeltaUnit& next) { next.prefetch(into); },
        [&](const DeltaUnit& unit) { unit.change(into, cut, added, removed); });
}

void CellTier::difference(std::uint32_t step_a, std::uint32_t step_b, LevelMap::Cut cut,
                          std::vector<IdRun>& only_a, std::vector<IdRun>& only_b) const {
    assert(step_a < steps_ && step_b < steps_ && cut.exact);
    if (step_a == step_b)
        return;
    const std::uint32_t epoch = step_a / kEpoch;
    std::vector<IdRun> none; // stays empty
    if (epoch != step_b / kEpoch) {
        search(step_a, cut, only_a, none);
        search(step_b, cut, only_b, none);
        return;
    }
    const std::uint32_t a = step_a % kEpoch, b = step_b % kEpoch;
    const TimeNode common = TimePath::common(epoch_steps(epoch), a, b);
    for (const auto& [step, out] : {std::pair(a, &only_a), std::pair(b, &only_b)}) {
        const TimePath path(common.towards(step), step);
        for_each_chunk(path, epoch,
                       [&](const CellUnit& unit) { unit.search(path, cut, *out, none); });
    }
}

void CellTier::level_difference(std::uint32_t step, LevelMap::Cut from, LevelMap::Cut to,
                                std::vector<IdRun>& added, std::vector<IdRun>& removed) const {
    assert(step < steps_);
    const std::uint32_t epoch = step / kEpoch;
    const TimePath path(TimeNode::root(epoch_steps(epoch)), step % kEpoch);
    for_each_chunk(path, epoch, [&](const CellUnit& unit) {
        unit.level_difference(path, from, to, added, removed);
    });
}

} // namespace isochron::index
