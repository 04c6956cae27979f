// Levels of detail: each level has about half the vertices of the level before along each axis.
//
// Level 0 is the step itself. The next level keeps the vertices with even coordinates and the last
// one along each axis: the vertices of level k lie at every 2^k-th position of level 0, and on its
// border. A value is the weighted mean of a vertex of the level before and its up to 26 neighbors,
// with weights 1 2 1 along each axis, that is, 8, 4, 2 and 1. Neighbors outside the grid and values
// that are NaN are left out; if nothing is left, the value is NaN. Integers are rounded to the
// nearest, halves upwards. Floats are summed in double as (a + 2 b) + c along x, then these along
// y, then along z. Their weights are summed in the same way, and the quotient is rounded to the
// type.
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

/// The grids of all levels, finest first, down to the first that fits a single chunk of the file.
/// The spacing of level k is 2^k times the spacing of level 0, but the last two vertices along an
/// axis may be nearer to each other.
std::vector<Grid> detail_grids(const Grid& grid);

/// Makes planes of the next level, in any order. Keeps its work space: one for each thread.
class Coarsener {
  public:
    /// @param grid of the level from which the next one is made
    Coarsener(ValueType type, const Grid& grid);

    /// Number of planes of the next level whose middle plane is among the first `planes` of this
    /// one.
    std::uint32_t made_of(std::uint32_t planes) const;

    /// Makes the planes from `begin` to `end` of the next level.
    /// @param held planes of this level from number `first` on, [z][y][x], x fastest. Plane z of
    ///        the next level needs plane 2 z (or the last one) and the planes before and after it
    void make(std::span<const std::byte> held, std::uint32_t first, std::uint32_t begin,
              std::uint32_t end, std::span<std::byte> out);

    /// The vertices along one axis from which a vertex of the next level is made.
    struct Taps {
        Taps(std::uint32_t place, std::uint32_t vertices)
            : middle(2 * place < vertices ? 2 * place : vertices - 1), below(middle > 0),
              above(middle + 1 < vertices) {}
        int weight() const { return 2 + (below ? 1 : 0) + (above ? 1 : 0); }

        std::uint32_t middle;
        bool below, above; ///< whether the middle has these neighbors
    };
    /// A plane of this level, reduced along x and y: weighted sums of values and, if some are NaN
    /// (`gaps`), the sums of the weights of the others.
    struct Plane {
        std::optional<std::uint32_t> number;
        bool gaps = false;
        std::vector<std::uint64_t> values, weights;
    };
    struct Work {
        std::array<std::uint32_t, 3> from{}, to{}; ///< vertices of this level and the next
        std::array<Plane, 3> planes;
        std::vector<std::uint64_t> rows;            ///< rows of a plane, reduced along x
        std::vector<std::uint64_t> values, weights; ///< sums of a row
    };

  private:
    ValueType type_;
    Work work_;
};

} // namespace isochron::index
