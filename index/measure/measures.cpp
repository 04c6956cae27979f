// The table of measures, and how a surface is measured.
#include "index/measure/measures.h"

#include "index/measure/measured_step.h"
#include "index/surface/triangle_distance.h"

#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace isochron::index {
namespace {

constexpr double kUndefined = std::numeric_limits<double>::quiet_NaN();

double area(MeasuredStep& step) {
    const std::vector<double>& areas = step.areas();
    return std::accumulate(areas.begin(), areas.end(), 0.0);
}

/// Number of edges of a mesh without a pair.
std::uint64_t border_edges(MeasuredStep& step) {
    const auto& edges = step.pieces().border_edges;
    return std::accumulate(edges.begin(), edges.end(), std::uint64_t{0});
}

/// V - E + F, where each edge has two triangles, or one at the border.
std::int64_t euler(std::uint64_t vertices, std::uint64_t triangles, std::uint64_t border) {
    return static_cast<std::int64_t>(vertices) -
           static_cast<std::int64_t>((3 * triangles + border) / 2) +
           static_cast<std::int64_t>(triangles);
}

/// The mean over the surface, weighted by areas, of the means at the corners of triangles.
double mean(MeasuredStep& step) {
    const std::span<const float> values = step.values();
    if (values.empty())
        return kUndefined;
    double sum = 0, all = 0;
    for (std::size_t i = 0; i < step.triangles(); ++i) {
        const auto at = [&](std::size_t k) {
            return static_cast<double>(values[step.corners()[3 * i + k]]);
        };
        const double value = (at(0) + at(1) + at(2)) / 3, weight = step.areas()[i];
        if (std::isfinite(value)) {
            sum += value * weight;
            all += weight;
        }
    }
    return sum / all;
}

/// The least value on the surface, or with `sign` -1 the greatest.
double extreme(MeasuredStep& step, double sign) {
    double found = kUndefined;
    if (step.values().empty())
        return found;
    for (const std::uint32_t corner : step.corners())
        if (const float value = step.values()[corner];
            !std::isnan(value) && !(found * sign <= value * sign))
            found = value;
    return found;
}

/// From the place that is asked for to the nearest point of the surface.
double distance(MeasuredStep& step) {
    if (!step.from() || step.triangles() == 0)
        return kUndefined;
    const glm::dvec3 from = *step.from() - step.grid().origin;
    const std::vector<glm::dvec3>& points = step.points();
    const std::span<const std::uint32_t> corners = step.corners();
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < corners.size(); i += 3)
        least = std::min(least, squared_distance(from, {points[corners[i]], points[corners[i + 1]],
                                                        points[corners[i + 2]]}));
    return std::sqrt(least);
}

std::vector<MeasuredPiece> measured_pieces(MeasuredStep& step) {
    const MeshPieces& pieces = step.pieces();
    const std::vector<glm::dvec3>&points = step.points(), &normals = step.normals();
    const std::span<const std::uint32_t> corners = step.corners();
    const glm::dvec3 origin = step.grid().origin;
    // Towards lower values, whichever way the grid's axes turn.
    const double outwards = glm::determinant(step.grid().direction) < 0 ? -1 : 1;
    struct Sums {
        glm::dvec3 low{std::numeric_limits<double>::infinity()},
            high{-std::numeric_limits<double>::infinity()}, weighted{0.0};
        std::uint64_t vertices = 0;
        double largest = -1; ///< area of the largest triangle
    };
    std::vector<MeasuredPiece> all(pieces.count);
    std::vector<Sums> sums(pieces.count);
    std::vector<bool> counted(points.size());
    for (std::size_t i = 0; i < step.triangles(); ++i) {
        const std::uint32_t number = pieces.of_triangle[i];
        MeasuredPiece& piece = all[number];
        Sums& sum = sums[number];
        glm::dvec3 middle(0.0);
        for (std::size_t k = 0; k < 3; ++k) {
            const std::uint32_t corner = corners[3 * i + k];
            const glm::dvec3& at = points[corner];
            middle += at / 3.0;
            sum.low = glm::min(sum.low, at);
            sum.high = glm::max(sum.high, at);
            sum.vertices += !counted[corner];
            counted[corner] = true;
        }
        if (step.areas()[i] > sum.largest) {
            sum.largest = step.areas()[i];
            for (int axis = 0; axis < 3; ++axis)
                piece.place[static_cast<std::size_t>(axis)] = origin[axis] + middle[axis];
        }
        ++piece.triangles;
        piece.area += step.areas()[i];
        piece.volume += outwards * glm::dot(normals[i], points[corners[3 * i]]) / 3;
        sum.weighted += step.areas()[i] * middle;
    }
    const std::vector<std::uint32_t> cells = step.cells_of_pieces();
    for (std::size_t i = 0; i < all.size(); ++i) {
        MeasuredPiece& piece = all[i];
        piece.cells = cells[i];
        const Sums& sum = sums[i];
        piece.closed = pieces.border_edges[i] == 0;
        if (!piece.closed)
            piece.volume = kUndefined;
        piece.euler = euler(sum.vertices, piece.triangles, pieces.border_edges[i]);
        // A piece of no area is a point.
        const glm::dvec3 centroid = piece.area > 0 ? sum.weighted / piece.area : sum.low;
        for (int axis = 0; axis < 3; ++axis) {
            const auto k = static_cast<std::size_t>(axis);
            piece.low[k] = origin[axis] + sum.low[axis];
            piece.high[k] = origin[axis] + sum.high[axis];
            piece.centroid[k] = origin[axis] + centroid[axis];
        }
    }
    std::ranges::stable_sort(all, std::greater{}, &MeasuredPiece::area);
    return all;
}

