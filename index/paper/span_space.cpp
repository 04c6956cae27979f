// Span space: the rows of the lattice as sorted lists, and interval trees on its diagonal.
#include "index/paper/span_space.h"

#include <cstddef>

namespace isochron::index {

void build_span_space(std::vector<Interval> entries, const SpanSpace<Writable>& space,
                      std::vector<IntervalNode>& nodes) {
    const std::size_t elements = space.lines.size();
    // Counting sort into one group for each row and one for each diagonal element.
    const auto group_of = [&](const Interval& entry) {
        const std::uint32_t column = element_of(space.lines, entry.low);
        const std::uint32_t row = element_near(space.lines, entry.high, column);
        return column == row ? elements + row : row;
    };
    std::vector<std::size_t> starts(2 * elements + 2);
    for (const Interval& entry : entries)
        ++starts[group_of(entry) + 2];
    for (std::size_t group = 2; group < starts.size(); ++group)
        starts[group] += starts[group - 1];
    std::vector<Interval> grouped(entries.size());
    for (const Interval& entry : entries)
        grouped[starts[group_of(entry) + 1]++] = entry;
    entries = {};

    for (std::size_t group = 0; group < 2 * elements; ++group) {
        const std::size_t count = starts[group + 1] - starts[group];
        const auto of_group = std::span(grouped).subspan(starts[group], count);
        const auto begin = static_cast<std::uint32_t>(starts[group]);
        if (group < elements)
            write_lists(of_group, space.lists.part(begin, count));
        else
            space.roots[group - elements] =
                build_interval_tree(of_group, nodes, space.lists.part(begin, count), begin);
    }
    for (std::size_t row = 0; row <= elements; ++row)
        space.row_starts[row] = static_cast<std::uint32_t>(starts[row]);
}

void search_span_space(const SpanSpace<Readable>& space, std::span<const IntervalNode> nodes,
                       OrderKey threshold, std::vector<CellId>& out) {
    const auto cells_of = [&](std::size_t row) {
        return space.lists.part(space.row_starts[row],
                                space.row_starts[row + 1] - space.row_starts[row]);
    };
    visit_span_space(
        space.lines, threshold,
        [&](std::size_t row) { collect_low(cells_of(row), threshold, out); },
        [&](std::size_t row) { collect_high(cells_of(row), threshold, out); },
        [&](std::size_t row) {
            search_interval_tree(nodes, space.roots[row], space.lists, threshold, out);
        });
}

} // namespace isochron::index
