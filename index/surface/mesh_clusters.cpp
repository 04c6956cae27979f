// Sums quadrics of triangles by cluster and picks vertices.
#include "index/surface/mesh_clusters.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <bit>
#include <limits>
#include <utility>
#include <vector>

namespace isochron::index {
namespace {

constexpr std::size_t kBetweenLooks =
    1 << 14; ///< vertices or triangles between two looks at the stop token
constexpr std::uint32_t kNone = ~0u;

glm::vec3 place_of_vertex(const MeshVertex& vertex) {
    glm::vec3 at(vertex.x, vertex.y, vertex.z);
    at[vertex.axis] += static_cast<float>(vertex.share) / static_cast<float>(MeshVertex::kWhole);
    return at;
}

/// The sum of squared distances from planes, weighted by the areas of their triangles.
struct Quadric {
    std::array<float, 10> sums{}; ///< xx, xy, xz, xw, yy, yz, yw, zz, zw, ww

    /// @param n normal, twice as long as the triangle's area @param w -dot(n, place on the plane)
    void add(const glm::vec3& n, float w, float weight) {
        const glm::vec3 scaled = weight * n;
        const float scaled_w = weight * w;
        sums[0] += scaled.x * n.x;
        sums[1] += scaled.x * n.y;
        sums[2] += scaled.x * n.z;
        sums[3] += scaled.x * w;
        sums[4] += scaled.y * n.y;
        sums[5] += scaled.y * n.z;
        sums[6] += scaled.y * w;
        sums[7] += scaled.z * n.z;
        sums[8] += scaled.z * w;
        sums[9] += scaled_w * w;
    }
    float at(const glm::vec3& p) const {
        return p.x * (sums[0] * p.x + 2 * (sums[1] * p.y + sums[2] * p.z + sums[3])) +
               p.y * (sums[4] * p.y + 2 * (sums[5] * p.z + sums[6])) +
               p.z * (sums[7] * p.z + 2 * sums[8]) + sums[9];
    }
};

/// Numbers keys in the order in which they are first seen.
class KeyNumbers {
  public:
    explicit KeyNumbers(std::size_t most) : slots_(std::bit_ceil(2 * most + 1)) {
        places_.assign(slots_, kNone);
    }
    /// @return the number of the key, and whether it is new
    std::pair<std::uint32_t, bool> number(std::uint64_t key) {
        std::size_t slot = key * 0x9e3779b97f4a7c15u >> (64 - std::countr_zero(slots_));
        for (;; slot = (slot + 1) & (slots_ - 1)) {
            std::uint32_t& at = places_[slot];
            if (at == kNone) {
                at = static_cast<std::uint32_t>(keys_.size());
                keys_.push_back(key);
                return {at, true};
            }
            if (keys_[at] == key)
                return {at, false};
        }
    }
    const std::vector<std::uint64_t>& keys() const { return keys_; }

  private:
    std::size_t slots_;
    std::vector<std::uint32_t> places_; ///< number of the key in each slot
    std::vector<std::uint64_t> keys_;
};

/// The axis along which a normal is longest, and its direction: 0 to 5; without a normal 0.
unsigned side_of(const MeshVertex& vertex) {
    const glm::dvec3 n = normal_of(vertex), length = glm::abs(n);
    const int axis = length.x >= length.y && length.x >= length.z ? 0
                     : length.y >= length.z                       ? 1
                                                                  : 2;
    return 2 * static_cast<unsigned>(axis) + (n[axis] < 0 ? 1 : 0);
}

/// Picks one vertex of each cluster. Stopped when it is asked to.
class Clustering {
  public:
    Clustering(const CellMesh& mesh, std::uint32_t edge, const std::stop_token& stop)
        : mesh_(mesh), edge_(edge), stop_(stop) {}

    bool run(CellMesh& fewer) {
        return find_clusters() && add_quadrics() && pick_vertices() && keep_triangles(fewer);
    }

  private:
    bool stops(std::size_t i) const { return i % kBetweenLooks == 0 && stop_.stop_requested(); }

