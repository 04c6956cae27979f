// Interval trees, which find the intervals that contain a value, and the sorted lists inside them.
#include "index/paper/interval_tree.h"

#include <algorithm>

namespace isochron::index {
namespace {

constexpr std::uint32_t kNone = IntervalNode::kNone;

/// Builds one tree. The depth of the recursion is about log2 of the number of distinct extremes.
struct Builder {
    std::vector<IntervalNode>& nodes;
    const Lists<Writable>& lists;
    std::uint32_t begin;
    std::uint32_t written = 0;

    /// @param extremes of the intervals, and maybe others; ascending and distinct
    std::uint32_t build(std::span<Interval> intervals, std::span<const OrderKey> extremes) {
        if (intervals.empty())
            return kNone;
        // With two or more extremes, both halves are smaller than the whole. With one extreme there
        // is no interval, since low < high.
        const std::size_t half = extremes.size() / 2;
        const OrderKey split = extremes[half];
        const auto here =
            std::partition(intervals.begin(), intervals.end(),
                           [&](const Interval& interval) { return interval.high < split; });
        const auto above = std::partition(
            here, intervals.end(), [&](const Interval& interval) { return interval.low < split; });
        const std::span<Interval> left(intervals.begin(), here), at(here, above),
            right(above, intervals.end());
        // A node without intervals of its own is needed only if it has two subtrees.
        if (at.empty() && right.empty())
            return build(left, extremes.first(half));
        if (at.empty() && left.empty())
            return build(right, extremes.subspan(half));
        const auto number = static_cast<std::uint32_t>(nodes.size());
        const auto count = static_cast<std::uint32_t>(at.size());
        write_lists(at, lists.part(written, count));
        nodes.push_back({split, begin + written, begin + written + count, kNone, kNone});
        written += count;
        const std::uint32_t left_number = build(left, extremes.first(half));
        nodes[number].left = left_number;
        const std::uint32_t right_number = build(right, extremes.subspan(half));
        nodes[number].right = right_number;
        return number;
    }
};

} // namespace

void write_lists(std::span<Interval> intervals, const Lists<Writable>& lists) {
    std::sort(intervals.begin(), intervals.end(), [](const Interval& a, const Interval& b) {
        return a.low != b.low ? a.low < b.low : a.id < b.id;
    });
    for (std::size_t i = 0; i < intervals.size(); ++i) {
        lists.low_ids[i] = intervals[i].id;
        lists.low_keys[i] = intervals[i].low;
    }
    std::sort(intervals.begin(), intervals.end(), [](const Interval& a, const Interval& b) {
        return a.high != b.high ? a.high > b.high : a.id < b.id;
    });
    for (std::size_t i = 0; i < intervals.size(); ++i) {
        lists.high_ids[i] = intervals[i].id;
        lists.high_keys[i] = intervals[i].high;
    }
}

void collect_low(const Lists<Readable>& lists, OrderKey threshold, std::vector<CellId>& out) {
    const auto end = std::partition_point(lists.low_keys.begin(), lists.low_keys.end(),
                                          [&](OrderKey low) { return low < threshold; });
    out.insert(out.end(), lists.low_ids.begin(),
               lists.low_ids.begin() + (end - lists.low_keys.begin()));
}

void collect_high(const Lists<Readable>& lists, OrderKey threshold, std::vector<CellId>& out) {
    const auto end = std::partition_point(lists.high_keys.begin(), lists.high_keys.end(),
                                          [&](OrderKey high) { return high >= threshold; });
    out.insert(out.end(), lists.high_ids.begin(),
               lists.high_ids.begin() + (end - lists.high_keys.begin()));
}

std::uint32_t build_interval_tree(std::span<Interval> intervals, std::vector<IntervalNode>& nodes,
                                  const Lists<Writable>& lists, std::uint32_t begin) {
    std::vector<OrderKey> extremes;
    extremes.reserve(2 * intervals.size());
    for (const Interval& interval : intervals)
        extremes.insert(extremes.end(), {interval.low, interval.high});
    std::sort(extremes.begin(), extremes.end());
    extremes.erase(std::unique(extremes.begin(), extremes.end()), extremes.end());
    return Builder{nodes, lists, begin}.build(intervals, extremes);
}

void search_interval_tree(std::span<const IntervalNode> nodes, std::uint32_t root,
                          const Lists<Readable>& lists, OrderKey threshold,
                          std::vector<CellId>& out) {
    const auto lists_of = [&](const IntervalNode& node) {
        return lists.part(node.begin, node.end - node.begin);
    };
    visit_interval_tree(
        nodes, root, threshold,
        [&](const IntervalNode& node) { collect_low(lists_of(node), threshold, out); },
        [&](const IntervalNode& node) { collect_high(lists_of(node), threshold, out); });
}

} // namespace isochron::index
