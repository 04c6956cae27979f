// T-BON: an octree for each step, with one topology; a rival that needs the volume in memory.
#pragma once

#include "index/progress.h"
#include "index/volume/query.h"
#include "index/volume/step_values.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace isochron::bench {

/// Temporal branch-on-need octree (Sutton and Hansen, "Isosurface extraction in time-varying fields
/// using a temporal branch-on-need tree (T-BON)", IEEE Visualization 1999,
/// doi 10.1109/VISUAL.1999.809895; the octree is that of Wilhelms and Van Gelder 1992,
/// doi 10.1145/130881.130882). A leaf covers 2x2x2 cells; a node has the children that the grid's
/// extent needs. The topology is stored once, the extremes of every node for each step.
class Tbon {
  public:
    /// @param values must outlive this: a search reads the vertices of the leaves it reaches
    /// @param threads 0: one for each processor
    explicit Tbon(const index::StepValues& values, unsigned threads = 0);

    /// Bytes of the topology and of all extremes, which are stored in the values' type.
    std::uint64_t bytes() const;

    /// Appends the active cells, leaf by leaf. Exact, also beside NaN vertices.
    void search(const index::Query& query, std::vector<index::CellId>& out) const;

  private:
    struct Node {
        std::uint32_t first_child; ///< siblings are neighbors
        std::uint32_t children;    ///< 0 for a leaf
        std::uint32_t x, y, z;     ///< in nodes of its own level
    };
    template <class T>
    struct Extremes {
        T low, high; ///< low > high if all vertices are NaN
    };

    void build_topology();
    template <class T>
    void find_extremes(std::size_t step);
    template <class T>
    void search_step(std::size_t step, T cut, std::vector<index::CellId>& out) const;
    template <class T>
    void search_leaf(const T* volume, T cut, const Node& leaf,
                     std::vector<index::CellId>& out) const;

    index::StepValues values_;
    std::vector<Node> nodes_;         ///< breadth first, root first: the leaves are last
    std::vector<std::byte> extremes_; ///< Extremes of the values' type, [step][node]
};

} // namespace isochron::bench
