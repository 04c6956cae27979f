// Searches and checks the table of one stretch's cells.
#include "index/cells/cell_table.h"

#include "index/cells/cell_table_directory.h"

#include <algorithm>

namespace isochron::index {

template <class F>
decltype(auto) CellTable::visit(F&& f) const {
    if (head().form == CellTableHead::kSparse)
        return f(ElementList(bytes_, head()));
    return f(LengthLines(bytes_, head()));
}

bool CellTable::check(std::span<const std::byte> bytes) {
    if (bytes.size() < sizeof(CellTableHead))
        return false;
    const CellTable table(bytes.data());
    const CellTableHead& head = table.head();
    if (head.form > 8 || head.first_row > head.last_row || head.first_column > head.last_row)
        return false;
    if (head.form == CellTableHead::kSparse && head.size > CellTableHead::kMaxElements)
        return false;
    const CellTableLayout layout(head);
    if (head != with_offsets(head) || layout.end > bytes.size())
        return false;
    return table.visit([](const auto& directory) { return directory.check(); });
}

bool CellTable::has_ids_below(std::uint32_t cells) const {
    const std::uint16_t* ids = part_at<std::uint16_t>(bytes_, head().ids);
    std::uint16_t highest = 0; // no branch for each id
    for (std::uint32_t i = 0; i < head().entries; ++i)
        highest = std::max(highest, ids[i]);
    return highest < cells;
}

std::size_t CellTable::size() const {
    return CellTableLayout(head()).end;
}

void CellTable::up_to(std::uint32_t column, SpanRows rows, CellId first, RunBuffer& out) const {
    if (rows.begin >= rows.end)
        return;
    visit([&](const auto& directory) {
        TableRuns runs(part_at<std::uint16_t>(bytes_, head().ids), first, out);
        directory.up_to(column, rows, runs);
    });
}

void CellTable::between(std::int32_t below, std::uint32_t column, SpanRows rows, CellId first,
                        RunBuffer& out) const {
    if (rows.begin >= rows.end)
        return;
    visit([&](const auto& directory) {
        TableRuns runs(part_at<std::uint16_t>(bytes_, head().ids), first, out);
        directory.between(below, column, rows, runs);
    });
}

} // namespace isochron::index
