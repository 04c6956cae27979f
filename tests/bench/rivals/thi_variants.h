// The improvements of the THI tree that its authors proposed as future work, for measurements.
#pragma once

#include "index/paper/thi_entries.h"
#include "index/progress.h"

#include <cstdint>
#include <memory>
#include <vector>

namespace isochron::bench {

/// Section 7 of the paper proposes these. All merge cells over time like the published tree (one
/// lattice decides what is constant), so they have the same entries and false positives. They
/// differ in how a time node stores its entries.
enum class ThiVariant {
    node_lattices,  ///< a subdivision of span space for each time node, by its own extremes
    interval_trees, ///< no span space: one interval tree for each time node
    compact_lists,  ///< AL stores the ids, DR only places in AL; equal keys are stored once
};

/// Read access to the entries of all time nodes.
class ThiVariantTree {
  public:
    virtual ~ThiVariantTree() = default;
    virtual std::uint64_t bytes() const = 0; ///< size of all data that searches read
    virtual std::uint64_t entries() const = 0;
    /// As ThiTree::search: appends the candidates, unordered, each once.
    virtual void search(std::uint32_t step, std::uint64_t threshold,
                        std::vector<index::CellId>& out) const = 0;
};

/// @param threads 0: one for each processor
std::unique_ptr<ThiVariantTree> build_thi_variant(ThiVariant variant, index::ThiEntries entries,
                                                  const index::Progress& progress = {},
                                                  unsigned threads = 0);

} // namespace isochron::bench
