// Joins the ends of edges in the order of their quadric errors.
#include "index/export/edge_collapse.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <numeric>
#include <queue>
#include <tuple>
#include <unordered_map>
#include <utility>

namespace isochron::index {
namespace {

constexpr std::uint32_t kNothing = std::numeric_limits<std::uint32_t>::max();

/// Sum of weighted squares of distances to planes.
struct PlaneSum {
    std::array<double, 6> products{}; ///< xx, xy, xz, yy, yz, zz
    glm::dvec3 linear{0.0};
    double constant = 0, weight = 0;

    void add(const glm::dvec3& normal, const glm::dvec3& at, double more) {
        const double distance = -glm::dot(normal, at);
        std::size_t next = 0;
        for (int row = 0; row < 3; ++row)
            for (int column = row; column < 3; ++column)
                products[next++] += more * normal[row] * normal[column];
        linear += more * distance * normal;
        constant += more * distance * distance;
        weight += more;
    }
    void add(const PlaneSum& other) {
        for (std::size_t i = 0; i < products.size(); ++i)
            products[i] += other.products[i];
        linear += other.linear;
        constant += other.constant;
        weight += other.weight;
    }
    /// The mean square of the distances.
    double at(const glm::dvec3& p) const {
        if (!(weight > 0))
            return 0;
        const double sum = products[0] * p.x * p.x + products[3] * p.y * p.y +
                           products[5] * p.z * p.z +
                           2 * (products[1] * p.x * p.y + products[2] * p.x * p.z +
                                products[4] * p.y * p.z + glm::dot(linear, p)) +
                           constant;
        return std::max(sum, 0.0) / weight;
    }
};

class EdgeCollapse {
  public:
    EdgeCollapse(PlainMesh& mesh, std::span<const double> most)
        : mesh_(mesh), places_(mesh.points),
          outside_(static_cast<std::uint32_t>(mesh.points.size())) {
        triangles_ = mesh.triangles;
        close_borders();
        first_corner_.assign(places_.size() + 1, kNothing);
        next_corner_.resize(3 * triangles_.size());
        for (std::uint32_t corner = 0; corner < next_corner_.size(); ++corner)
            next_corner_[corner] =
                std::exchange(first_corner_[triangles_[corner / 3][corner % 3]], corner);
        sums_.resize(places_.size());
        changes_.resize(places_.size());
        removed_.resize(places_.size());
        marks_.resize(places_.size() + 1);
        find_twins();
        add_planes();
        add_samples(most);
    }

    void run(const std::function<void()>& look) {
        for (const auto& triangle : triangles_)
            for (std::size_t i = 0; i < 3; ++i)
                put(triangle[i], triangle[(i + 1) % 3]);
        for (std::size_t done = 0; !waiting_.empty(); ++done) {
            if (look && done % 1024 == 0)
                look();
            const Candidate next = waiting_.top();
            waiting_.pop();
            if (!removed_[next.from] && !removed_[next.to] &&
                changes_[next.from] + changes_[next.to] == next.changes)
                collapse(next.from, next.to);
        }
        mesh_.triangles.clear();
        for (const auto& triangle : triangles_)
            if (triangle[0] != kNothing && !is_cone(triangle))
                mesh_.triangles.push_back(triangle);
    }

  private:
    using Triangle = std::array<std::uint32_t, 3>;
    /// A point that may go, and where to.
    struct Candidate {
        float error;
        std::uint32_t from, to, changes;
        bool operator<(const Candidate& other) const { // the top of a queue is its greatest
            return std::tie(error, from, to) > std::tie(other.error, other.from, other.to);
        }
    };