/// The volume above that goes with the pieces that are left out: what these enclose if all of them are
/// closed, or else all but what the kept ones enclose, if these are closed around higher values. Else NaN.
double left_out(MeasuredStep& step) {
    if (step.has_all_pieces())
        return 0;
    struct Closed {
        double volume = 0;
        std::size_t others = 0;
    };
    const auto closed = [](MeasuredStep& of) {
        Closed sum;
        for (const MeasuredPiece& piece : measured_pieces(of))
            if (piece.closed)
                sum.volume += piece.volume;
            else
                ++sum.others;
        return sum;
    };
    if (step.is_cut())
        return kUndefined;
    MeasuredStep whole = step.with_all_pieces();
    const Closed all = closed(whole), kept = closed(step);
    if (all.others == kept.others)
        return all.volume - kept.volume;
    return kept.others == 0 && kept.volume > 0 ? step.volumes().above - kept.volume : kUndefined;
}

constexpr std::array<Measure, 12> kMeasures{{
    {"cells", MeasureUnit::none, "active cells: least < isovalue <= greatest of the 8 vertices",
     [](MeasuredStep& step) { return static_cast<double>(step.cells()); }},
    {"area", MeasureUnit::area, "sum of the areas of the surface's triangles", area},
    {"volume", MeasureUnit::volume,
     "volume where the value is at least the isovalue, over the cells without a missing vertex",
     [](MeasuredStep& step) { return step.volumes().above - left_out(step); }},
    {"volume-below", MeasureUnit::volume,
     "volume where the value is less than the isovalue, over the same cells",
     [](MeasuredStep& step) { return step.volumes().below + left_out(step); }},
    {"pieces", MeasureUnit::none, "connected pieces of the surface: triangles joined by edges",
     [](MeasuredStep& step) { return static_cast<double>(step.pieces().count); }},
    {"bodies", MeasureUnit::none,
     "connected bodies: vertices of at least the isovalue, joined to their 6 neighbors",
     [](MeasuredStep& step) {
         return step.has_all_pieces() ? static_cast<double>(step.bodies()) : kUndefined;
     }},
    {"euler", MeasureUnit::none, "Euler number of the surface: vertices - edges + triangles",
     [](MeasuredStep& step) {
         return static_cast<double>(euler(step.vertices(), step.triangles(), border_edges(step)));
     }},
    {"border-edges", MeasureUnit::none,
     "edges of the surface that one triangle has: at the grid's border or a missing value; 0: "
     "closed",
     [](MeasuredStep& step) { return static_cast<double>(border_edges(step)); }},
    {"mean", MeasureUnit::value, "mean of the other array on the surface, weighted by area", mean},
    {"least", MeasureUnit::value, "least value of the other array at the surface's vertices",
     [](MeasuredStep& step) { return extreme(step, 1); }},
    {"greatest", MeasureUnit::value, "greatest value of the other array at the surface's vertices",
     [](MeasuredStep& step) { return extreme(step, -1); }},
    {"distance", MeasureUnit::distance, "distance from a place to the nearest point of the surface",
     distance},
}};

} // namespace

std::span<const Measure> measures() {
    return kMeasures;
}

std::string unit_of(const Measure& measure, const SeriesInfo& info, std::string_view of_values) {
    switch (measure.unit) {
    case MeasureUnit::none: break;
    case MeasureUnit::area: return info.length_unit.empty() ? "" : info.length_unit + "^2";
    case MeasureUnit::volume: return info.length_unit.empty() ? "" : info.length_unit + "^3";
    case MeasureUnit::value: return std::string(of_values);
    case MeasureUnit::distance: return info.length_unit;
    }
    return {};
}

SurfaceMeasures::SurfaceMeasures(std::shared_ptr<const IndexFile> file)
    : file_(file), meshes_(file), complete_(is_complete(*file)) {}

std::optional<MeasuredSurface> SurfaceMeasures::measure(const Query& query,
                                                        const MeasureWishes& wishes,
                                                        const std::stop_token& stop) {
    const auto mesh = meshes_.make_packed(query, {.values = wishes.array}, stop);
    if (!mesh)
        return std::nullopt;
    try {
        MeasuredStep step(*file_, query, *mesh, wishes.box, wishes.clip, wishes.kept, complete_,
                          stop);
        step.measure_from(wishes.from);
        MeasuredSurface found;
        for (std::size_t i = 0; i < kMeasures.size(); ++i) {
            const bool wanted =
                wishes.only.empty() || std::ranges::find(wishes.only, i) != wishes.only.end();
            found.values.push_back(wanted ? kMeasures[i].of(step) : kUndefined);
        }
        if (wishes.pieces)
            found.pieces = measured_pieces(step);
        return found;
    } catch (const Stopped&) {
        return std::nullopt;
    }
}

} // namespace isochron::index
