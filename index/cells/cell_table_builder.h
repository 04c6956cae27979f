// Sorts the entries of a cell table and writes its directory.
#pragma once

#include "index/cells/cell_entries.h"
#include "index/cells/cell_table.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace isochron::index {

struct CellTableLayout;

/// Keeps its work space: one for each thread.
class CellTableBuilder {
  public:
    CellTableBuilder();

    /// The entries of the next table, to be filled.
    CellEntries& entries() { return entries_; }

    /// Appends the table and forgets its entries; there must be at least one entry. The size of
    /// `bytes` stays a multiple of CellTableHead::kAlignment.
    /// @return the table's head
    CellTableHead append_to(std::vector<std::byte>& bytes);

  private:
    struct Band;
    Band count();
    void choose_lines(Band& band) const;
    void write(const Band& band, std::byte* table);
    void write_elements(const Band& band, const CellTableLayout& layout, std::byte* table);
    void write_lines(const Band& band, const CellTableLayout& layout, std::byte* table);
    template <class F>
    void place_row(const Band& band, std::uint32_t row, F&& placed);

    CellEntries entries_;
    /// By key: the number of an element's entries in either list, later the place in its row for
    /// the next one. All 0 between tables. A row has at most one entry of each cell.
    std::array<std::vector<std::uint16_t>, 2> counts_;
};

} // namespace isochron::index
