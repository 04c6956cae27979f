// Which cells are stored at which time nodes of a THI tree, by which extremes.
#pragma once

#include "index/progress.h"
#include "index/thi/interval_tree.h"
#include "index/volume/step_values.h"

#include <cstddef>
#include <cstdint>
#include <deque>
#include <functional>
#include <string_view>
#include <vector>

namespace isochron::index {

struct ThiOptions {
    std::uint32_t lattice = 64; ///< SpanSpaceSize L: the lattice has L x L elements; 1 to 4096
    std::uint32_t max_variation =
        2; ///< most distinct lattice elements of a "constant" cell; 1 to 64
    bool operator==(const ThiOptions&) const = default;
};

/// The entries of a THI tree before they are organized into lists: what every structure shares that
/// merges cells over time as the paper does.
class ThiEntries {
  public:
    /// Every cell becomes an entry of the highest time nodes over whose span its points occupy at
    /// most `max_variation` elements, with its temporal extremes; steps where it has a NaN vertex
    /// give no point. It is left out where it cannot be active: at no step of the span does it have
    /// two values. An entry takes 12 bytes.
    /// @param progress called from the calling thread only
    /// @throws Error when an option is out of its range, or there is no step
    ThiEntries(const StepValues& values, const ThiOptions& options, const Progress& progress,
               unsigned threads);

    const std::vector<OrderKey>& lines() const { return lines_; } ///< of the lattice
    std::size_t nodes() const { return nodes_; }                  ///< as TimeNode numbers them
    std::uint64_t count(std::size_t node) const;

    /// Gives a node's entries away, in no particular order. Threads may take from different nodes.
    std::vector<Interval> take(std::size_t node);

  private:
    /// For each time node; in small blocks, for there are many.
    using ByNode = std::vector<std::deque<Interval>>;

    std::size_t nodes_;
    std::vector<OrderKey> lines_;
    std::vector<ByNode> by_worker_; ///< as each thread of the construction found them
};

} // namespace isochron::index
