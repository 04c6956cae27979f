// The grid that every step of a series shares: regular, or rectilinear.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <vector>

#include <glm/mat3x3.hpp>
#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>

namespace isochron::index {

/// Number of a cell: x fastest, then y, then z. In grids of 2^32 cells and more it is the low 32
/// bits of that number, which are still unique within a layer of chunks.
using CellId = std::uint32_t;

/// Distances of the vertices along an axis from the first of them, where they are not even.
class AxisPositions {
  public:
    AxisPositions() = default; ///< even ones
    /// @param distances rising from 0, one for each vertex
    explicit AxisPositions(std::vector<double> distances)
        : distances_(std::make_shared<const std::vector<double>>(std::move(distances))) {}

    bool even() const { return !distances_; }
    /// Empty where they are even.
    const std::vector<double>& distances() const {
        static const std::vector<double> none;
        return distances_ ? *distances_ : none;
    }
    bool operator==(const AxisPositions& other) const {
        return distances_ == other.distances_ || distances() == other.distances();
    }

  private:
    std::shared_ptr<const std::vector<double>> distances_;
};

/// Vertices lie at origin + direction * (spacing * index). A cell is the box between 8 vertices;
/// there are (nx-1)(ny-1)(nz-1). Physical space is right-handed and in `SeriesInfo::length_unit`;
/// a direction matrix of determinant -1 says that the storage order itself is left-handed. On a
/// rectilinear grid some axes have positions of their own; `spacing` is then the mean between them,
/// so that the first and the last vertex lie where it puts them.
struct Grid {
    std::array<std::uint32_t, 3> vertices{}; ///< nx, ny, nz, each at least 2
    glm::dvec3 origin{0.0};
    glm::dvec3 spacing{1.0};                  ///< each > 0
    glm::dmat3 direction{1.0};                ///< columns: the unit vectors of the three index axes
    std::array<AxisPositions, 3> positions{}; ///< in the unit of `spacing`

    std::array<std::uint32_t, 3> cells() const {
        return {vertices[0] - 1, vertices[1] - 1, vertices[2] - 1};
    }
    std::uint64_t vertex_count() const {
        return std::uint64_t{vertices[0]} * vertices[1] * vertices[2];
    }
    std::uint64_t cell_count() const {
        const auto c = cells();
        return std::uint64_t{c[0]} * c[1] * c[2];
    }
    /// Cell coordinates (x, y, z) of an id. The grid must have fewer than 2^32 cells.
    std::array<std::uint32_t, 3> cell_of(CellId id) const {
        const auto c = cells();
        return {id % c[0], id / c[0] % c[1], id / c[0] / c[1]};
    }
    bool rectilinear() const {
        return !(positions[0].even() && positions[1].even() && positions[2].even());
    }
    /// Maps even coordinates to physical space. An even coordinate is the distance from the first
    /// vertex along an axis, in spacings: on a regular grid the vertex index coordinate (a cell's
    /// center is its lowest vertex + 0.5), on a rectilinear grid what `even_place` makes of that.
    glm::dmat4 physical_from_index() const;
    /// The even coordinate of a vertex.
    double even_place(int axis, std::uint32_t vertex) const;
    /// Lengths of a cell's sides in even coordinates.
    glm::dvec3 even_size(const std::array<std::uint32_t, 3>& cell) const;
    /// The part of the grid between some planes of vertices along z, seen for itself: its vertices
    /// count from 0, and so do its distances along z. The origin stays.
    Grid planes(std::uint32_t first, std::uint32_t end) const;
    /// The part between some planes along each axis, as a grid.
    Grid part(const std::array<std::uint32_t, 3>& first,
              const std::array<std::uint32_t, 3>& end) const;

    /// Factors of the differences to the vertices before and behind one, so that their sum is the
    /// slope there per even coordinate: exact for a parabola through the three; at the border
    /// one-sided.
    struct SlopeWeights {
        double before = 0, behind = 0;
    };
    SlopeWeights slope_weights(int axis, std::uint32_t vertex) const;

    /// From the first vertex to a place in index coordinates along an axis; between vertices, and
    /// beyond them, in proportion.
    double distance(int axis, double index) const;
    /// The inverse of `distance`: index coordinate at a distance from the first vertex.
    double index_at(int axis, double distance) const;
    /// The place of index coordinates in physical space, exact on every grid.
    glm::dvec3 physical(const glm::dvec3& index) const;
    glm::dvec3 index_of(const glm::dvec3& physical) const;

    bool operator==(const Grid&) const = default;
};

/// Whether the grid has cells whose number does not fit into a CellId.
inline bool has_wide_ids(const Grid& grid) {
    return grid.cell_count() > 0xffff'ffffu;
}

/// The full number of the cell at (x, y, z), in any grid.
inline std::uint64_t wide_id(const Grid& grid, std::uint32_t x, std::uint32_t y, std::uint32_t z) {
    const auto c = grid.cells();
    return x + c[0] * (y + std::uint64_t{c[1]} * z);
}

} // namespace isochron::index
