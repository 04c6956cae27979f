// The connected pieces of a surface, as a panel lists them.
#pragma once

#include "index/measure/measures.h"
#include "index/volume/query.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace isochron::app {

/// What pieces are sorted by.
enum class PieceColumn : std::uint8_t { cells, area, volume, closed };
inline constexpr std::array<std::string_view, 4> kPieceColumns{"cells", "area", "volume", "closed"};
struct PieceOrder {
    PieceColumn by = PieceColumn::area;
    bool rising = false; ///< the smallest first; pieces that are not closed, without a volume, last
    bool operator==(const PieceOrder&) const = default;
};

/// Immutable once it is shared.
struct PieceList {
    static constexpr std::size_t kMostRows = 300;
    std::uint32_t surface = 0; ///< number of the isosurface
    index::Query query;
    PieceOrder order;
    std::vector<index::MeasuredPiece> rows; ///< the first kMostRows in this order
    std::size_t pieces = 0;                 ///< all that are shown
    std::uint64_t other_cells = 0;          ///< cells of the pieces without a row
    double other_area = 0;
};
using PieceListPtr = std::shared_ptr<const PieceList>;

/// Sorts pieces, and keeps the first of them.
PieceList piece_list(std::vector<index::MeasuredPiece> pieces, const PieceOrder& order);
/// The rows as a table, with units in the names of its columns. @param info of the surfaces' array
std::string csv_of(const PieceList& list, const index::SeriesInfo& info);

} // namespace isochron::app
