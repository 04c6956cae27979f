// Searches the cells and the deltas of one stretch in one epoch.
#include "index/cells/cell_unit.h"

#include <xxhash.h>

#include <cassert>
#include <cstddef>
#include <cstring>

namespace isochron::index {

constexpr std::size_t kSlackBytes = IdRun::kSlack * sizeof(std::uint16_t);

std::uint32_t cell_checksum(std::span<const std::byte> bytes) {
    return static_cast<std::uint32_t>(XXH3_64bits(bytes.data(), bytes.size()));
}

bool CellTables::check_head(const Expected& expected) const {
    const std::uint64_t begin =
        sizeof(CellUnitHead) + std::uint64_t{expected.tables} * sizeof(TableRef);
    if (reinterpret_cast<std::uintptr_t>(bytes_) % 8 != 0 || size_ < begin + kSlackBytes)
        return false;
    if (head().magic != expected.magic || head().tables != expected.tables ||
        head().steps != expected.steps || head().cells != expected.cells || head().lossless > 1 ||
        head().bytes != size_)
        return false;
    std::vector<std::byte> unsealed(bytes_, bytes_ + begin);
    std::memset(unsealed.data() + offsetof(CellUnitHead, checksum), 0, sizeof head().checksum);
    return cell_checksum(unsealed) == head().checksum;
}

bool CellTables::lies_inside(const TableRef& ref) const {
    const std::uint64_t end = std::uint64_t{ref.offset} + ref.size;
    return ref.size * CellTableHead::kAlignment >= sizeof(CellTableHead) &&
           end * CellTableHead::kAlignment <= size_ - kSlackBytes;
}

std::span<const std::byte> CellTables::table_bytes(std::uint32_t table) const {
    const TableRef& ref = refs()[table];
    if (ref.offset == 0 || !lies_inside(ref))
        return {};
    return {bytes_ + std::size_t{ref.offset} * CellTableHead::kAlignment,
            std::size_t{ref.size} * CellTableHead::kAlignment};
}

bool CellTables::check_table(std::uint32_t table) const {
    const TableRef& ref = refs()[table];
    if (ref.offset == 0)
        return true;
    if (!lies_inside(ref))
        return false;
    const std::span bytes(bytes_ + std::size_t{ref.offset} * CellTableHead::kAlignment,
                          std::size_t{ref.size} * CellTableHead::kAlignment);
    const std::size_t directory = CellTable(bytes.data()).head().ids;
    return directory <= bytes.size() && cell_checksum(bytes.first(directory)) == ref.checksum &&
           CellTable::check(bytes);
}

bool CellTables::check_tables() const {
    for (std::uint32_t i = 0; i < head().tables; ++i)
        if (!check_table(i) ||
            (refs()[i].offset != 0 && !table(refs()[i]).has_ids_below(head().cells)))
            return false;
    return true;
}

std::vector<std::uint32_t> CellTables::entries() const {
    std::vector<std::uint32_t> counts;
    for (std::uint32_t i = 0; i < head().tables; ++i)
        counts.push_back(
            refs()[i].offset && lies_inside(refs()[i]) ? table(refs()[i]).head().entries : 0);
    return counts;
}

bool CellUnit::check_head(std::uint32_t steps, std::uint32_t cells) const {
    return tables_.check_head({kMagic, TimeNode::count(steps), steps, cells});
}

void CellUnit::search(const TimePath& path, LevelMap::Cut cut, RunBuffer& certain,
                      RunBuffer& ambiguous) const {
    const std::uint32_t threshold = cut.threshold;
    if (tables_.head().lossless) {
        for (const std::uint32_t node : path)
            if (const auto table = tables_.at_level(node, threshold - 1))
                table->up_to(threshold - 1, {threshold - 1}, first_, certain);
        return;
    }
    for (const std::uint32_t node : path)
        if (const auto table = tables_.at_level(node, threshold)) {
            if (threshold > 0)
                table->up_to(threshold - 1, {cut.exact ? threshold : threshold + 1}, first_,
                             certain);
            if (cut.exact)
                continue;
            table->up_to(threshold, {threshold, threshold + 1}, first_, ambiguous);
            table->between(static_cast<std::int32_t>(threshold) - 1, threshold, {threshold + 1},
                           first_, ambiguous);
        }
}

void CellUnit::level_difference(const TimePath& path, LevelMap::Cut from, LevelMap::Cut to,
                                RunBuffer& added, RunBuffer& removed) const {
    assert(from.exact && to.exact);
    if (from.threshold > to.threshold)
        return level_difference(path, to, from, removed, added);
    if (from.threshold == to.threshold)
        return;
    // An entry's column is its low rank. Its row is its high rank if the map is lossy, else 1 less.
    const std::uint32_t lossy = !tables_.head().lossless;
    const std::uint32_t low = from.threshold - 1u, high = to.threshold - 1u;
    for (const std::uint32_t node : path)
        if (const auto table = tables_.at_any_level(node)) {
            table->up_to(low, {low + lossy, high + lossy}, first_, removed);
            table->between(static_cast<std::int32_t>(low), high, {high + lossy}, first_, added);
        }
}

bool DeltaUnit::check_head(std::uint32_t steps, std::uint32_t cells) const {
    return tables_.check_head({kMagic, 2 * steps, steps, cells});
}

void DeltaUnit::change(std::uint32_t into_step, LevelMap::Cut cut, RunBuffer& added,
                       RunBuffer& removed) const {
    assert(cut.exact);
    const std::uint32_t threshold = cut.threshold - 1u;
    if (const auto table = tables_.at_level(2 * into_step, threshold))
        table->up_to(threshold, {threshold}, first_, added);
    if (const auto table = tables_.at_level(2 * into_step + 1, threshold))
        table->up_to(threshold, {threshold}, first_, removed);
}

} // namespace isochron::index
