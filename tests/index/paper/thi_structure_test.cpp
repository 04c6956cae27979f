// The parts of the THI tree agree with the paper: its examples, computed by hand.
#include "index/paper/thi_tree.h"

#include "index/paper/interval_tree.h"
#include "index/paper/lattice.h"
#include "index/paper/temporal_variation.h"
#include "index/paper/time_tree.h"
#include "tests/support/test_field.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <set>

namespace isochron::index {
namespace {

using Span = std::pair<std::uint32_t, std::uint32_t>;

std::vector<Span> spans(std::uint32_t steps) {
    std::vector<Span> found;
    const auto add = [&](const auto& self, const TimeNode& node) -> void {
        EXPECT_EQ(node.number, found.size()) << "numbered depth first";
        found.emplace_back(node.first, node.last);
        if (!node.is_leaf()) {
            EXPECT_EQ(node.left().depth, node.depth + 1);
            self(self, node.left());
            self(self, node.right());
        }
    };
    add(add, TimeNode::root(steps));
    return found;
}

TEST(TimeTree, OfTenStepsIsTheOneOfFigure1) {
    EXPECT_EQ(spans(10), (std::vector<Span>{{0, 9},
                                            {0, 7},
                                            {0, 3},
                                            {0, 1},
                                            {0, 0},
                                            {1, 1},
                                            {2, 3},
                                            {2, 2},
                                            {3, 3},
                                            {4, 7},
                                            {4, 5},
                                            {4, 4},
                                            {5, 5},
                                            {6, 7},
                                            {6, 6},
                                            {7, 7},
                                            {8, 9},
                                            {8, 8},
                                            {9, 9}}));
}

TEST(TimeTree, LeadsToEveryStepThroughNodesThatContainIt) {
    for (std::uint32_t steps = 1; steps <= 70; ++steps) {
        EXPECT_EQ(spans(steps).size(), TimeNode::count(steps));
        for (std::uint32_t step = 0; step < steps; ++step) {
            TimeNode node = TimeNode::root(steps);
            for (; !node.is_leaf(); node = node.towards(step))
                ASSERT_TRUE(node.contains(step));
            ASSERT_EQ(node.first, step);
        }
    }
}

/// A random number below `end`.
std::uint32_t below(std::mt19937& random, std::uint32_t end) {
    return static_cast<std::uint32_t>(random() % end);
}

/// Where the cells of a tree are, by span; spans without cells are left out.
std::map<Span, std::uint64_t> cells_by_span(const TestField& field, ThiOptions options) {
    const auto bytes = build_thi_tree(field.view(), options);
    std::map<Span, std::uint64_t> found;
    for (const TimeNodeCells& node : ThiTree(bytes).nodes())
        if (node.cells)
            found[{node.first_step, node.last_step}] = node.cells;
    return found;
}

TEST(ThiTree, StoresACellThatIsConstantOverSixOfTenStepsInTheNodesOfThePaper) {
    // Constant in [0, 5], then different at every step: [0, 3], [4, 5] and the leaves.
    const TestField field({2, 2, 2}, 10, ValueType::u8, [](double x, double, double, double t) {
        return t <= 5 ? 10 * x : 50 + 10 * t + x;
    });
    EXPECT_EQ(cells_by_span(field, {4096, 1}),
              (std::map<Span, std::uint64_t>{
                  {{0, 3}, 1}, {{4, 5}, 1}, {{6, 6}, 1}, {{7, 7}, 1}, {{8, 8}, 1}, {{9, 9}, 1}}));
    // Over [4, 7] it occupies three elements, and over [0, 7] the same three.
    EXPECT_EQ(cells_by_span(field, {4096, 2}),
              (std::map<Span, std::uint64_t>{{{0, 3}, 1}, {{4, 5}, 1}, {{6, 7}, 1}, {{8, 9}, 1}}));
    EXPECT_EQ(cells_by_span(field, {4096, 3}),
              (std::map<Span, std::uint64_t>{{{0, 7}, 1}, {{8, 9}, 1}}));
    EXPECT_EQ(cells_by_span(field, {4096, 5}), (std::map<Span, std::uint64_t>{{{0, 9}, 1}}));
}

TEST(ThiTree, CountsNoPointForStepsWithANanVertex) {
    TestField field({2, 2, 2}, 4, ValueType::f32,
                    [](double x, double, double, double) { return x; });
    for (const std::size_t step : {1, 2, 3})
        field.at<float>(step, 3) = std::numeric_limits<float>::quiet_NaN();
    EXPECT_EQ(cells_by_span(field, {64, 1}), (std::map<Span, std::uint64_t>{{{0, 3}, 1}}));
    field.at<float>(0, 3) = std::numeric_limits<float>::quiet_NaN();
    EXPECT_EQ(cells_by_span(field, {64, 1}), (std::map<Span, std::uint64_t>{}));
}

TEST(TemporalVariation, StoresACellAtTheHighestNodesWithFewEnoughElements) {
    const std::uint32_t seed = test_seed();
    std::mt19937 random(seed);
    for (int trial = 0; trial < 300; ++trial) {
        const std::uint32_t steps = 1 + below(random, 20), most = 1 + below(random, 4);
        const std::vector<OrderKey> lines{3, 5, 8, 12, 20};
        std::vector<OrderKey> low(steps), high(steps);
        for (std::uint32_t t = 0; t < steps; ++t) {
            low[t] = t && below(random, 2) ? low[t - 1] : below(random, 21);
            high[t] = t && below(random, 2) ? std::max(high[t - 1], low[t])
                                            : low[t] + below(random, 21 - low[t]);
            if (below(random, 8) == 0)
                low[t] = 1, high[t] = 0;
        }
        // The definition, without sharing any work between the nodes.
        using Stored = std::vector<std::array<std::uint32_t, 3>>;
        Stored expected;
        const auto add = [&](const auto& self, const TimeNode& node) -> void {
            std::set<std::pair<std::uint32_t, std::uint32_t>> elements;
            bool varies = false;
            OrderKey smallest = 99, largest = 0;
            for (std::uint32_t t = node.first; t <= node.last; ++t)
                if (low[t] <= high[t]) {
                    elements.emplace(element_of(lines, low[t]), element_of(lines, high[t]));
                    varies |= low[t] < high[t];
                    smallest = std::min(smallest, low[t]);
                    largest = std::max(largest, high[t]);
                }
            if (elements.size() > most) {
                self(self, node.left());
                self(self, node.right());
            } else if (varies) {
                expected.push_back({node.number, smallest, largest});
            }
        };
        add(add, TimeNode::root(steps));
        Stored found;
        TemporalVariation(lines, steps, most)
            .visit_nodes(low.data(), high.data(), 1,
                         [&](std::uint32_t node, OrderKey smallest, OrderKey largest) {
                             found.push_back({node, smallest, largest});
                         });
        ASSERT_EQ(found, expected) << "trial " << trial;
    }
}

TEST(Lattice, DividesTheDistinctExtremesIntoListsOfEqualLength) {
    DistinctKeys keys;
    for (const OrderKey key : {5u, 0u, 0xffffffffu, 7u, 5u, 65536u, 65535u, 7u, 64u, 63u})
        keys.insert(key);
    EXPECT_EQ(keys.count(), 8u);
    EXPECT_EQ(lattice_lines(keys, 4), (std::vector<OrderKey>{5, 63, 65535, 0xffffffff}));
    EXPECT_EQ(lattice_lines(keys, 1), (std::vector<OrderKey>{0xffffffff}));
    EXPECT_EQ(lattice_lines(keys, 3), (std::vector<OrderKey>{5, 64, 0xffffffff}));
    const std::vector<OrderKey> all{0, 5, 7, 63, 64, 65535, 65536, 0xffffffff};
    EXPECT_EQ(lattice_lines(keys, 8), all);
    EXPECT_EQ(lattice_lines(keys, 4096), all);
}

TEST(Lattice, OfNoExtremesHasNoElements) {
    EXPECT_TRUE(lattice_lines(DistinctKeys(), 64).empty());
    DistinctKeys one;
    one.insert(17);
    EXPECT_EQ(lattice_lines(one, 64), std::vector<OrderKey>{17});
}

TEST(Lattice, FindsTheElementOfAKeyWhateverIsGuessed) {
    const std::vector<OrderKey> lines{3, 5, 8, 12};
    for (OrderKey key = 0; key < 15; ++key) {
        std::uint32_t expected = 0;
        while (expected < lines.size() && lines[expected] < key)
            ++expected;
        EXPECT_EQ(element_of(lines, key), expected);
        for (std::uint32_t guess = 0; guess < lines.size(); ++guess)
            EXPECT_EQ(element_near(lines, key, guess), expected);
    }
}

/// An interval tree with the lists it owns.
struct OwnTree {
    explicit OwnTree(std::vector<Interval> intervals)
        : numbers(4 * intervals.size()), size(intervals.size()) {
        root = build_interval_tree(intervals, nodes, {part(0), part(1), part(2), part(3)}, 0);
    }
    std::span<std::uint32_t> part(std::size_t i) {
        return std::span(numbers).subspan(i * size, size);
    }
    std::vector<CellId> at(OrderKey threshold) {
        std::vector<CellId> found;
        search_interval_tree(nodes, root, {part(0), part(1), part(2), part(3)}, threshold, found);
        std::sort(found.begin(), found.end());
        return found;
    }
    std::vector<std::uint32_t> numbers;
    std::size_t size;
    std::vector<IntervalNode> nodes;
    std::uint32_t root;
};

TEST(IntervalTree, IsTheOneThatTheDefinitionGives) {
    // Extremes 1 to 7, so 4 is at the root: a and b hold it, c and d lie below, e above.
    OwnTree tree({{1, 5, 'a'}, {3, 7, 'b'}, {1, 2, 'c'}, {2, 3, 'd'}, {5, 6, 'e'}, {4, 7, 'f'}});
    const IntervalNode& root = tree.nodes.at(tree.root);
    EXPECT_EQ(root.split, 4u);
    EXPECT_EQ(root.end - root.begin, 2u);
    EXPECT_EQ(tree.part(0)[root.begin], CellId{'a'}) << "AL ascends by the left end";
    EXPECT_EQ(tree.part(2)[root.begin], CellId{'b'}) << "DR descends by the right end";
    // 6 parts the upper extremes 4 to 7 and lies in both e and f.
    const IntervalNode& right = tree.nodes.at(root.right);
    EXPECT_EQ(right.split, 6u);
    EXPECT_EQ(right.end - right.begin, 2u);
    EXPECT_EQ(tree.at(4), (std::vector<CellId>{'a', 'b'}));
    EXPECT_EQ(tree.at(5), (std::vector<CellId>{'a', 'b', 'f'}));
    EXPECT_EQ(tree.at(1), (std::vector<CellId>{}));
    EXPECT_EQ(tree.at(2), (std::vector<CellId>{'a', 'c'}));
    EXPECT_EQ(tree.at(8), (std::vector<CellId>{}));
}

TEST(IntervalTree, OfNoIntervalsFindsNothing) {
    OwnTree tree({});
    EXPECT_EQ(tree.root, IntervalNode::kNone);
    EXPECT_TRUE(tree.at(3).empty());
}

TEST(IntervalTree, FindsTheIntervalsThatHoldAValue) {
    std::mt19937 random(test_seed());
    for (int trial = 0; trial < 200; ++trial) {
        const std::uint32_t range = 2 + below(random, 60);
        std::vector<Interval> intervals(1 + below(random, 80));
        for (CellId id = 0; id < intervals.size(); ++id) {
            const OrderKey low = below(random, range - 1);
            intervals[id] = {low, low + 1 + below(random, range - low), id};
        }
        OwnTree tree(intervals);
        EXPECT_LE(tree.nodes.size(), 2 * intervals.size());
        for (OrderKey threshold = 0; threshold <= 2 * range; ++threshold) {
            std::vector<CellId> expected;
            for (const Interval& interval : intervals)
                if (interval.low < threshold && threshold <= interval.high)
                    expected.push_back(interval.id);
            ASSERT_EQ(tree.at(threshold), expected) << "trial " << trial;
        }
    }
}

} // namespace
} // namespace isochron::index
