// Finds the time nodes at which a cell is stored, by how much it varies over time.
#pragma once

#include "index/paper/time_tree.h"
#include "index/volume/order_key.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace isochron::index {

/// Counts the lattice elements that a cell's points occupy over every time node
/// (sections 3.1, 3.2). Keeps its work space: one for each thread.
class TemporalVariation {
  public:
    /// @param lines of the lattice; must outlive this
    TemporalVariation(std::span<const OrderKey> lines, std::uint32_t steps,
                      std::uint32_t max_variation);

    /// Calls `store(node number, low, high)` with the cell's temporal extremes for the highest time
    /// nodes over which its points occupy at most `max_variation` elements. It leaves out nodes at
    /// which the cell cannot be active: at every step its extremes are equal or there is no point.
    /// @param low, high the extremes, `stride` numbers apart from step to step; low > high where a
    ///        vertex is NaN, which gives no point
    template <class Store>
    void visit_nodes(const OrderKey* low, const OrderKey* high, std::size_t stride, Store&& store) {
        locate(low, high, stride);
        merge();
        for (std::uint32_t number = 0; number < nodes_.size();) {
            const Variation& node = nodes_[number];
            if (node.count > max_variation_) {
                ++number;
                continue;
            }
            if (node.varies)
                store(number, node.low, node.high);
            number += TimeNode::count(shape_[number].steps());
        }
    }

  private:
    struct Variation {
        std::uint32_t count; ///< number of elements; if above max_variation_, not exact
        bool varies;         ///< its extremes differ at some step
        OrderKey low, high;  ///< temporal extremes; low > high if it has no point
    };

    void locate(const OrderKey* low, const OrderKey* high, std::size_t stride);
    void merge();
    std::uint32_t unite(std::uint32_t number, std::uint32_t left, std::uint32_t right);
    std::uint32_t* elements(std::uint32_t node) {
        return elements_.data() + std::size_t{node} * max_variation_;
    }

    std::span<const OrderKey> lines_;
    std::uint32_t max_variation_;
    std::vector<TimeNode> shape_;       ///< by number
    std::vector<std::uint32_t> leaves_; ///< number of each step's node
    std::vector<Variation> nodes_;
    std::vector<std::uint32_t> elements_; ///< ascending, up to max_variation_ for each node
};

} // namespace isochron::index
