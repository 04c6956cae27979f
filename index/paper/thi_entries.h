// The entries of a THI tree: the cells at each time node, with their extremes.
#pragma once

#include "index/paper/interval_tree.h"
#include "index/progress.h"
#include "index/volume/step_values.h"
#include "index/volume/tree_options.h"

#include <cstddef>
#include <cstdint>
#include <deque>
#include <vector>

namespace isochron::index {

/// The entries of a THI tree before they are sorted into lists. Other structures that merge cells
/// over time as the paper does can share them.
class ThiEntries {
  public:
    /// Every cell becomes an entry, with its temporal extremes, of the highest time nodes in whose
    /// span its points lie in at most `max_variation` lattice elements; steps with a NaN vertex
    /// give no point. Nodes whose span has only steps at which the cell's two extremes are equal do
    /// not get it, since it cannot be active there. An entry takes 12 bytes.
    /// @param progress called from the calling thread only
    /// @throws Error when an option is out of its range, or there is no step
    ThiEntries(const StepValues& values, const ThiOptions& options, const Progress& progress,
               unsigned threads);

    const ThiOptions& options() const { return options_; }
    std::uint32_t steps() const { return steps_; }
    const std::vector<OrderKey>& lines() const { return lines_; } ///< lines of the lattice
    std::size_t nodes() const { return nodes_; }                  ///< as TimeNode numbers them
    std::uint64_t count(std::size_t node) const;

    /// Moves a node's entries out, in no particular order. Threads may take from different nodes.
    std::vector<Interval> take(std::size_t node);

  private:
    /// Entries of each time node; in small blocks, since there are many nodes.
    using ByNode = std::vector<std::deque<Interval>>;

    ThiOptions options_;
    std::uint32_t steps_;
    std::size_t nodes_;
    std::vector<OrderKey> lines_;
    std::vector<ByNode> by_worker_; ///< the entries that each building thread found
};

} // namespace isochron::index
