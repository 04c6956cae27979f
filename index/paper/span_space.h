// Span space: the rows of the lattice as sorted lists, and interval trees on its diagonal.
#pragma once

#include "index/paper/interval_tree.h"
#include "index/paper/lattice.h"
#include "index/volume/order_key.h"

#include <cstdint>
#include <span>
#include <vector>

namespace isochron::index {

/// The parts of a span space (section 3.2). Its lists hold the cells off the diagonal, row by row,
/// then the lists of the interval trees of the diagonal elements.
template <template <class> class Array>
struct SpanSpace {
    std::span<const OrderKey> lines; ///< lines of its lattice
    Array<std::uint32_t> row_starts; ///< into the lists: one for each line, then the last row's end
    Array<std::uint32_t> roots;      ///< root of an interval tree for each line
    Lists<Array> lists;
};

/// Fills the parts of a span space, whose lists are as long as `entries`.
/// @param nodes to which the nodes of its interval trees are appended
void build_span_space(std::vector<Interval> entries, const SpanSpace<Writable>& space,
                      std::vector<IntervalNode>& nodes);

/// Calls the three cases of a search (section 3.2): `low(row)` must take the cells of a row whose
/// minimum is below the threshold, `high(row)` those whose maximum is not below it, `diagonal(row)`
/// must search the interval tree.
template <class Low, class High, class Diagonal>
void visit_span_space(std::span<const OrderKey> lines, OrderKey threshold, Low&& low, High&& high,
                      Diagonal&& diagonal) {
    const std::size_t row = element_of(lines, threshold);
    if (row == lines.size())
        return; // above every extreme
    // 1. Rows above: every maximum is above the threshold.
    for (std::size_t above = row + 1; above < lines.size(); ++above)
        low(above);
    // 2. The row of the threshold: every minimum is below it, since its column is.
    high(row);
    // 3. The diagonal element of that row.
    diagonal(row);
}

/// Appends the cells whose interval contains the threshold.
void search_span_space(const SpanSpace<Readable>& space, std::span<const IntervalNode> nodes,
                       OrderKey threshold, std::vector<CellId>& out);

} // namespace isochron::index