    bool find_clusters() {
        KeyNumbers numbers(mesh_.vertices.size());
        cluster_.reserve(mesh_.vertices.size());
        const auto edge = static_cast<float>(edge_);
        for (std::size_t i = 0; i < mesh_.vertices.size(); ++i) {
            if (stops(i))
                return false;
            const glm::vec3 cube = glm::floor(place_of_vertex(mesh_.vertices[i]) / edge);
            std::uint64_t key = side_of(mesh_.vertices[i]);
            for (int axis = 0; axis < 3; ++axis)
                key = key << 16 | static_cast<std::uint64_t>(cube[axis]);
            const auto [number, is_new] = numbers.number(key);
            cluster_.push_back(number);
            if (is_new)
                middles_.push_back(edge * (cube + 0.5f));
        }
        return true;
    }

    /// Adds the quadrics of the planes of all triangles that have a vertex in the cluster.
    bool add_quadrics() {
        quadrics_.resize(middles_.size());
        for (std::size_t i = 0; i < mesh_.triangles.size(); i += 3) {
            if (stops(i))
                return false;
            std::array<glm::vec3, 3> at;
            const std::array<std::uint32_t, 3> of = clusters_of(i);
            for (std::size_t k = 0; k < 3; ++k)
                at[k] = place_of_vertex(mesh_.vertices[mesh_.triangles[i + k]]);
            const glm::vec3 across = glm::cross(at[1] - at[0], at[2] - at[0]);
            const float area = glm::length(across); // twice
            if (!(area > 0))
                continue;
            const glm::vec3 n = across / area;
            for (std::size_t k = 0; k < 3; ++k)
                if (std::find(of.begin(), of.begin() + k, of[k]) == of.begin() + k)
                    quadrics_[of[k]].add(n, -glm::dot(n, at[0] - middles_[of[k]]), area);
        }
        return true;
    }

    bool pick_vertices() {
        constexpr float kTowardMiddle = 1e-3f; // where all are in one plane
        picked_.assign(middles_.size(), kNone);
        std::vector<float> least(middles_.size(), std::numeric_limits<float>::infinity());
        for (std::size_t i = 0; i < mesh_.vertices.size(); ++i) {
            if (stops(i))
                return false;
            const std::uint32_t of = cluster_[i];
            const glm::vec3 at = place_of_vertex(mesh_.vertices[i]) - middles_[of];
            const float error = quadrics_[of].at(at) + kTowardMiddle * glm::dot(at, at);
            if (picked_[of] != kNone && !(error < least[of]))
                continue;
            least[of] = error;
            picked_[of] = static_cast<std::uint32_t>(i);
        }
        return true;
    }

    bool keep_triangles(CellMesh& fewer) {
        // Numbers of the clusters' vertices.
        std::vector<std::uint32_t> numbers(middles_.size(), kNone);
        for (std::size_t i = 0; i < mesh_.triangles.size(); i += 3) {
            if (stops(i))
                return false;
            const std::array<std::uint32_t, 3> of = clusters_of(i);
            if (of[0] == of[1] || of[1] == of[2] || of[2] == of[0])
                continue;
            for (const std::uint32_t cluster : of) {
                std::uint32_t& number = numbers[cluster];
                if (number == kNone) {
                    number = static_cast<std::uint32_t>(fewer.vertices.size());
                    fewer.vertices.push_back(mesh_.vertices[picked_[cluster]]);
                    if (!mesh_.colors.empty())
                        fewer.colors.push_back(mesh_.colors[picked_[cluster]]);
                }
                fewer.triangles.push_back(number);
            }
        }
        return true;
    }

    std::array<std::uint32_t, 3> clusters_of(std::size_t corner) const {
        const std::uint32_t* const vertices = &mesh_.triangles[corner];
        return {cluster_[vertices[0]], cluster_[vertices[1]], cluster_[vertices[2]]};
    }

    const CellMesh& mesh_;
    std::uint32_t edge_;
    const std::stop_token& stop_;
    std::vector<std::uint32_t> cluster_; ///< by vertex
    std::vector<glm::vec3> middles_; ///< middles of the clusters' cubes, from which quadrics count
    std::vector<Quadric> quadrics_;
    std::vector<std::uint32_t> picked_; ///< vertex of each cluster
};

} // namespace

CellMesh clustered(const CellMesh& mesh, std::uint32_t edge, const std::stop_token& stop) {
    CellMesh fewer;
    return Clustering(mesh, edge, stop).run(fewer) ? fewer : CellMesh();
}

} // namespace isochron::index
