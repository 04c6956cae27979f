// Interval trees, which find the intervals that contain a value, and the sorted lists inside them.
#pragma once

#include "index/volume/grid.h"
#include "index/volume/order_key.h"

#include <cstdint>
#include <span>
#include <vector>

namespace isochron::index {

/// A cell and its extremes; it may be active at thresholds with `low < threshold <= high`.
struct Interval {
    OrderKey low, high;
    CellId id;
};

/// Two orders of the same cells, as parallel arrays: a search reads keys and copies ids.
template <template <class> class Array>
struct Lists {
    Array<CellId> low_ids;    ///< ascending low extreme (AL)
    Array<OrderKey> low_keys; ///< their low extremes
    Array<CellId> high_ids;   ///< descending high extreme (DR)
    Array<OrderKey> high_keys;

    Lists part(std::size_t first, std::size_t count) const {
        return {low_ids.subspan(first, count), low_keys.subspan(first, count),
                high_ids.subspan(first, count), high_keys.subspan(first, count)};
    }
};
template <class T>
using Readable = std::span<const T>;
template <class T>
using Writable = std::span<T>;

/// Sorts the intervals into both lists, which are equally long; equal keys by ascending id.
void write_lists(std::span<Interval> intervals, const Lists<Writable>& lists);

/// Appends the cells with a low extreme below the threshold: a prefix of the list.
void collect_low(const Lists<Readable>& lists, OrderKey threshold, std::vector<CellId>& out);
/// Appends the cells with a high extreme not below the threshold: a prefix of the list.
void collect_high(const Lists<Readable>& lists, OrderKey threshold, std::vector<CellId>& out);

/// Node of an interval tree (Edelsbrunner 1980; section 3.3). Its lists hold the intervals with
/// `low < split <= high`, the left subtree those with `high < split`, the right one those with
/// `low >= split`.
struct IntervalNode {
    static constexpr std::uint32_t kNone = 0xffffffff;
    OrderKey split;
    std::uint32_t begin, end;  ///< range of its entries in the lists
    std::uint32_t left, right; ///< numbers of nodes, above the node's own; or kNone
};
static_assert(sizeof(IntervalNode) == 20);

/// Builds the tree of the intervals, each with `low < high`; reorders them.
/// @param nodes gets the tree's nodes appended, root first
/// @param lists for its lists, exactly as long as `intervals`
/// @param begin added to the nodes' `begin` and `end`
/// @return number of the root, kNone when there are no intervals
std::uint32_t build_interval_tree(std::span<Interval> intervals, std::vector<IntervalNode>& nodes,
                                  const Lists<Writable>& lists, std::uint32_t begin);

/// Walks down towards the threshold. For every node on the way it calls `low(node)`, which must
/// take the intervals that begin below the threshold, or `high(node)`, which must take those that
/// do not end below it.
template <class Low, class High>
void visit_interval_tree(std::span<const IntervalNode> nodes, std::uint32_t root,
                         OrderKey threshold, Low&& low, High&& high) {
    for (std::uint32_t number = root; number != IntervalNode::kNone;) {
        const IntervalNode& node = nodes[number];
        if (threshold > node.split) {
            high(node);
            number = node.right;
        } else {
            // If the threshold is the split, no other intervals contain it: intervals to the left
            // end below it, and intervals to the right begin at or above it.
            low(node);
            number = threshold < node.split ? node.left : IntervalNode::kNone;
        }
    }
}

/// Appends the cells whose interval contains the threshold.
void search_interval_tree(std::span<const IntervalNode> nodes, std::uint32_t root,
                          const Lists<Readable>& lists, OrderKey threshold,
                          std::vector<CellId>& out);

} // namespace isochron::index
