// Sorts pieces.
#include "app/frame/piece_list.h"

#include "app/csv_field.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace isochron::app {
namespace {

double number_of(const index::MeasuredPiece& piece, PieceColumn column) {
    switch (column) {
    case PieceColumn::cells: return static_cast<double>(piece.cells);
    case PieceColumn::area: return piece.area;
    case PieceColumn::volume: return piece.volume;
    case PieceColumn::closed: return piece.closed ? 1 : 0;
    }
    return 0;
}

} // namespace

PieceList piece_list(std::vector<index::MeasuredPiece> pieces, const PieceOrder& order) {
    std::ranges::stable_sort(pieces, [&](const auto& one, const auto& other) {
        const double a = number_of(one, order.by), b = number_of(other, order.by);
        if (std::isnan(a) || std::isnan(b))
            return !std::isnan(a) && std::isnan(b);
        return order.rising ? a < b : b < a;
    });
    PieceList list{.query = {}, .order = order, .rows = {}, .pieces = pieces.size()};
    for (std::size_t i = PieceList::kMostRows; i < pieces.size(); ++i) {
        list.other_cells += pieces[i].cells;
        list.other_area += pieces[i].area;
    }
    pieces.resize(std::min(pieces.size(), PieceList::kMostRows));
    list.rows = std::move(pieces);
    return list;
}

std::string csv_of(const PieceList& list, const index::SeriesInfo& info) {
    const auto unit = [&](int power) {
        return info.length_unit.empty() ? ""
               : power == 1             ? fmt::format(" [{}]", info.length_unit)
                                        : fmt::format(" [{}^{}]", info.length_unit, power);
    };
    std::string text =
        fmt::format("piece,cells,{},{},closed,{},{},{}\n", csv_field("area" + unit(2)),
                    csv_field("volume" + unit(3)), csv_field("x" + unit(1)),
                    csv_field("y" + unit(1)), csv_field("z" + unit(1)));
    for (std::size_t i = 0; i < list.rows.size(); ++i) {
        const index::MeasuredPiece& piece = list.rows[i];
        text += fmt::format("{},{},{},{},{},{},{},{}\n", i, piece.cells, piece.area,
                            std::isnan(piece.volume) ? "" : fmt::format("{}", piece.volume),
                            piece.closed ? 1 : 0, piece.centroid[0], piece.centroid[1],
                            piece.centroid[2]);
    }
    return text;
}

} // namespace isochron::app