    /// A triangle to a point outside of the mesh on each edge of a border, so that borders are what
    /// all else is.
    void close_borders() {
        std::unordered_map<std::uint64_t, int> edges; // one way less the other way
        edges.reserve(3 * triangles_.size());
        const auto key = [](std::uint64_t from, std::uint64_t to) { return from << 32 | to; };
        for (const Triangle& at : mesh_.triangles)
            for (std::size_t i = 0; i < 3; ++i) {
                ++edges[key(at[i], at[(i + 1) % 3])];
                --edges[key(at[(i + 1) % 3], at[i])];
            }
        for (const Triangle& at : mesh_.triangles)
            for (std::size_t i = 0; i < 3; ++i)
                if (edges[key(at[i], at[(i + 1) % 3])] > 0)
                    triangles_.push_back({at[(i + 1) % 3], at[i], outside_});
    }
    /// Points that lie in one place, as where the surface meets itself in a vertex of the grid.
    void find_twins() {
        std::vector<std::uint32_t> order(places_.size());
        std::iota(order.begin(), order.end(), 0u);
        const auto key = [&](std::uint32_t i) {
            return std::tuple(places_[i].x, places_[i].y, places_[i].z, i);
        };
        std::ranges::sort(order, {}, key);
        first_twin_.resize(places_.size());
        next_twin_.assign(places_.size(), kNothing);
        for (std::size_t i = 0; i < order.size(); ++i) {
            const bool again = i > 0 && places_[order[i]] == places_[order[i - 1]];
            first_twin_[order[i]] = again ? first_twin_[order[i - 1]] : order[i];
            if (again)
                next_twin_[order[i - 1]] = order[i];
        }
    }
    bool has_twin(std::uint32_t point) const {
        return first_twin_[point] != point || next_twin_[point] != kNothing;
    }
    /// Whether points in the places of these two are the ends of an edge.
    bool has_edge_between_places(std::uint32_t one, std::uint32_t other) const {
        bool found = false;
        for (std::uint32_t twin = first_twin_[one]; twin != kNothing; twin = next_twin_[twin])
            each_triangle(twin, [&](std::uint32_t, const Triangle& at) {
                for (const std::uint32_t corner : at)
                    found =
                        found || (corner != outside_ && first_twin_[corner] == first_twin_[other]);
            });
        return found;
    }
    bool is_cone(const Triangle& at) const {
        return at[0] == outside_ || at[1] == outside_ || at[2] == outside_;
    }
    glm::dvec3 cross_of(const Triangle& at) const {
        return glm::cross(places_[at[1]] - places_[at[0]], places_[at[2]] - places_[at[0]]);
    }

    void add_planes() {
        for (std::size_t i = 0; i < mesh_.triangles.size(); ++i) {
            const glm::dvec3 cross = cross_of(triangles_[i]);
            const double area = glm::length(cross);
            if (area > 0)
                for (const std::uint32_t corner : triangles_[i])
                    sums_[corner].add(cross / area, places_[corner], area);
        }
        // Across each edge of a border, so that borders keep their course.
        for (std::size_t i = mesh_.triangles.size(); i < triangles_.size(); ++i) {
            const auto [to, from, out] = triangles_[i];
            const glm::dvec3 along = places_[to] - places_[from];
            each_triangle(from, [&](std::uint32_t, const Triangle& at) {
                const auto end = std::ranges::find(at, to);
                if (is_cone(at) || end == at.end())
                    return;
                const glm::dvec3 across = glm::cross(along, cross_of(at));
                const double length = glm::length(across);
                if (length > 0)
                    for (const std::uint32_t corner : {to, from})
                        sums_[corner].add(across / length, places_[corner], glm::dot(along, along));
            });
        }
    }

    /// Calls `use(number, triangle)` with each triangle around a point.
    template <class Use>
    void each_triangle(std::uint32_t point, const Use& use) const {
        for (std::uint32_t corner = first_corner_[point]; corner != kNothing;
             corner = next_corner_[corner])
            if (triangles_[corner / 3][corner % 3] == point)
                use(corner / 3, triangles_[corner / 3]);
    }

    /// The points, and the middles of the edges, which tell where an edge runs across others.
    void add_samples(std::span<const double> most) {
        samples_ = places_;
        limits_.assign(most.begin(), most.end());
        first_sample_.assign(triangles_.size(), kNothing);
        next_sample_.assign(places_.size(), kNothing);
        for (std::uint32_t number = 0; number < mesh_.triangles.size(); ++number)
            for (std::size_t i = 0; i < 3; ++i) {
                const std::uint32_t from = triangles_[number][i],
                                    to = triangles_[number][(i + 1) % 3];
                if (from > to) // the other triangle at this edge has it
                    continue;
                next_sample_.push_back(std::exchange(first_sample_[number],
                                                     static_cast<std::uint32_t>(samples_.size())));
                samples_.push_back((places_[from] + places_[to]) / 2.0);
                limits_.push_back(std::min(most[from], most[to]));
            }
        for (double& limit : limits_)
            limit *= limit;
    }

