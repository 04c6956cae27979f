// The binary time tree, whose time spans follow from the number of steps alone.
#pragma once

#include <bit>
#include <cstdint>

namespace isochron::index {

/// The number of cells in a node of the tree, for reports.
struct TimeNodeCells {
    std::uint32_t first_step, last_step; ///< inclusive span [t0, t1]
    std::uint32_t depth;
    std::uint64_t cells;
};

/// A node of the tree (section 3.1): an inclusive span of steps. Nodes are numbered depth first,
/// the root 0 and a left child right after its parent, so that the tree need not be stored. The
/// left child of a span has the largest power of two of steps that is less than the span's: 10
/// steps have [0,9], [0,7], [0,3], [0,1], ..., [8,9], as in Figure 1.
struct TimeNode {
    std::uint32_t first, last; ///< steps
    std::uint32_t number = 0;  ///< depth first
    std::uint32_t depth = 0;

    static TimeNode root(std::uint32_t steps) { return {0, steps - 1}; }
    /// Number of nodes of the subtree of a node with that many steps, the node itself included.
    static std::uint32_t count(std::uint32_t steps) { return 2 * steps - 1; }

    std::uint32_t steps() const { return last - first + 1; }
    bool is_leaf() const { return first == last; }
    bool contains(std::uint32_t step) const { return first <= step && step <= last; }

    // Children of nodes that are not leaves:
    TimeNode left() const { return {first, middle() - 1, number + 1, depth + 1}; }
    TimeNode right() const {
        return {middle(), last, number + 1 + count(middle() - first), depth + 1};
    }
    /// The child that contains one of the node's steps.
    TimeNode towards(std::uint32_t step) const { return step < middle() ? left() : right(); }

  private:
    std::uint32_t middle() const { return first + std::bit_floor(steps() - 1); }
};

} // namespace isochron::index
