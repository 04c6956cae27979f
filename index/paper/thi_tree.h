// Temporal Hierarchical Index Tree: the paper's search structure, in one flat block of bytes.
//
// Vrolijk, Botha and Post, "Fast time-dependent isosurface extraction and rendering", SCCG 2004,
// doi 10.1145/1037210.1037218, sections 3 and 4; after Shen, "Isosurface extraction in time-varying
// fields using a temporal hierarchical index tree", IEEE Visualization 1998,
// doi 10.1109/VISUAL.1998.745298.
//
//     auto bytes = index::build_thi_tree(values, {.lattice = 64, .max_variation = 2});
//     index::ThiTree tree(bytes);
//     std::vector<index::CellId> found;
//     tree.search(step, keys.threshold(isovalue), found);   // candidates; test them in the volume
#pragma once

#include "index/paper/thi_entries.h"
#include "index/paper/thi_layout.h"
#include "index/paper/time_tree.h"
#include "index/progress.h"
#include "index/volume/order_key.h"
#include "index/volume/query.h"
#include "index/volume/step_values.h"

#include <cstddef>
#include <span>
#include <vector>

namespace isochron::index {

/// Builds the tree. The bytes are position-independent, little-endian, a multiple of 8 long, and
/// the same for every number of threads. ThiEntries describes the entries. An entry takes 16 bytes,
/// and 12 more while the tree is built.
/// @param progress called from the calling thread only
/// @param threads 0: one for each processor
/// @throws Error when an option is out of its range, or there is no step
std::vector<std::byte> build_thi_tree(const StepValues& values, const ThiOptions& options,
                                      const Progress& progress = {}, unsigned threads = 0);
/// Builds the tree from entries that were found before.
std::vector<std::byte> build_thi_tree(ThiEntries entries, const Progress& progress,
                                      unsigned threads);

/// A built tree. Refers to the bytes, which must outlive it.
class ThiTree {
  public:
    /// Checks every offset, so that a search cannot leave a damaged block. It does not check ids
    /// and keys: a damaged block may give wrong ids, even ids that no cell has.
    /// @throws Error when the bytes are not a tree or not aligned to 8
    explicit ThiTree(std::span<const std::byte> bytes);

    /// Entries stored at every node of the binary time tree, in depth-first order, root first.
    std::vector<TimeNodeCells> nodes() const;
    ThiOptions options() const { return {header_.lattice, header_.max_variation}; }
    std::uint32_t steps() const { return header_.steps; }
    std::uint64_t entries() const {
        return header_.entries;
    } ///< entries of all nodes; at most 1 for each cell and step, fewer with temporal coherence

    /// Appends every cell that may be active (section 4.1), unordered: all active cells, once each,
    /// and false positives of temporal merging. The step must be one of the tree's.
    void search(std::uint32_t step, std::uint64_t threshold, std::vector<CellId>& out) const;

    /// State of an incremental search (section 4.2): the last result and the vector V.
    struct Cursor {
        std::vector<CellId> cells;        ///< candidates of the last search
        std::vector<std::size_t> reached; ///< V: size of `cells` after each depth
        std::uint32_t step = 0;
        std::uint64_t threshold = 0;
        bool valid = false;
    };
    /// Moves the cursor to any step. Reuses the cells of the lowest common node of both steps and
    /// of the nodes above it. A changed threshold makes a full search.
    /// @return number of reused cells
    std::size_t search_incremental(Cursor& cursor, std::uint32_t step,
                                   std::uint64_t threshold) const;

  private:
    void search_node(std::uint32_t number, OrderKey threshold, std::vector<CellId>& out) const;

    ThiHeader header_;
    ThiParts<Readable> parts_;
};

} // namespace isochron::index
