// Searches a THI tree.
#include "index/paper/thi_tree.h"

#include "index/paper/span_space.h"

#include <cassert>
#include <limits>

namespace isochron::index {

ThiTree::ThiTree(std::span<const std::byte> bytes)
    : header_(check_thi_bytes(bytes)), parts_(thi_parts(header_, bytes)) {}

std::vector<TimeNodeCells> ThiTree::nodes() const {
    std::vector<TimeNodeCells> found;
    const auto add = [&](const auto& self, const TimeNode& node) -> void {
        found.push_back(
            {node.first, node.last, node.depth,
             parts_.node_starts[node.number + 1].entry - parts_.node_starts[node.number].entry});
        if (node.is_leaf())
            return;
        self(self, node.left());
        self(self, node.right());
    };
    add(add, TimeNode::root(steps()));
    return found;
}

void ThiTree::search_node(std::uint32_t number, OrderKey threshold,
                          std::vector<CellId>& out) const {
    const std::size_t elements = header_.elements;
    const ThiNodeStart start = parts_.node_starts[number], end = parts_.node_starts[number + 1];
    search_span_space(
        {parts_.lines, parts_.row_starts.subspan(number * (elements + 1), elements + 1),
         parts_.roots.subspan(number * elements, elements),
         parts_.lists.part(start.entry, end.entry - start.entry)},
        parts_.interval_nodes.subspan(start.interval_node, end.interval_node - start.interval_node),
        threshold, out);
}

void ThiTree::search(std::uint32_t step, std::uint64_t threshold, std::vector<CellId>& out) const {
    assert(step < steps());
    if (threshold > std::numeric_limits<OrderKey>::max())
        return;
    for (TimeNode node = TimeNode::root(steps());; node = node.towards(step)) {
        search_node(node.number, static_cast<OrderKey>(threshold), out);
        if (node.is_leaf())
            return;
    }
}

std::size_t ThiTree::search_incremental(Cursor& cursor, std::uint32_t step,
                                        std::uint64_t threshold) const {
    assert(step < steps());
    const bool continues = cursor.valid && cursor.threshold == threshold;
    cursor.valid = false; // until it is complete again
    TimeNode node = TimeNode::root(steps());
    // Goes down to the first node that the last search did not enter; its parent is the lowest
    // common node.
    std::size_t common = 0;
    if (continues)
        while (common < cursor.reached.size() && node.contains(cursor.step)) {
            ++common;
            if (node.is_leaf())
                break;
            node = node.towards(step);
        }
    cursor.reached.resize(common);
    const std::size_t reused = common ? cursor.reached.back() : 0;
    cursor.cells.resize(reused);

    const bool reachable = threshold <= std::numeric_limits<OrderKey>::max();
    for (bool arrived = continues && step == cursor.step; !arrived;) {
        if (reachable)
            search_node(node.number, static_cast<OrderKey>(threshold), cursor.cells);
        cursor.reached.push_back(cursor.cells.size());
        arrived = node.is_leaf();
        if (!arrived)
            node = node.towards(step);
    }
    cursor.step = step;
    cursor.threshold = threshold;
    cursor.valid = true;
    return reused;
}

} // namespace isochron::index
