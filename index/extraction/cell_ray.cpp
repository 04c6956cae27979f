// Walks along a ray from cell to cell, and finds the roots of the trilinear value, which is a cubic
// along the ray.
#include "index/extraction/cell_ray.h"

#include "index/detail/detail_regions.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <limits>
#include <numeric>
#include <span>

namespace isochron::index {
namespace {

/// How far a root may be outside its cell's part of the ray, as a fraction of that part, so that a
/// root on a face is never lost by rounding.
constexpr double kSlack = 1e-9;

using CellCorners = std::array<float, 8>; ///< block units, x fastest

/// The vertices of an extraction's blocks.
class BlockVertices {
  public:
    BlockVertices(const VolumeBlocks& blocks, const Grid& grid) : blocks_(blocks), tiling_(grid) {}

    /// @return nothing if a block is missing: then the cell is not active
    std::optional<CellCorners> of_cell(const glm::ivec3& cell) {
        CellCorners corners;
        for (int corner = 0; corner < 8; ++corner) {
            const glm::ivec3 v = cell + glm::ivec3(corner & 1, corner >> 1 & 1, corner >> 2);
            if (!find(v / kEdge))
                return std::nullopt;
            const glm::ivec3 in = v % kEdge;
            corners[corner] = value((in.z * kEdge + in.y) * kEdge + in.x);
        }
        return corners;
    }

  private:
    static constexpr int kEdge = static_cast<int>(kBlockEdge);

    bool find(const glm::ivec3& block) {
        const auto id = static_cast<BlockId>(
            (block.z * tiling_.blocks[1] + block.y) * tiling_.blocks[0] + block.x);
        if (id != id_) {
            id_ = id;
            const auto found = std::ranges::lower_bound(blocks_.ids, id);
            const bool there = found != blocks_.ids.end() && *found == id;
            bytes_ = there ? blocks_.block(found - blocks_.ids.begin()).data() : nullptr;
        }
        return bytes_ != nullptr;
    }
    float value(int vertex) const {
        return visit_value_type(blocks_.held, [&]<class T>(std::type_identity<T>) {
            T held;
            std::memcpy(&held, bytes_ + vertex * sizeof held, sizeof held);
            return static_cast<float>(held) * blocks_.factor;
        });
    }

