// Sorts the entries of a cell table and writes its directory.
#pragma once

#include "index/cell_table.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace isochron::index {

struct CellTableLayout;

/// Collects the entries of one table after another. Keeps its work space: one for each thread.
class CellTableBuilder {
  public:
    CellTableBuilder();

    /// Ids come in ascending order, each with at most kEntriesPerCell entries of different rows.
    void add(std::uint16_t id, std::uint8_t column, std::uint8_t row) {
        keys_[entries_] = static_cast<std::uint16_t>(row << 8 | column);
        ids_[entries_++] = id;
    }
    std::uint32_t entries() const { return entries_; }

    /// Appends the table, which has entries, and forgets them. The bytes' size stays a multiple of
    /// CellTable::kAlignment.
    void append_to(std::vector<std::byte>& bytes);

  private:
    static constexpr std::size_t kEntriesPerCell = 2; ///< of a difference of two intervals

    struct Band;
    Band count();
    void write(const Band& band, std::byte* table);
    void write_elements(const Band& band, const CellTableLayout& layout, std::byte* table);
    template <class Length>
    void write_lines(const Band& band, const CellTableLayout& layout, std::byte* table);
    template <class F>
    void place_row(const Band& band, std::uint32_t row, std::uint32_t& at, F&& placed);
    std::uint32_t& element(std::uint32_t row, std::uint32_t column) {
        return counts_[row << 8 | column];
    }

    std::uint32_t entries_ = 0;
    std::vector<std::uint16_t> keys_, ids_; ///< key: row, column
    std::vector<std::uint32_t> counts_;     ///< by key; 0 between tables
};

} // namespace isochron::index
