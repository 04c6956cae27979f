// Queries to an index: isovalues at one instant of its series.
#pragma once

#include "index/volume/instant.h"

#include <glm/vec3.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>
#include <vector>

namespace isochron::index {

/// How the active cells are found.
enum class SearchMethod : std::uint8_t { bricks, tree, scan };
constexpr std::array<std::string_view, 3> kSearchMethodNames{"bricks", "tree", "scan"};

/// Asks for the active cells: a cell is active if min < isovalue <= max over its 8 scaled vertex
/// values and none of these is NaN. An isovalue that is NaN or infinite has no active cells.
struct Query {
    Instant instant = {};
    double isovalue = 0.0;
    bool operator==(const Query&) const = default;
};

/// Most isosurfaces that are shown together.
constexpr std::size_t kMostSurfaces = 8;

/// The quantity of the cells' color coordinates (index/surface/cell_colors.h).
enum class CellColoring : std::uint8_t {
    none,
    value,          ///< an array to color by, on the surface
    first_crossing, ///< the time of the first step at which the cell is active
    /// The time of the first instant at which the cell is active, where steps are blended.
    first_blended_crossing
};
constexpr std::array<std::string_view, 4> kCellColoringNames{"none", "value", "first_crossing",
                                                             "first_blended_crossing"};
constexpr bool by_first_crossing(CellColoring coloring) {
    return coloring == CellColoring::first_crossing ||
           coloring == CellColoring::first_blended_crossing;
}

/// How many cells an extraction may hold, and how fine it needs to be. By default it holds all
/// cells of the volume itself.
struct DetailQuery {
    /// If there are more cells than this, cells of coarser levels replace them; 0: never.
    std::uint64_t most_cells = 0;
    bool at_rest = false; ///< for a picture at rest: a renderer holds it beside one for motion
    /// Parts of a level in which wishes are given: they order the regions that share one level.
    static constexpr int kPartsOfLevel = 4;
    /// Finest useful level of each region (index/detail/detail_regions.h), in parts of a level,
    /// which are rounded down. Below 0 it is still level 0 that is used, but the region gives way
    /// later than others when there are too many cells. Empty: 0 everywhere.
    std::vector<std::int8_t> wished;
    bool operator==(const DetailQuery&) const = default;
};

/// A connected piece of a surface (index/measure/mesh_pieces.h): the one whose mesh comes nearest to a
/// place.
struct PieceAt {
    std::uint32_t surface = 0; ///< place of its isovalue in the query
    glm::dvec3 place{0.0};     ///< physical space, finite
    bool operator==(const PieceAt&) const = default;
};
/// Which connected pieces of the surfaces are kept; without any of it, all.
struct PieceFilter {
    std::vector<PieceAt> only;   ///< a surface that has some here loses its other pieces
    std::vector<PieceAt> hidden; ///< a place more than two cells away from its surface hides nothing
    std::uint32_t dust = 0;      ///< pieces of fewer active cells go, but those of `only` stay
    bool operator==(const PieceFilter&) const = default;

    bool keeps_all() const { return only.empty() && hidden.empty() && dust == 0; }
};

/// The isosurfaces of 1 to kMostSurfaces isovalues at one instant.
struct SurfacesQuery {
    Instant instant = {};
    std::vector<double> isovalues; ///< a surface is identified by its place in this list
    CellColoring coloring = CellColoring::none;
    /// Most bytes for the meshes of all surfaces together. Either all surfaces have a mesh or none
    /// has; 0: none.
    std::uint64_t mesh_room = 0;
    DetailQuery detail{};
    std::uint32_t array = 0;  ///< number of the index's array
    std::uint32_t colors = 0; ///< array to color by (ColorSource), by number: for coloring `value`
    PieceFilter pieces{};

    Query surface(std::size_t i) const { return {instant, isovalues[i]}; }
    /// These surfaces, however they are drawn and at any level of detail.
    SurfacesQuery of_cells() const {
        SurfacesQuery query = *this;
        query.mesh_room = 0;
        query.detail = {};
        return query;
    }
    bool operator==(const SurfacesQuery&) const = default;
};

} // namespace isochron::index