    const VolumeBlocks& blocks_;
    BlockTiling tiling_;
    std::optional<BlockId> id_; ///< the last block that was looked up
    const std::byte* bytes_ = nullptr;
};

bool is_active(const CellCorners& corners, float level) {
    bool below = false, above = false;
    for (const float value : corners) {
        if (std::isnan(value))
            return false;
        (value < level ? below : above) = true;
    }
    return below && above;
}

/// Value minus level along a part of the ray, as a cubic in s from 0 to 1: coefficients of 1, s,
/// s^2 and s^3.
using Cubic = std::array<double, 4>;

double value_at(const Cubic& k, double s) {
    return ((k[3] * s + k[2]) * s + k[1]) * s + k[0];
}

/// @param from, step start of the part and vector to its end, relative to the cell's lowest vertex
Cubic cubic_along(const CellCorners& corners, double level, const glm::dvec3& from,
                  const glm::dvec3& step) {
    // Interpolates along one axis after the other; each raises the degree by one.
    std::array<Cubic, 8> values{};
    for (int i = 0; i < 8; ++i)
        values[i][0] = static_cast<double>(corners[i]) - level;
    for (int axis = 0; axis < 3; ++axis)
        for (int i = 0; i < 4 >> axis; ++i) {
            const Cubic low = values[2 * i], high = values[2 * i + 1];
            Cubic& result = values[i];
            for (int power = 0; power < 4; ++power) {
                result[power] = low[power] + from[axis] * (high[power] - low[power]);
                if (power > 0)
                    result[power] += step[axis] * (high[power - 1] - low[power - 1]);
            }
        }
    return values[0];
}

/// The values of s from 0 to 1 at which the slope is 0, ascending.
std::vector<double> turning_points(const Cubic& k) {
    const double a = 3 * k[3], b = k[2], c = k[1]; // a s^2 + 2 b s + c
    const double d = b * b - a * c;
    std::vector<double> points;
    if (!(d > 0))
        return points;
    const double q = -(b + std::copysign(std::sqrt(d), b));
    for (const double s : {q / a, c / q})
        if (s > 0 && s < 1)
            points.push_back(s);
    std::ranges::sort(points);
    return points;
}

/// The first root at which the cubic changes its sign. It is monotonic between its turning points,
/// so the signs at these tell which interval has a root; bisection goes on to the limit of
/// precision.
std::optional<double> first_root(const Cubic& k) {
    std::vector<double> ends = turning_points(k);
    ends.push_back(1 + kSlack);
    double low = -kSlack;
    const bool above = value_at(k, low) >= 0;
    for (double high : ends) {
        if ((value_at(k, high) >= 0) == above) {
            low = high;
            continue;
        }
        for (;;) {
            const double middle = std::midpoint(low, high);
            if (!(middle > low && middle < high))
                return high;
            ((value_at(k, middle) >= 0) == above ? low : high) = middle;
        }
    }
    return std::nullopt;
}

/// A ray in even coordinates (`Grid::physical_from_index`).
struct EvenRay {
    glm::dvec3 origin, direction;
};

/// Visits the cells that a ray passes through, in order, with the part of the ray in each.
class CellRay {
  public:
    CellRay(const Grid& grid, const EvenRay& ray)
        : grid_(grid), origin_(ray.origin), direction_(ray.direction) {
        const auto cells = grid.cells();
        cells_ = glm::ivec3(cells[0], cells[1], cells[2]);
        const auto& [origin, direction] = ray;
        double leave = std::numeric_limits<double>::infinity();
        for (int axis = 0; axis < 3; ++axis) {
            const double far = plane(axis, cells_[axis]);
            if (direction[axis] == 0) {
                if (!(origin[axis] >= 0 && origin[axis] <= far))
                    leave = -1;
                continue;
            }
            const double a = -origin[axis] / direction[axis];
            const double b = (far - origin[axis]) / direction[axis];
            enter_ = std::max(enter_, std::min(a, b));
            leave = std::min(leave, std::max(a, b));
        }
        inside_ = enter_ <= leave;
        const glm::dvec3 start = origin + enter_ * direction;
        for (int axis = 0; axis < 3 && inside_; ++axis)
            cell_[axis] = std::clamp(
                static_cast<int>(std::floor(grid.index_at(axis, start[axis] * grid.spacing[axis]))),
                0, cells_[axis] - 1);
    }
    bool inside() const { return inside_; }
    const glm::ivec3& cell() const { return cell_; }
    double enter() const { return enter_; }
    double leave() const { return end_of(next_axis()); }
    /// The cell's lowest vertex.
    glm::dvec3 low() const { return {plane(0, cell_.x), plane(1, cell_.y), plane(2, cell_.z)}; }
    glm::dvec3 size() const {
        return grid_.even_size({static_cast<std::uint32_t>(cell_.x),
                                static_cast<std::uint32_t>(cell_.y),
                                static_cast<std::uint32_t>(cell_.z)});
    }

    void advance() {
        const int axis = next_axis();
        enter_ = std::max(enter_, end_of(axis));
        cell_[axis] += direction_[axis] > 0 ? 1 : -1;
        inside_ = cell_[axis] >= 0 && cell_[axis] < cells_[axis];
    }

  private:
    double plane(int axis, int vertex) const {
        return grid_.even_place(axis, static_cast<std::uint32_t>(vertex));
    }
    double end_of(int axis) const {
        if (direction_[axis] == 0)
            return std::numeric_limits<double>::infinity();
        return (plane(axis, cell_[axis] + (direction_[axis] > 0 ? 1 : 0)) - origin_[axis]) /
               direction_[axis];
    }
    int next_axis() const {
        const double x = end_of(0), y = end_of(1), z = end_of(2);
        return x <= y && x <= z ? 0 : y <= z ? 1 : 2;
    }

