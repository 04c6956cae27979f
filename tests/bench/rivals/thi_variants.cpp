// The improvements of the THI tree that its authors proposed as future work.
#include "tests/bench/rivals/thi_variants.h"

#include "index/paper/lattice.h"
#include "index/paper/span_space.h"
#include "index/paper/time_tree.h"
#include "index/system/parallel.h"
#include "tests/bench/rivals/compact_span_space.h"
#include "tests/bench/rivals/owned_lists.h"

#include <limits>
#include <numeric>
#include <optional>

namespace isochron::bench {

using index::CellId;
using index::Interval;
using index::IntervalNode;
using index::OrderKey;

namespace {

/// A span space with its own lattice, of at most the given number of lines.
class NodeLattice {
  public:
    NodeLattice(std::vector<Interval> entries, std::uint32_t lattice)
        : lines_(lines_of(entries, lattice)), row_starts_(lines_.size() + 1), roots_(lines_.size()),
          lists_(entries.size()) {
        index::build_span_space(std::move(entries),
                                {lines_, row_starts_, roots_, lists_.writable()}, tree_);
    }
    std::uint64_t bytes() const {
        return (lines_.size() + row_starts_.size() + roots_.size()) * sizeof(std::uint32_t) +
               lists_.bytes() + tree_.size() * sizeof(IntervalNode);
    }
    std::uint64_t entries() const { return lists_.size(); }
    void search(OrderKey threshold, std::vector<CellId>& out) const {
        index::search_span_space({lines_, row_starts_, roots_, lists_.readable()}, tree_, threshold,
                                 out);
    }

  private:
    static std::vector<OrderKey> lines_of(std::span<const Interval> entries,
                                          std::uint32_t lattice) {
        index::DistinctKeys extremes;
        for (const Interval& entry : entries) {
            extremes.insert(entry.low);
            extremes.insert(entry.high);
        }
        return index::lattice_lines(extremes, lattice);
    }

    std::vector<OrderKey> lines_;
    std::vector<std::uint32_t> row_starts_, roots_;
    OwnedLists lists_;
    std::vector<IntervalNode> tree_;
};

/// All entries in one interval tree.
class WholeIntervalTree {
  public:
    explicit WholeIntervalTree(std::vector<Interval> entries)
        : lists_(entries.size()),
          root_(index::build_interval_tree(entries, tree_, lists_.writable(), 0)) {}
    std::uint64_t bytes() const {
        return lists_.bytes() + tree_.size() * sizeof(IntervalNode) + sizeof root_;
    }
    std::uint64_t entries() const { return lists_.size(); }
    void search(OrderKey threshold, std::vector<CellId>& out) const {
        index::search_interval_tree(tree_, root_, lists_.readable(), threshold, out);
    }

  private:
    OwnedLists lists_;
    std::vector<IntervalNode> tree_;
    std::uint32_t root_;
};

/// The binary time tree, for any type of node that stores entries.
template <class Node>
class Tree : public ThiVariantTree {
  public:
    /// @param make `Node(entries, lines of the lattice)`
    template <class Make>
    Tree(index::ThiEntries entries, const index::Progress& progress, unsigned threads, Make&& make)
        : steps_(entries.steps()), lines_(entries.lines()) {
        std::vector<std::optional<Node>> nodes(entries.nodes());
        index::parallel_for(
            nodes.size(), index::thread_count(threads),
            [&](std::size_t node, unsigned) { nodes[node] = make(entries.take(node), lines_); },
            index::phase_of(progress, "sorting lists"));
        for (auto& node : nodes)
            nodes_.push_back(*std::move(node));
    }

    std::uint64_t bytes() const override {
        return std::accumulate(
            nodes_.begin(), nodes_.end(), std::uint64_t{lines_.size() * sizeof(OrderKey)},
            [](std::uint64_t sum, const Node& node) { return sum + node.bytes(); });
    }
    std::uint64_t entries() const override {
        return std::accumulate(
            nodes_.begin(), nodes_.end(), std::uint64_t{0},
            [](std::uint64_t sum, const Node& node) { return sum + node.entries(); });
    }
    void search(std::uint32_t step, std::uint64_t threshold,
                std::vector<CellId>& out) const override {
        if (threshold > std::numeric_limits<OrderKey>::max())
            return;
        for (auto node = index::TimeNode::root(steps_);; node = node.towards(step)) {
            nodes_[node.number].search(static_cast<OrderKey>(threshold), out);
            if (node.is_leaf())
                return;
        }
    }

  private:
    std::uint32_t steps_;
    std::vector<OrderKey> lines_;
    std::vector<Node> nodes_;
};

} // namespace

std::unique_ptr<ThiVariantTree> build_thi_variant(ThiVariant variant, index::ThiEntries entries,
                                                  const index::Progress& progress,
                                                  unsigned threads) {
    switch (variant) {
    case ThiVariant::node_lattices: {
        const std::uint32_t lattice = entries.options().lattice;
        return std::make_unique<Tree<NodeLattice>>(
            std::move(entries), progress, threads,
            [lattice](std::vector<Interval> of_node, std::span<const OrderKey>) {
                return NodeLattice(std::move(of_node), lattice);
            });
    }
    case ThiVariant::interval_trees:
        return std::make_unique<Tree<WholeIntervalTree>>(
            std::move(entries), progress, threads,
            [](std::vector<Interval> of_node, std::span<const OrderKey>) {
                return WholeIntervalTree(std::move(of_node));
            });
    case ThiVariant::compact_lists: break;
    }
    return std::make_unique<Tree<CompactSpanSpace>>(
        std::move(entries), progress, threads,
        [](std::vector<Interval> of_node, std::span<const OrderKey> lines) {
            return CompactSpanSpace(std::move(of_node), lines);
        });
}

} // namespace isochron::bench