    void put(std::uint32_t from, std::uint32_t to) {
        if (from == outside_ || to == outside_)
            return;
        const double error = sums_[from].at(places_[to]);
        if (error <= limits_[from])
            waiting_.push({static_cast<float>(error), from, to, changes_[from] + changes_[to]});
    }

    /// Gathers the triangles around `from` into around_, in their order: each begins with `from` and
    /// has the last point of the one before it as its second. @return false: they are no single fan
    bool gather(std::uint32_t from) {
        around_.clear();
        each_triangle(from, [&](std::uint32_t number, const Triangle& at) {
            const std::size_t own =
                static_cast<std::size_t>(std::ranges::find(at, from) - at.begin());
            around_.push_back({number, at[(own + 1) % 3], at[(own + 2) % 3]});
        });
        for (std::size_t i = 1; i < around_.size(); ++i) {
            const auto next = std::find_if(
                around_.begin() + static_cast<std::ptrdiff_t>(i), around_.end(),
                [&](const Around& each) { return each.second == around_[i - 1].third; });
            if (next == around_.end())
                return false;
            std::swap(around_[i], *next);
        }
        const std::uint32_t mark = ++mark_; // no edge has more than two triangles
        return around_.size() >= 3 && around_.back().third == around_.front().second &&
               std::ranges::all_of(around_, [&](const Around& each) {
                   return std::exchange(marks_[each.second], mark) != mark;
               });
    }

    /// Whether all stays connected as it is if `from` becomes `to`. Needs around_.
    bool keeps_links(std::uint32_t from, std::uint32_t to) {
        const std::uint32_t mark = ++mark_;
        std::array<std::uint32_t, 2> sides{kNothing, kNothing}; // the third points of the edge
        for (const Around& each : around_) {
            if (each.second == to)
                sides[0] = each.third;
            if (each.third == to)
                sides[1] = each.second;
        }
        if (sides[0] == kNothing || sides[1] == kNothing || sides[0] == sides[1])
            return false;
        bool other_side = false; // both points and the sides are a tetrahedron
        each_triangle(to, [&](std::uint32_t, const Triangle& at) {
            bool both = true;
            for (const std::uint32_t corner : at) {
                marks_[corner] = mark;
                both = both && (corner == to || corner == sides[0] || corner == sides[1]);
            }
            other_side = other_side || both;
        });
        marks_[to] = 0;
        if (around_.size() == 3 && other_side)
            return false;
        std::size_t common = 0;
        for (const Around& each : around_) {
            if (each.second != to && each.second != outside_ &&
                first_twin_[from] != first_twin_[to] &&
                first_twin_[each.second] == first_twin_[from])
                return false; // twins that share an edge become one first
            if (marks_[each.second] == mark)
                ++common;
            else if (each.second != to && each.second != outside_ &&
                     first_twin_[from] != first_twin_[to] &&
                     (has_twin(to) || has_twin(each.second)) &&
                     has_edge_between_places(to, each.second))
                return false; // two edges would lie in one place
        }
        return common == 2;
    }

    /// Whether no triangle turns over if `from` becomes `to`. Needs around_.
    bool keeps_sides(std::uint32_t from, std::uint32_t to) const {
        constexpr double kLeast = 0.2; // cosine of the angle by which one may turn
        return std::ranges::all_of(around_, [&](const Around& each) {
            if (each.second == to || each.third == to || each.second == outside_ ||
                each.third == outside_)
                return true;
            const glm::dvec3 before = cross_of({from, each.second, each.third});
            const glm::dvec3 after = cross_of({to, each.second, each.third});
            const double was = glm::length(before), is = glm::length(after);
            return was == 0 || (is > 0 && glm::dot(before, after) >= kLeast * was * is);
        });
    }