    const Grid& grid_;
    glm::dvec3 origin_, direction_;
    glm::ivec3 cells_{0}, cell_{0};
    double enter_ = 0;
    bool inside_ = false;
};

bool is_finite(const glm::dvec3& v) {
    return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

/// The ray in even coordinates; nothing if it is not finite or has length 0.
std::optional<EvenRay> in_even(const Grid& grid, const Ray& ray) {
    const glm::dmat4 index_from_physical = glm::inverse(grid.physical_from_index());
    const EvenRay result{glm::dvec3(index_from_physical * glm::dvec4(ray.origin, 1.0)),
                         glm::dvec3(index_from_physical * glm::dvec4(ray.direction, 0.0))};
    if (!is_finite(result.origin) || !is_finite(result.direction) ||
        result.direction == glm::dvec3(0.0))
        return std::nullopt;
    return result;
}

/// How far a cell's plane reaches beyond the cell, in cell sides: as far as drawn quads overlap.
constexpr double kBeyond = 0.3;

/// Hits the planes of cells of mixed levels.
class PlaneRay {
  public:
    PlaneRay(const Grid& grid, const EvenRay& ray)
        : grid_(grid), ray_(ray), even_(!grid.rectilinear()),
          even_from_normal_(glm::transpose(glm::dmat3(grid.physical_from_index()))) {}

    /// How far along the ray it hits the plane of a cell, or passes the middle of a cell that has
    /// no plane.
    std::optional<double> hit(const CellPoint& point) const {
        glm::dvec3 low, high;
        const std::array<std::uint32_t, 3> doubled{point.x, point.y, point.z};
        for (int axis = 0; axis < 3; ++axis) {
            const std::uint32_t at = doubled[static_cast<std::size_t>(axis)];
            const std::uint32_t size = 1u << level_of_center(at), first = (at - size) / 2;
            low[axis] = place(axis, first);
            high[axis] =
                place(axis, std::min(first + size, grid_.cells()[static_cast<std::size_t>(axis)]));
        }
        const glm::dvec3 middle = 0.5 * (low + high), sides = high - low;
        const glm::dvec3 to = middle - ray_.origin;
        const double length2 = glm::dot(ray_.direction, ray_.direction);
        const double nearest = glm::dot(to, ray_.direction) / length2;
        const glm::dvec3 beside = to - nearest * ray_.direction;
        const double reach = 0.5 + kBeyond;
        if (glm::dot(beside, beside) > reach * reach * glm::dot(sides, sides))
            return std::nullopt;
        const CellPlane plane = unpack_plane(point.plane);
        if (plane.normal == glm::dvec3(0.0))
            return glm::length(beside / sides) <= 0.5 ? std::optional(nearest) : std::nullopt;
        const glm::dvec3 n = glm::normalize(sides * (even_from_normal_ * plane.normal));
        const glm::dvec3 along = ray_.direction / sides;
        const double rate = glm::dot(n, along);
        if (rate == 0)
            return std::nullopt;
        const double t = (plane.offset + glm::dot(n, to / sides)) / rate;
        const glm::dvec3 at = glm::abs(t * along - to / sides);
        return std::max({at.x, at.y, at.z}) <= reach ? std::optional(t) : std::nullopt;
    }

  private:
    double place(int axis, std::uint32_t vertex) const {
        return even_ ? vertex : grid_.even_place(axis, vertex);
    }
    const Grid& grid_;
    const EvenRay& ray_;
    bool even_;
    glm::dmat3 even_from_normal_;
};

std::optional<RayHit> first_hit_of_levels(const Extraction& shown, const Grid& grid, const Ray& ray,
                                          const EvenRay& even, std::uint32_t surfaces) {
    const PlaneRay planes(grid, even);
    std::optional<RayHit> nearest;
    for (std::size_t i = 0; i < shown.surfaces.size(); ++i) {
        if (!(surfaces >> i & 1))
            continue;
        for (const CellPoint& point : shown.surfaces[i].points)
            if (const auto along = planes.hit(point);
                along && *along >= 0 && (!nearest || *along < nearest->along))
                nearest = RayHit{i, *along, ray.origin + *along * ray.direction};
    }
    return nearest;
}

/// Whether a ray may meet something in a box before `nearest`.
bool may_meet(const EvenRay& ray, const InstantSurfaces::Box& box, double nearest) {
    double enter = 0, leave = nearest;
    for (int axis = 0; axis < 3; ++axis) {
        const double low = box.low[axis] - ray.origin[axis],
                     high = box.high[axis] - ray.origin[axis];
        const double rate = ray.direction[axis];
        if (rate == 0) {
            if (low > 0 || high < 0)
                return false;
            continue;
        }
        enter = std::max(enter, std::min(low / rate, high / rate));
        leave = std::min(leave, std::max(low / rate, high / rate));
    }
    return enter <= leave;
}

/// How far along a ray it passes through a triangle (T. Möller and B. Trumbore, "Fast, Minimum Storage
/// Ray/Triangle Intersection", Journal of Graphics Tools 2 (1), 1997).
std::optional<double> along_to(const std::array<glm::dvec3, 3>& corners, const EvenRay& ray) {
    const glm::dvec3 a = corners[1] - corners[0], b = corners[2] - corners[0];
    const glm::dvec3 across = glm::cross(ray.direction, b), from = ray.origin - corners[0];
    const double volume = glm::dot(a, across);
    if (volume == 0)
        return std::nullopt;
    const glm::dvec3 turned = glm::cross(from, a);
    const double u = glm::dot(from, across) / volume, v = glm::dot(ray.direction, turned) / volume;
    const double along = glm::dot(b, turned) / volume;
    const bool inside = u >= -kSlack && v >= -kSlack && u + v <= 1 + kSlack && along >= 0;
    return inside ? std::optional(along) : std::nullopt;
}

} // namespace

std::optional<RayHit> first_hit(const InstantSurfaces& shown, const Grid& grid, const Ray& ray,
                                std::uint32_t surfaces) {
    const auto even = in_even(grid, ray);
    if (!even)
        return std::nullopt;
    std::optional<RayHit> nearest;
    const auto try_run = [&](std::size_t surface, std::span<const std::uint32_t> corners) {
        const CellMesh& mesh = *shown.meshes[surface];
        for (std::size_t i = 0; i < corners.size(); i += 3) {
            std::array<glm::dvec3, 3> places;
            for (std::size_t k = 0; k < 3; ++k)
                places[k] = even_place_of(grid, mesh.vertices[corners[i + k]]);
            if (const auto along = along_to(places, *even);
                along && (!nearest || *along < nearest->along))
                nearest = RayHit{surface, *along, ray.origin + *along * ray.direction};
        }
    };
    constexpr std::size_t kCorners = 3 * InstantSurfaces::kRun;
    for (std::size_t i = 0; i < shown.meshes.size(); ++i)
        for (std::size_t k = 0; (surfaces >> i & 1) && k < shown.boxes[i].size(); ++k) {
            const std::span<const std::uint32_t> all(shown.meshes[i]->triangles);
            const double so_far =
                nearest ? nearest->along : std::numeric_limits<double>::infinity();
            if (may_meet(*even, shown.boxes[i][k], so_far))
                try_run(i,
                        all.subspan(kCorners * k, std::min(kCorners, all.size() - kCorners * k)));
        }
    return nearest;
}

std::optional<RayHit> first_hit(const Extraction& shown, const Grid& grid, const Ray& ray,
                                std::uint32_t surfaces) {
    const auto indexed = in_even(grid, ray);
    if (!indexed)
        return std::nullopt;
    if (shown.coarse())
        return first_hit_of_levels(shown, grid, ray, *indexed, surfaces);
    const auto& [origin, direction] = *indexed;
    BlockVertices vertices(shown.blocks, grid);
    for (CellRay at(grid, *indexed); at.inside(); at.advance()) {
        const auto corners = vertices.of_cell(at.cell());
        if (!corners)
            continue;
        const double length = at.leave() - at.enter();
        const glm::dvec3 size = at.size();
        const glm::dvec3 from = (origin + at.enter() * direction - at.low()) / size;
        std::optional<RayHit> nearest;
        for (std::size_t i = 0; i < shown.levels.size(); ++i) {
            const bool counts = (surfaces >> i & 1) && std::isfinite(shown.query.isovalues[i]);
            if (!counts || !is_active(*corners, shown.levels[i]))
                continue;
            const auto s =
                first_root(cubic_along(*corners, shown.levels[i], from, length * direction / size));
            const double along = at.enter() + length * s.value_or(0.0);
            if (s && along >= 0 && (!nearest || along < nearest->along))
                nearest = RayHit{i, along, ray.origin + along * ray.direction};
        }
        if (nearest)
            return nearest;
    }
    return std::nullopt;
}

std::optional<glm::dvec3> entry_into(const Grid& grid, const Ray& ray) {
    const auto indexed = in_even(grid, ray);
    if (!indexed)
        return std::nullopt;
    const CellRay first(grid, *indexed);
    if (!first.inside())
        return std::nullopt;
    return ray.origin + first.enter() * ray.direction;
}

} // namespace isochron::index
