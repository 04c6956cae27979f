// What can be measured of an isosurface: a table of measures, each a number of one surface.
//
//     index::SurfaceMeasures measures(file);
//     const index::MeasuredSurface found = *measures.measure({index::Instant(step), isovalue});
//     for (std::size_t i = 0; i < index::measures().size(); ++i)
//         add_row(index::measures()[i].name, found.values[i]);
#pragma once

#include "index/file/color_source.h"
#include "index/file/index_file.h"
#include "index/measure/plane_cut.h"
#include "index/search/surface_mesh.h"
#include "index/surface/mesh_crop.h"
#include "index/volume/query.h"

#include <glm/vec3.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <stop_token>
#include <string>
#include <string_view>
#include <vector>

namespace isochron::index {

class MeasuredStep;

/// What a measure counts.
enum class MeasureUnit : std::uint8_t {
    none,
    area,
    volume,
    value,   ///< unit of the array on the surface
    distance ///< length from a place
};

/// One measure. A further one is a function and a row of the table.
struct Measure {
    std::string_view name; ///< as on a command line
    MeasureUnit unit;      ///< all but `value` are powers of `SeriesInfo::length_unit`
    std::string_view definition;
    double (*of)(MeasuredStep& step); ///< NaN where it is not defined
};

/// In the order in which they are listed. Those that need an array on the surface, or a place, are NaN
/// unless one is asked for.
std::span<const Measure> measures();
/// Whether a measure has numbers. @param on_surface an array is asked for @param from a place is
constexpr bool is_measured(const Measure& measure, bool on_surface, bool from) {
    return measure.unit == MeasureUnit::value      ? on_surface
           : measure.unit == MeasureUnit::distance ? from
                                                   : true;
}
/// Its unit in words: `mm^2`; empty without one. @param of_values unit of the array on the surface
std::string unit_of(const Measure& measure, const SeriesInfo& info, std::string_view of_values);

/// A connected piece of the surface (mesh_pieces.h).
struct MeasuredPiece {
    std::uint64_t cells = 0; ///< with a triangle of the piece
    std::uint64_t triangles = 0;
    double area = 0;
    /// What the piece encloses: positive if that is above, negative if it is below; NaN unless it is
    /// closed.
    double volume = 0;
    std::array<double, 3> low{}, high{}, centroid{}; ///< in physical space; weighted by areas
    std::array<double, 3> place{}; ///< on the piece: the middle of its largest triangle
    std::int64_t euler = 0;        ///< V - E + F of its mesh: 2 for a sphere
    bool closed = false;
};

struct MeasuredSurface {
    std::vector<double> values;        ///< in the order of `measures()`
    std::vector<MeasuredPiece> pieces; ///< if they are wished, the largest area first
};

/// What is measured besides the surface alone.
struct MeasureWishes {
    std::optional<std::size_t> array = std::nullopt; ///< an array on the surface (ColorSource)
    /// Measures the cells in this box alone, as if there were no others: a surface ends at its faces.
    std::optional<VertexBox> box = std::nullopt;
    /// Measures what this plane leaves: the surface, with an edge where it is cut and no cap; volumes
    /// on its side, exactly; vertices that are not beyond it.
    std::optional<CutPlane> clip = std::nullopt;
    /// The distance from this place, in physical space, to the surface is measured.
    std::optional<glm::dvec3> from = std::nullopt;
    bool pieces = false;
    /// Measures only the pieces that this keeps (with `surface` 0) of the surface in the box, before
    /// it is cut. From the volumes is taken what the others enclose, if these are closed; or else the
    /// volume is what the kept ones enclose, if those are closed around higher values. Else, and where
    /// something is cut, volumes are NaN; `bodies` is NaN.
    PieceFilter kept = {};
    /// Numbers of the measures that are wanted; the others are NaN. Empty: all.
    std::vector<std::size_t> only = {};
};

/// Measures surfaces of an open index. Not thread-safe: keeps its work space. Numbers are the same
/// bits whatever the number of threads.
class SurfaceMeasures {
  public:
    explicit SurfaceMeasures(std::shared_ptr<const IndexFile> file);

    /// @return nothing when stopped @throws Error as `mesh_of` does
    std::optional<MeasuredSurface> measure(const Query& query, const MeasureWishes& wishes = {},
                                           const std::stop_token& stop = {});

  private:
    std::shared_ptr<const IndexFile> file_;
    SurfaceMeshes meshes_;
    bool complete_; ///< no value of the series is missing or infinite
};

} // namespace isochron::index
