// Bounds of the distance between two meshes.
#include "index/export/mesh_distance.h"

#include "index/system/parallel.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace isochron::index {
namespace {

constexpr std::uint32_t kLeafTriangles = 4;
constexpr std::size_t kAtOnce =
    2048;                     ///< triangles or points that one thread takes: always the same ones
constexpr int kMostCuts = 64; ///< pieces of a triangle, one within another; bounds hold with any number
constexpr double kApart = 1.05, kNearlySame = 1.01; ///< upper over lower bound

double squared(const glm::dvec3& v) {
    return glm::dot(v, v);
}

double squared_to_box(const glm::dvec3& point, const glm::dvec3& low, const glm::dvec3& high) {
    return squared(glm::max(glm::max(low - point, point - high), glm::dvec3(0.0)));
}

/// A part of a triangle, with what is nearest to its corners.
struct CutPiece {
    std::array<glm::dvec3, 3> corners;
    std::array<NearestTriangle::Found, 3> nearest;
    int cuts = 0;
};

/// No point of the piece lies farther away than this.
double farthest_of(const CutPiece& piece, const PlainMesh& other) {
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t of = 0; of < 3; ++of) {
        const auto triangle = other.corners(piece.nearest[of].triangle);
        double most = 0, reach = 0;
        for (std::size_t at = 0; at < 3; ++at) {
            most = std::max(most, at == of ? piece.nearest[of].squared
                                           : squared_distance(piece.corners[at], triangle));
            reach = std::max(reach, squared(piece.corners[at] - piece.corners[of]));
        }
        least = std::min(
            {least, std::sqrt(most), std::sqrt(piece.nearest[of].squared) + std::sqrt(reach)});
    }
    return least;
}

/// An edge of the piece and where to cut it: where the nearest triangle changes, so that each half may
/// have one alone.
std::pair<std::size_t, double> cut_of(const CutPiece& piece, const PlainMesh& other) {
    std::size_t longest = 0, mixed = 3;
    std::array<double, 3> lengths{};
    for (std::size_t i = 0; i < 3; ++i) {
        const std::size_t j = (i + 1) % 3;
        lengths[i] = squared(piece.corners[j] - piece.corners[i]);
        if (lengths[i] > lengths[longest])
            longest = i;
        if (piece.nearest[i].triangle != piece.nearest[j].triangle &&
            (mixed == 3 || lengths[i] > lengths[mixed]))
            mixed = i;
    }
    if (mixed == 3 || piece.cuts % 3 == 2) // shrinks whatever is nearest
        return {longest, 0.5};
    const std::size_t end = (mixed + 1) % 3;
    const auto here = other.corners(piece.nearest[mixed].triangle);
    const auto there = other.corners(piece.nearest[end].triangle);
    double low = 0, high = 1;
    for (int i = 0; i < 8; ++i) {
        const double middle = (low + high) / 2;
        const glm::dvec3 at = glm::mix(piece.corners[mixed], piece.corners[end], middle);
        (squared_distance(at, here) < squared_distance(at, there) ? low : high) = middle;
    }
    return {mixed, std::clamp((low + high) / 2, 0.05, 0.95)};
}

/// Bounds of one triangle. @param bounds its lower one says what pieces need not be looked at
void measure(const CutPiece& whole, const NearestTriangle& other, const DistanceWishes& wishes,
             FarthestPoint& bounds, std::vector<CutPiece>& waiting) {
    for (const NearestTriangle::Found& found : whole.nearest)
        if (std::sqrt(found.squared) > wishes.most)
            bounds.nearest.push_back(found.triangle);
    waiting.assign(1, whole);
    while (!waiting.empty() && bounds.nearest.empty()) {
        CutPiece piece = waiting.back();
        waiting.pop_back();
        const double most = farthest_of(piece, other.mesh());
        if (most <= std::max({kApart * bounds.lower > wishes.most ? kNearlySame * bounds.lower
                                                                  : kApart * bounds.lower,
                              wishes.negligible}) ||
            piece.cuts >= kMostCuts) {
            bounds.upper = std::max(bounds.upper, most);
            if (most > wishes.most)
                bounds.nearest.push_back(piece.nearest[0].triangle);
            continue;
        }
        const auto [edge, share] = cut_of(piece, other.mesh());
        const std::size_t end = (edge + 1) % 3;
        const glm::dvec3 at = glm::mix(piece.corners[edge], piece.corners[end], share);
        const auto found = other.find(at, piece.nearest[share < 0.5 ? edge : end].triangle);
        bounds.lower = std::max(bounds.lower, std::sqrt(found.squared));
        if (bounds.lower > wishes.most)
            bounds.nearest.push_back(found.triangle);
        ++piece.cuts;
        CutPiece& rest = waiting.emplace_back(piece);
        rest.corners[edge] = at;
        rest.nearest[edge] = found;
        piece.corners[end] = at;
        piece.nearest[end] = found;
        waiting.push_back(piece);
    }
}

} // namespace

NearestTriangle::NearestTriangle(const PlainMesh& mesh) : mesh_(mesh) {
    order_.resize(mesh.triangles.size());
    std::iota(order_.begin(), order_.end(), 0u);
    std::vector<glm::dvec3> middles(order_.size());
    for (std::size_t i = 0; i < middles.size(); ++i) {
        const auto [a, b, c] = mesh.corners(i);
        middles[i] = (a + b + c) / 3.0;
    }
    nodes_.reserve(order_.size());
    build(0, static_cast<std::uint32_t>(order_.size()), middles);
}

