// One span space: rows of the lattice as sorted lists, interval trees on its diagonal.
#pragma once

#include "index/interval_tree.h"
#include "index/order_key.h"

#include <cstdint>
#include <span>
#include <vector>

namespace isochron::index {

/// Where the parts of a span space lie (section 3.2). Its lists hold, for each row, the cells off
/// the diagonal, then the lists of the interval trees of the diagonal elements.
template <template <class> class Array>
struct SpanSpace {
    std::span<const OrderKey> lines; ///< of its lattice
    Array<std::uint32_t> row_starts; ///< into the lists: one for each line, then the last row's end
    Array<std::uint32_t> roots;      ///< of an interval tree for each line
    Lists<Array> lists;
};

/// Fills the parts of a span space, whose lists are as long as there are entries.
/// @param nodes where the nodes of its interval trees are appended
void build_span_space(std::vector<Interval> entries, const SpanSpace<Writable>& space,
                      std::vector<IntervalNode>& nodes);

/// Appends the cells whose interval holds the threshold.
void search_span_space(const SpanSpace<Readable>& space, std::span<const IntervalNode> nodes,
                       OrderKey threshold, std::vector<CellId>& out);

} // namespace isochron::index
