// Finds the time nodes at which a cell is stored, by how much it varies over time.
#include "index/paper/temporal_variation.h"

#include "index/paper/lattice.h"

#include <algorithm>

namespace isochron::index {

TemporalVariation::TemporalVariation(std::span<const OrderKey> lines, std::uint32_t steps,
                                     std::uint32_t max_variation)
    : lines_(lines), max_variation_(max_variation), shape_(TimeNode::count(steps)), leaves_(steps),
      nodes_(shape_.size()), elements_(shape_.size() * max_variation) {
    shape_[0] = TimeNode::root(steps);
    for (std::size_t i = 0; i < shape_.size(); ++i) {
        const TimeNode node = shape_[i]; // parents come before their children
        if (node.is_leaf()) {
            leaves_[node.first] = node.number;
        } else {
            shape_[node.left().number] = node.left();
            shape_[node.right().number] = node.right();
        }
    }
}

void TemporalVariation::locate(const OrderKey* low, const OrderKey* high, std::size_t stride) {
    std::uint32_t column = 0, row = 0; // guesses from the step before: a coherent cell stays there
    for (const std::uint32_t leaf : leaves_) {
        Variation& node = nodes_[leaf];
        node = {0, *low < *high, *low, *high};
        if (*low <= *high) {
            column = element_near(lines_, *low, column);
            row = element_near(lines_, *high, row);
            node.count = 1;
            *elements(leaf) = column << 16 | row;
        }
        low += stride;
        high += stride;
    }
}

void TemporalVariation::merge() {
    for (std::uint32_t number = static_cast<std::uint32_t>(nodes_.size()); number-- > 0;) {
        if (shape_[number].is_leaf())
            continue;
        const std::uint32_t left_number = shape_[number].left().number;
        const std::uint32_t right_number = shape_[number].right().number;
        const Variation &left = nodes_[left_number], &right = nodes_[right_number];
        if (left.count > max_variation_ || right.count > max_variation_) {
            nodes_[number].count = max_variation_ + 1;
            continue;
        }
        // A child without points does not count for the extremes.
        nodes_[number] = {unite(number, left_number, right_number), left.varies || right.varies,
                          !left.count    ? right.low
                          : !right.count ? left.low
                                         : std::min(left.low, right.low),
                          !left.count    ? right.high
                          : !right.count ? left.high
                                         : std::max(left.high, right.high)};
    }
}

/// Unites the elements of a node's children. @return their number; max_variation_ + 1 if there are
/// more than max_variation_
std::uint32_t TemporalVariation::unite(std::uint32_t number, std::uint32_t left,
                                       std::uint32_t right) {
    const std::uint32_t *a = elements(left), *a_end = a + nodes_[left].count;
    const std::uint32_t *b = elements(right), *b_end = b + nodes_[right].count;
    std::uint32_t* out = elements(number);
    std::uint32_t count = 0;
    while (a != a_end || b != b_end) {
        if (count == max_variation_)
            return count + 1;
        const bool take_a = b == b_end || (a != a_end && *a <= *b);
        const bool take_b = a == a_end || (b != b_end && *b <= *a);
        out[count++] = take_a ? *a : *b;
        a += take_a;
        b += take_b;
    }
    return count;
}

} // namespace isochron::index
