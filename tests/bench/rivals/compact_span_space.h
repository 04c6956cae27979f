// A span space whose AL and DR share their ids: one of the improvements that the paper proposes.
#pragma once

#include "index/paper/span_space.h"

#include <cstdint>
#include <span>
#include <vector>

namespace isochron::bench {

/// AL stores ids. DR stores the places of the same cells in AL, in as few bytes as the list's
/// length allows. Equal keys are stored once if that saves space.
class CompactSpanSpace {
  public:
    /// @param lines of the lattice, which all time nodes share; must outlive this
    CompactSpanSpace(std::vector<index::Interval> entries, std::span<const index::OrderKey> lines);

    std::uint64_t bytes() const;
    std::uint64_t entries() const { return ids_.size(); }
    void search(index::OrderKey threshold, std::vector<index::CellId>& out) const;

  private:
    /// A sorted list of keys: its distinct keys, followed by the end of each in the list; or all of
    /// its keys if `count` is the list's length.
    struct Keys {
        std::uint32_t begin, count;
    };
    struct List {
        std::uint32_t begin, end; ///< range of its ids
        std::uint32_t places;     ///< first byte of DR
        Keys low, high;
        std::uint32_t length() const { return end - begin; }
    };

    List add(std::uint32_t begin, const index::Lists<index::Readable>& lists);
    Keys add_keys(std::span<const index::OrderKey> keys);
    template <class Before>
    std::uint32_t prefix(const List& list, const Keys& keys, Before&& before) const;
    void collect_low(const List& list, index::OrderKey threshold,
                     std::vector<index::CellId>& out) const;
    void collect_high(const List& list, index::OrderKey threshold,
                      std::vector<index::CellId>& out) const;

    std::span<const index::OrderKey> lines_;
    std::vector<std::uint32_t> roots_;      ///< an interval tree for each line
    std::vector<index::IntervalNode> tree_; ///< nodes of all trees
    std::vector<List> lists_;               ///< lists of the rows, then those of the tree's nodes
    std::vector<index::CellId> ids_;
    std::vector<std::uint8_t> places_;
    std::vector<std::uint32_t> keys_;
};

} // namespace isochron::bench
