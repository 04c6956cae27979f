// Levels of detail: each step again with about half the vertices along each axis, and so on down.
//
// Level 0 is the step itself. Of the vertices of a level the next has those with even coordinates,
// and the last along each axis: the vertices of level k lie at every 2^k-th position of level 0,
// and on its border. A value is the mean of the level below with weights 1 2 1 along each axis,
// that is, of a vertex and its up to 26 neighbors with weights 8, 4, 2 and 1. Neighbors outside the
// grid, and those that are NaN, are left out of it; where none is left it is NaN. Integers are
// rounded to the nearest, halves upwards. Sums of floats are made in double, (a + 2 b) + c along x,
// then of these along y, then along z, and so are those of their weights; their quotient is
// rounded to the type.
#pragma once

#include "index/volume/grid.h"
#include "index/volume/value_type.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace isochron::index {

/// The grids of all levels, the finest first: down to one that a single chunk of the file holds.
/// The spacing of level k is 2^k times that of level 0, but between the last two vertices along an
/// axis, which may be nearer to each other.
std::vector<Grid> detail_grids(const Grid& grid);

/// Makes planes of the next level, in any order. Keeps its work space: one for each thread.
class Coarsener {
  public:
    /// @param grid of the level that the next one is made of
    Coarsener(ValueType type, const Grid& grid);

    /// How many planes of the next level have their middle among so many first planes of this one.
    std::uint32_t made_of(std::uint32_t planes) const;

    /// Makes the planes from `begin` to `end` of the next level.
    /// @param held planes of this level from number `first` on, [z][y][x], x fastest: those at
    ///        twice these numbers (at most the last), the ones before and the ones behind
    void make(std::span<const std::byte> held, std::uint32_t first, std::uint32_t begin,
              std::uint32_t end, std::span<std::byte> out);

    /// What a vertex of the next level is made of along one axis.
    struct Taps {
        Taps(std::uint32_t place, std::uint32_t vertices)
            : middle(2 * place < vertices ? 2 * place : vertices - 1), below(middle > 0),
              above(middle + 1 < vertices) {}
        int weight() const { return 2 + (below ? 1 : 0) + (above ? 1 : 0); }

        std::uint32_t middle;
        bool below, above; ///< whether there are such neighbors
    };
    /// A plane of this level, reduced along x and y: sums of values, and of the weights of those
    /// that are not missing where it has gaps.
    struct Plane {
        std::optional<std::uint32_t> number;
        bool gaps = false;
        std::vector<std::uint64_t> values, weights;
    };
    struct Work {
        std::array<std::uint32_t, 3> from{}, to{}; ///< vertices of this level and the next
        std::array<Plane, 3> planes;
        std::vector<std::uint64_t> rows;            ///< of a plane, reduced along x
        std::vector<std::uint64_t> values, weights; ///< of a row
    };

  private:
    ValueType type_;
    Work work_;
};

} // namespace isochron::index