    /// Finds which triangle is nearest to each sample around `from`, into moves_, if `from` becomes `to`. @return false: one lies farther away than it may. Needs around_.
    bool keeps_points(std::uint32_t from, std::uint32_t to) {
        taking_.clear();
        for (const Around& each : around_)
            if (each.second != to && each.third != to && each.second != outside_ &&
                each.third != outside_)
                taking_.emplace_back(each.number, std::array{places_[to], places_[each.second],
                                                             places_[each.third]});
        if (taking_.empty()) // an ear of a border
            each_triangle(to, [&](std::uint32_t number, const Triangle& at) {
                if (!is_cone(at) && std::ranges::find(at, from) == at.end())
                    taking_.emplace_back(
                        number, std::array{places_[at[0]], places_[at[1]], places_[at[2]]});
            });
        moves_.clear();
        const auto fits = [&](std::uint32_t sample) {
            double least = std::numeric_limits<double>::infinity();
            std::uint32_t nearest = kNothing;
            for (const auto& [number, corners] : taking_) {
                const double squared = squared_distance(samples_[sample], corners);
                if (squared < least) {
                    least = squared;
                    nearest = number;
                }
            }
            moves_.emplace_back(sample, nearest);
            return least <= limits_[sample];
        };
        if (!fits(from))
            return false;
        for (const Around& each : around_)
            for (std::uint32_t sample = first_sample_[each.number]; sample != kNothing;
                 sample = next_sample_[sample])
                if (!fits(sample))
                    return false;
        return true;
    }

    void collapse(std::uint32_t from, std::uint32_t to) {
        if (!gather(from) || !keeps_links(from, to) || !keeps_sides(from, to) ||
            !keeps_points(from, to))
            return;
        for (const Around& each : around_) {
            first_sample_[each.number] = kNothing;
            if (each.second == to || each.third == to)
                triangles_[each.number] = {kNothing, kNothing, kNothing};
            else
                std::ranges::replace(triangles_[each.number], from, to);
        }
        for (const auto& [sample, triangle] : moves_)
            next_sample_[sample] = std::exchange(first_sample_[triangle], sample);
        std::uint32_t* last = &first_corner_[from]; // what was around `from` is around `to`
        while (*last != kNothing) {
            if (triangles_[*last / 3][*last % 3] == to)
                last = &next_corner_[*last];
            else
                *last = next_corner_[*last];
        }
        *last = std::exchange(first_corner_[to], first_corner_[from]);
        removed_[from] = true;
        sums_[to].add(sums_[from]);
        ++changes_[to];
        const std::uint32_t mark = ++mark_;
        each_triangle(to, [&](std::uint32_t, const Triangle& at) {
            for (const std::uint32_t corner : at)
                if (corner != to && std::exchange(marks_[corner], mark) != mark) {
                    put(corner, to);
                    put(to, corner);
                }
        });
    }

    PlainMesh& mesh_;
    const std::vector<glm::dvec3>& places_;
    std::uint32_t outside_; ///< point that closes borders
    std::vector<Triangle> triangles_;
    std::vector<std::uint32_t> first_corner_,
        next_corner_; ///< by point, by corner: lists around points
    std::vector<std::uint32_t> first_twin_, next_twin_; ///< by point: lists of those in its place
    std::vector<PlaneSum> sums_;
    std::vector<std::uint32_t> changes_; ///< by point
    std::vector<bool> removed_;
    std::vector<glm::dvec3> samples_;
    std::vector<double> limits_; ///< squares of distances, by sample
    std::vector<std::uint32_t> first_sample_,
        next_sample_; ///< by triangle, by sample: lists of those near
    std::priority_queue<Candidate> waiting_;

    struct Around {
        std::uint32_t number, second, third;
    };
    std::vector<Around> around_;
    std::vector<std::pair<std::uint32_t, std::array<glm::dvec3, 3>>> taking_;
    std::vector<std::pair<std::uint32_t, std::uint32_t>> moves_; ///< sample, triangle
    std::vector<std::uint32_t> marks_;                           ///< by point
    std::uint32_t mark_ = 0;
};

} // namespace

void collapse_edges(PlainMesh& mesh, std::span<const double> most,
                    const std::function<void()>& look) {
    EdgeCollapse(mesh, most).run(look);
}

} // namespace isochron::index
