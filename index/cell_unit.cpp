// Search in the cells and the deltas of one chunk in one epoch.
#include "index/cell_unit.h"

#include <cassert>

namespace isochron::index {

bool CellTables::check(const Expected& expected) const {
    constexpr std::size_t kSlackBytes = IdRun::kSlack * sizeof(std::uint16_t);
    const std::uint64_t begin =
        sizeof(CellUnitHead) + std::uint64_t{expected.tables} * sizeof(TableRef);
    if (reinterpret_cast<std::uintptr_t>(bytes_) % 8 != 0 || size_ < begin + kSlackBytes)
        return false;
    if (head().magic != expected.magic || head().tables != expected.tables ||
        head().steps != expected.steps || head().cells != expected.cells || head().lossless > 1 ||
        head().bytes != size_)
        return false;
    for (std::uint32_t i = 0; i < head().tables; ++i) {
        const std::uint64_t offset = std::uint64_t{refs()[i].offset} * CellTable::kAlignment;
        if (offset == 0)
            continue;
        if (offset < begin || offset > size_ - kSlackBytes ||
            !CellTable::check({bytes_ + offset, size_ - kSlackBytes - offset}, head().cells))
            return false;
    }
    return true;
}

std::vector<std::uint32_t> CellTables::entries() const {
    std::vector<std::uint32_t> counts;
    for (std::uint32_t i = 0; i < head().tables; ++i)
        counts.push_back(refs()[i].offset ? table(refs()[i]).head().entries : 0);
    return counts;
}

bool CellUnit::check(std::uint32_t steps, std::uint32_t cells) const {
    return tables_.check({kMagic, TimeNode::count(steps), steps, cells});
}

void CellUnit::search(const TimePath& path, LevelMap::Cut cut, std::vector<IdRun>& certain,
                      std::vector<IdRun>& ambiguous) const {
    const std::uint32_t level = cut.level;
    if (tables_.head().lossless) {
        for (const std::uint32_t node : path)
            if (const auto table = tables_.at_level(node, level - 1))
                table->up_to(level - 1, {level - 1}, first_, certain);
        return;
    }
    for (const std::uint32_t node : path)
        if (const auto table = tables_.at_level(node, level)) {
            if (level > 0)
                table->up_to(level - 1, {cut.exact ? level : level + 1}, first_, certain);
            if (cut.exact)
                continue;
            table->up_to(level, {level, level + 1}, first_, ambiguous);
            table->between(static_cast<std::int32_t>(level) - 1, level, {level + 1}, first_,
                           ambiguous);
        }
}

void CellUnit::level_difference(const TimePath& path, LevelMap::Cut from, LevelMap::Cut to,
                                std::vector<IdRun>& added, std::vector<IdRun>& removed) const {
    assert(from.exact && to.exact);
    if (from.level > to.level)
        return level_difference(path, to, from, removed, added);
    if (from.level == to.level)
        return;
    // An entry's column is its low rank; its row is the high rank of a lossy map, else one less.
    const std::uint32_t lossy = !tables_.head().lossless;
    const std::uint32_t low = from.level - 1u, high = to.level - 1u;
    for (const std::uint32_t node : path)
        if (const auto table = tables_.at_any_level(node)) {
            table->up_to(low, {low + lossy, high + lossy}, first_, removed);
            table->between(static_cast<std::int32_t>(low), high, {high + lossy}, first_, added);
        }
}

bool DeltaUnit::check(std::uint32_t steps, std::uint32_t cells) const {
    return tables_.check({kMagic, 2 * steps, steps, cells});
}

void DeltaUnit::change(std::uint32_t into_step, LevelMap::Cut cut, std::vector<IdRun>& added,
                       std::vector<IdRun>& removed) const {
    assert(cut.exact);
    const std::uint32_t level = cut.level - 1u;
    if (const auto table = tables_.at_level(2 * into_step, level))
        table->up_to(level, {level}, first_, added);
    if (const auto table = tables_.at_level(2 * into_step + 1, level))
        table->up_to(level, {level}, first_, removed);
}

} // namespace isochron::index
