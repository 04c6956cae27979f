// Derives the polygons from their sides on the faces of a cell, and the triangles from the
// polygons.
#include "index/surface/mesh_cases.h"

#include <algorithm>
#include <cassert>
#include <limits>
#include <vector>

namespace isochron::index {
namespace {

using Corner = std::array<int, 3>;

int bit_of(const Corner& corner) {
    return corner[0] + 2 * corner[1] + 4 * corner[2];
}

int edge_between(const Corner& a, const Corner& b) {
    const int axis = a[0] != b[0] ? 0 : a[1] != b[1] ? 1 : 2;
    const int u = axis == 0 ? 1 : 0, v = axis == 2 ? 1 : 2;
    return 4 * axis + a[u] + 2 * a[v];
}

/// The faces that contain an edge, as bits 2 * axis + side.
int faces_of(int edge) {
    const int axis = edge / 4, u = axis == 0 ? 1 : 0, v = axis == 2 ? 1 : 2;
    return 1 << (2 * u + edge % 2) | 1 << (2 * v + edge / 2 % 2);
}

/// Corners of a face, counter-clockwise as seen from outside.
std::array<Corner, 4> around(int axis, int side) {
    constexpr std::array<std::array<int, 2>, 4> kRound{{{0, 0}, {1, 0}, {1, 1}, {0, 1}}};
    std::array<Corner, 4> corners;
    for (int i = 0; i < 4; ++i) {
        Corner& corner = corners[i];
        const auto& at = kRound[side == 1 ? i : 3 - i];
        corner[axis] = side;
        corner[(axis + 1) % 3] = at[0];
        corner[(axis + 2) % 3] = at[1];
    }
    return corners;
}

/// For each cut edge, the next edge of its polygon; -1 for other edges.
std::array<int, kCellEdges> polygon_sides(int upper) {
    std::array<int, kCellEdges> next;
    next.fill(-1);
    const auto is_upper = [upper](const Corner& corner) { return upper >> bit_of(corner) & 1; };
    for (int face = 0; face < 6; ++face) {
        const auto corners = around(face / 2, face % 2);
        for (int i = 0; i < 4; ++i) {
            // A side leads from where a walk around the face enters the upper side to where it
            // leaves it.
            if (is_upper(corners[i]) || !is_upper(corners[(i + 1) % 4]))
                continue;
            int j = i + 1;
            while (is_upper(corners[(j + 1) % 4]))
                ++j;
            next[edge_between(corners[i], corners[(i + 1) % 4])] =
                edge_between(corners[j % 4], corners[(j + 1) % 4]);
        }
    }
    return next;
}

/// Divides a polygon into triangles with the fewest inner sides in faces of the cell.
class Triangulation {
  public:
    explicit Triangulation(const std::vector<int>& polygon) : polygon_(polygon) {}

    /// Appends the triangles, three edges for each.
    void append(std::vector<int>& triangles) const {
        split(0, static_cast<int>(polygon_.size()) - 1, &triangles);
    }

  private:
    /// The least number of sides in faces for the part of the polygon from `first` to `last`.
    int split(int first, int last, std::vector<int>* triangles) const {
        if (last - first < 2)
            return 0;
        int best = std::numeric_limits<int>::max(), best_middle = 0;
        for (int middle = first + 1; middle < last; ++middle) {
            const int cost = side(first, middle) + side(middle, last) +
                             split(first, middle, nullptr) + split(middle, last, nullptr);
            if (cost < best) {
                best = cost;
                best_middle = middle;
            }
        }
        if (triangles) {
            for (const int corner : {first, best_middle, last})
                triangles->push_back(polygon_[corner]);
            split(first, best_middle, triangles);
            split(best_middle, last, triangles);
        }
        return best;
    }
    int side(int a, int b) const {
        const bool of_polygon = b - a == 1 || b - a + 1 == static_cast<int>(polygon_.size());
        return !of_polygon && (faces_of(polygon_[a]) & faces_of(polygon_[b])) != 0;
    }

    const std::vector<int>& polygon_;
};

MeshCase make_case(int upper) {
    MeshCase made;
    const auto next = polygon_sides(upper);
    std::vector<int> triangles;
    for (int first = 0; first < kCellEdges; ++first) {
        if (next[first] < 0 || made.cut >> first & 1)
            continue;
        std::vector<int> polygon;
        for (int edge = first; !(made.cut >> edge & 1); edge = next[edge]) {
            polygon.push_back(edge);
            made.cut = static_cast<std::uint16_t>(made.cut | 1 << edge);
        }
        Triangulation(polygon).append(triangles);
    }
    assert(triangles.size() <= made.edges.size());
    made.triangles = static_cast<std::uint8_t>(triangles.size() / 3);
    std::ranges::copy(triangles, made.edges.begin());
    return made;
}

} // namespace

const std::array<MeshCase, 256>& mesh_cases() {
    static const auto cases = [] {
        std::array<MeshCase, 256> all;
        for (int upper = 0; upper < 256; ++upper)
            all[upper] = make_case(upper);
        return all;
    }();
    return cases;
}

} // namespace isochron::index