void NearestTriangle::build(std::uint32_t first, std::uint32_t end,
                            const std::vector<glm::dvec3>& middles) {
    const std::size_t own = nodes_.size();
    constexpr double kInfinite = std::numeric_limits<double>::infinity();
    glm::dvec3 low(kInfinite), high(-kInfinite), first_middle(kInfinite), last_middle(-kInfinite);
    for (std::uint32_t i = first; i < end; ++i) {
        for (const glm::dvec3& corner : mesh_.corners(order_[i])) {
            low = glm::min(low, corner);
            high = glm::max(high, corner);
        }
        first_middle = glm::min(first_middle, middles[order_[i]]);
        last_middle = glm::max(last_middle, middles[order_[i]]);
    }
    nodes_.push_back({low, high, first, end - first});
    if (end - first <= kLeafTriangles)
        return;
    const glm::dvec3 size = last_middle - first_middle;
    const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
    const std::uint32_t middle = first + (end - first) / 2;
    std::nth_element(order_.begin() + first, order_.begin() + middle, order_.begin() + end,
                     [&](std::uint32_t a, std::uint32_t b) {
                         return std::pair(middles[a][axis], a) < std::pair(middles[b][axis], b);
                     });
    build(first, middle, middles);
    nodes_[own].first = static_cast<std::uint32_t>(nodes_.size());
    nodes_[own].count = 0;
    build(middle, end, middles);
}

double NearestTriangle::rounding() const {
    constexpr double kShare = 1e-12;
    const auto& [low, high, first, count] = nodes_.front();
    return kShare * glm::length(glm::max(glm::abs(low), glm::abs(high)));
}

NearestTriangle::Found NearestTriangle::find(const glm::dvec3& point, std::uint32_t hint) const {
    Found found{hint, squared_distance(point, mesh_.corners(hint))};
    struct Waiting {
        std::uint32_t node;
        double squared;
    };
    std::array<Waiting, 64> stack; // a balanced tree of at most 2^32 triangles
    std::size_t size = 0;
    stack[size++] = {0, squared_to_box(point, nodes_[0].low, nodes_[0].high)};
    while (size > 0) {
        const Waiting next = stack[--size];
        if (next.squared >= found.squared)
            continue;
        const Node& node = nodes_[next.node];
        for (std::uint32_t i = node.first; i < node.first + node.count; ++i) {
            const double squared = squared_distance(point, mesh_.corners(order_[i]));
            if (squared < found.squared)
                found = {order_[i], squared};
        }
        if (node.count > 0)
            continue;
        Waiting near{next.node + 1, 0}, far{node.first, 0};
        near.squared = squared_to_box(point, nodes_[near.node].low, nodes_[near.node].high);
        far.squared = squared_to_box(point, nodes_[far.node].low, nodes_[far.node].high);
        if (far.squared < near.squared)
            std::swap(near, far);
        stack[size++] = far;
        stack[size++] = near;
    }
    return found;
}

FarthestPoint farthest_from(const PlainMesh& mesh, const NearestTriangle& other,
                            const DistanceWishes& wishes, const std::function<void(double)>& look) {
    const std::size_t points = mesh.points.size(), triangles = mesh.triangles.size();
    const auto parts = [](std::size_t count) { return (count + kAtOnce - 1) / kAtOnce; };
    std::vector<NearestTriangle::Found> nearest(points);
    std::vector<double> lowest(parts(points));
    std::vector<bool> used(points);
    for (const auto& triangle : mesh.triangles)
        for (const std::uint32_t corner : triangle)
            used[corner] = true;
    parallel_for(
        lowest.size(), 0,
        [&](std::size_t part, unsigned) {
            std::uint32_t hint = 0;
            for (std::size_t i = part * kAtOnce; i < std::min(points, (part + 1) * kAtOnce); ++i) {
                if (!used[i])
                    continue;
                nearest[i] = other.find(mesh.points[i], hint);
                hint = nearest[i].triangle;
                if (const double distance = std::sqrt(nearest[i].squared); distance <= wishes.most)
                    lowest[part] = std::max(lowest[part], distance);
            }
        },
        look);
    const double known = std::accumulate(lowest.begin(), lowest.end(), wishes.known,
                                         [](double a, double b) { return std::max(a, b); });
    DistanceWishes own = wishes;
    own.negligible = std::max(wishes.negligible, other.rounding());
    std::vector<FarthestPoint> of_parts(parts(triangles));
    parallel_for(
        of_parts.size(), 0,
        [&](std::size_t part, unsigned) {
            FarthestPoint& all = of_parts[part];
            std::vector<CutPiece> waiting;
            for (std::size_t i = part * kAtOnce; i < std::min(triangles, (part + 1) * kAtOnce);
                 ++i) {
                const auto& [a, b, c] = mesh.triangles[i];
                FarthestPoint one{known, 0, {}, {}};
                measure({mesh.corners(i), {nearest[a], nearest[b], nearest[c]}}, other, own, one,
                        waiting);
                all.lower = std::max(all.lower, one.lower);
                all.upper = std::max(all.upper, one.upper);
                if (one.nearest.empty())
                    continue;
                all.beyond.push_back(static_cast<std::uint32_t>(i));
                all.nearest.insert(all.nearest.end(), one.nearest.begin(), one.nearest.end());
            }
        },
        look);
    FarthestPoint all{known, known, {}, {}};
    for (const FarthestPoint& part : of_parts) {
        all.lower = std::max(all.lower, part.lower);
        all.upper = std::max(all.upper, part.upper);
        all.beyond.insert(all.beyond.end(), part.beyond.begin(), part.beyond.end());
        all.nearest.insert(all.nearest.end(), part.nearest.begin(), part.nearest.end());
    }
    if (!all.beyond.empty())
        all.upper = std::numeric_limits<double>::infinity();
    return all;
}

} // namespace isochron::index
