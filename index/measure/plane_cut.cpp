// Cuts triangles and polygons at a plane.
#include "index/measure/plane_cut.h"

#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <unordered_map>

namespace isochron::index {
namespace {

/// The new points of cut sides, by the side's ends.
class CutSides {
  public:
    CutSides(CutSurface& surface, std::span<const double> beyond)
        : surface_(surface), beyond_(beyond) {}

    std::uint32_t between(std::uint32_t a, std::uint32_t b) {
        const auto [low, high] = std::minmax(a, b);
        const auto number = static_cast<std::uint32_t>(surface_.points.size());
        const auto [place, is_new] = made_.try_emplace(std::uint64_t{low} << 32 | high, number);
        if (is_new) {
            const double share = beyond_[low] / (beyond_[low] - beyond_[high]);
            surface_.points.push_back(surface_.points[low] +
                                      share * (surface_.points[high] - surface_.points[low]));
            if (!surface_.values.empty())
                surface_.values.push_back(static_cast<float>(
                    std::lerp(static_cast<double>(surface_.values[low]),
                              static_cast<double>(surface_.values[high]), share)));
        }
        return place->second;
    }

  private:
    CutSurface& surface_;
    std::span<const double> beyond_;
    std::unordered_map<std::uint64_t, std::uint32_t> made_;
};

} // namespace

PlaneCut::PlaneCut(const CutPlane& plane, const Grid& grid)
    : normal_(plane.normal), along_(glm::transpose(grid.direction) * plane.normal),
      start_(glm::dot(grid.origin - plane.point, plane.normal)) {}

bool PlaneCut::leaves_plane() const {
    for (const double part : {normal_.x, normal_.y, normal_.z})
        if (part != 0)
            return part > 0;
    return false;
}

double PlaneCut::beyond_physical(const glm::dvec3& at) const {
    return start_ + glm::dot(at, normal_);
}

CutSurface cut(std::span<const glm::dvec3> points, std::span<const float> values,
               std::span<const std::uint32_t> corners, std::span<const double> beyond,
               std::span<const std::uint8_t> triangles, bool leaves_plane) {
    CutSurface left{.points = {points.begin(), points.end()},
                    .values = {values.begin(), values.end()},
                    .corners = {},
                    .triangles = {}};
    CutSides sides(left, beyond);
    std::size_t next = 0;
    for (const std::uint8_t count : triangles) {
        const std::size_t before = left.corners.size();
        for (std::size_t i = 0; i < count; ++i, next += 3) {
            std::array<std::uint32_t, 4> polygon{};
            std::size_t size = 0;
            bool within = false, in_plane = true;
            for (std::size_t k = 0; k < 3; ++k) {
                const std::uint32_t a = corners[next + k], b = corners[next + (k + 1) % 3];
                within |= beyond[a] < 0;
                in_plane &= beyond[a] == 0;
                if (beyond[a] <= 0)
                    polygon[size++] = a;
                if ((beyond[a] < 0 && beyond[b] > 0) || (beyond[a] > 0 && beyond[b] < 0))
                    polygon[size++] = sides.between(a, b);
            }
            if (!within && !(in_plane && leaves_plane))
                continue;
            for (std::size_t k = 2; k < size; ++k)
                left.corners.insert(left.corners.end(), {polygon[0], polygon[k - 1], polygon[k]});
        }
        if (const std::size_t added = left.corners.size() - before; added > 0)
            left.triangles.push_back(static_cast<std::uint8_t>(added / 3));
    }
    std::vector<bool> used(left.points.size());
    for (const std::uint32_t corner : left.corners)
        used[corner] = true;
    left.vertices = static_cast<std::uint64_t>(std::ranges::count(used, true));
    return left;
}

bool CellCut::leaves_all() const {
    double most = start;
    for (const double each : along)
        most += std::max(each, 0.0);
    return most <= 0;
}

bool CellCut::leaves_nothing() const {
    double least = start;
    for (const double each : along)
        least += std::min(each, 0.0);
    return least >= 0;
}

double flow_through(std::span<const std::array<double, 3>> polygon, const CellCut& plane,
                    std::size_t axis) {
    std::vector<std::array<double, 3>> left;
    left.reserve(2 * polygon.size());
    for (std::size_t k = 0; k < polygon.size(); ++k) {
        const auto &a = polygon[k], &b = polygon[(k + 1) % polygon.size()];
        const double at_a = plane.beyond(a), at_b = plane.beyond(b);
        if (at_a <= 0)
            left.push_back(a);
        if ((at_a < 0 && at_b > 0) || (at_a > 0 && at_b < 0)) {
            const double share = at_a / (at_a - at_b);
            left.push_back({std::lerp(a[0], b[0], share), std::lerp(a[1], b[1], share),
                            std::lerp(a[2], b[2], share)});
        }
    }
    const std::size_t u = (axis + 1) % 3, v = (axis + 2) % 3;
    double flow = 0;
    for (std::size_t k = 2; k < left.size(); ++k) {
        const auto &a = left[0], &b = left[k - 1], &c = left[k];
        const double twice = (b[u] - a[u]) * (c[v] - a[v]) - (b[v] - a[v]) * (c[u] - a[u]);
        flow += twice / 6 * (plane.beyond(a) + plane.beyond(b) + plane.beyond(c));
    }
    return flow / plane.along[axis];
}

} // namespace isochron::index
