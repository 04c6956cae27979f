// Builds the THI tree: first the entries of every time node, then the span space of each.
#include "index/paper/span_space.h"
#include "index/paper/thi_layout.h"
#include "index/paper/thi_tree.h"
#include "index/system/parallel.h"

#include <algorithm>
#include <cstring>

namespace isochron::index {

std::vector<std::byte> build_thi_tree(const StepValues& values, const ThiOptions& options,
                                      const Progress& progress, unsigned threads) {
    return build_thi_tree(ThiEntries(values, options, progress, threads), progress, threads);
}

std::vector<std::byte> build_thi_tree(ThiEntries entries, const Progress& progress,
                                      unsigned threads) {
    const std::vector<OrderKey>& lines = entries.lines();
    ThiHeader header;
    header.steps = entries.steps();
    header.lattice = entries.options().lattice;
    header.max_variation = entries.options().max_variation;
    header.elements = static_cast<std::uint32_t>(lines.size());
    const std::size_t nodes = entries.nodes();
    std::vector<ThiNodeStart> node_starts(nodes + 1);
    for (std::size_t node = 0; node < nodes; ++node) {
        node_starts[node].entry = header.entries;
        header.entries += entries.count(node);
    }
    node_starts[nodes].entry = header.entries;

    // The interval nodes are the last part, since their number is known last.
    std::vector<std::byte> bytes(thi_offsets(header, SIZE_MAX).back());
    const ThiParts<Writable> parts = thi_parts(header, std::span(bytes));
    std::vector<std::vector<IntervalNode>> interval_nodes(nodes);
    parallel_for(
        nodes, thread_count(threads),
        [&](std::size_t node, unsigned) {
            const std::uint64_t first = node_starts[node].entry;
            build_span_space(entries.take(node),
                             {lines,
                              parts.row_starts.subspan(node * (lines.size() + 1), lines.size() + 1),
                              parts.roots.subspan(node * lines.size(), lines.size()),
                              parts.lists.part(first, node_starts[node + 1].entry - first)},
                             interval_nodes[node]);
        },
        phase_of(progress, "sorting lists"));

    for (std::size_t node = 0; node < nodes; ++node) {
        node_starts[node].interval_node = header.interval_nodes;
        header.interval_nodes += interval_nodes[node].size();
    }
    node_starts[nodes].interval_node = header.interval_nodes;
    std::copy(lines.begin(), lines.end(), parts.lines.begin());
    std::copy(node_starts.begin(), node_starts.end(), parts.node_starts.begin());
    bytes.resize(thi_offsets(header, SIZE_MAX).back());
    std::memcpy(bytes.data(), &header, sizeof header);
    auto next = thi_parts(header, std::span(bytes)).interval_nodes.begin();
    for (const auto& of_node : interval_nodes)
        next = std::copy(of_node.begin(), of_node.end(), next);
    return bytes;
}

} // namespace isochron::index
