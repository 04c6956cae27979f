// Makes what measures need of a step.
#include "index/measure/measured_step.h"

#include "index/measure/cell_volume.h"
#include "index/measure/disjoint_sets.h"
#include "index/measure/kept_pieces.h"
#include "index/search/index_search.h"
#include "index/surface/mesh_cases.h"

#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <ranges>

namespace isochron::index {
namespace {

using Run = VertexSides::Run;

/// Calls `take(begin, end)` for the vertices from begin to before end that are in a run of all rows.
template <std::size_t kRows, class F>
void for_each_common(std::array<std::span<const Run>, kRows> rows, F&& take) {
    while (std::ranges::none_of(rows, &std::span<const Run>::empty)) {
        std::uint32_t begin = 0, end = ~0u;
        for (const auto& row : rows) {
            begin = std::max(begin, row.front().begin);
            end = std::min(end, row.front().end);
        }
        if (begin < end)
            take(begin, end);
        for (auto& row : rows)
            if (row.front().end == end)
                row = row.subspan(1);
    }
}

/// Volumes of cells, and what a plane leaves of them: as products of distances along the axes.
class CellVolumes {
  public:
    /// @param clip outlives this; empty: all is left
    CellVolumes(const Grid& grid, const std::optional<PlaneCut>& clip)
        : cells_(grid.cells()), clip_(clip) {
        for (std::size_t axis = 0; axis < 3; ++axis)
            for (std::uint32_t i = 0; i < grid.vertices[axis]; ++i)
                along_[axis].push_back(grid.distance(static_cast<int>(axis), i));
    }
    const std::array<std::uint32_t, 3>& cells() const { return cells_; }
    double whole(const std::array<std::uint32_t, 3>& at) const {
        return side(0, at[0]) * side(1, at[1]) * side(2, at[2]);
    }
    /// The plane in this cell.
    CellCut cut(const std::array<std::uint32_t, 3>& at) const {
        const glm::dvec3& along = clip_->along();
        return {clip_->beyond({along_[0][at[0]], along_[1][at[1]], along_[2][at[2]]}),
                {along.x * side(0, at[0]), along.y * side(1, at[1]), along.z * side(2, at[2])}};
    }
    /// What is left of the cell.
    double left(const std::array<std::uint32_t, 3>& at) const {
        if (!clip_)
            return whole(at);
        const CellCut plane = cut(at);
        constexpr std::uint8_t kAllAbove = 255;
        return plane.leaves_nothing() ? 0
               : plane.leaves_all()   ? whole(at)
                                      : whole(at) * share_above({}, {}, kAllAbove, plane);
    }
    /// What is left of the cells of a row from `begin` to before `end`.
    double left(std::uint32_t begin, std::uint32_t end, std::uint32_t y, std::uint32_t z) const {
        if (!clip_)
            return (along_[0][end] - along_[0][begin]) * side(1, y) * side(2, z);
        // Along a row, those that are left as a whole are at one end of it.
        const auto all = [&](std::uint32_t x) { return cut({x, y, z}).leaves_all(); };
        std::uint32_t first = begin, last = end;
        if (all(begin) != all(end - 1)) {
            const auto run = std::views::iota(begin, end);
            const bool starts = all(begin);
            const auto middle = *std::ranges::partition_point(
                run, [&](std::uint32_t x) { return all(x) == starts; });
            (starts ? last : first) = middle;
        } else if (!all(begin)) {
            first = last = begin;
        }
        double sum = (along_[0][last] - along_[0][first]) * side(1, y) * side(2, z);
        const auto nothing = [&](std::uint32_t x) { return cut({x, y, z}).leaves_nothing(); };
        for (std::uint32_t x = last; x < end && !(nothing(x) && nothing(end - 1)); ++x)
            sum += left({x, y, z});
        for (std::uint32_t x = first; x > begin && !(nothing(x - 1) && nothing(begin)); --x)
            sum += left({x - 1, y, z});
        return sum;
    }

  private:
    double side(std::size_t axis, std::uint32_t i) const {
        return along_[axis][i + 1] - along_[axis][i];
    }

    std::array<std::uint32_t, 3> cells_;
    std::array<std::vector<double>, 3> along_; ///< distances of vertices from the first one
    const std::optional<PlaneCut>& clip_;
};

/// Adds up the cells all of whose vertices are on a side.
template <class RowsOfSide>
double whole_cells(const CellVolumes& cells, const RowsOfSide& row) {
    const auto [nx, ny, nz] = cells.cells();
    double volume = 0;
    for (std::uint32_t z = 0; z < nz; ++z)
        for (std::uint32_t y = 0; y < ny; ++y)
            for_each_common<4>({row(y, z), row(y + 1, z), row(y, z + 1), row(y + 1, z + 1)},
                               [&](std::uint32_t begin, std::uint32_t end) {
                                   if (end - begin > 1)
                                       volume += cells.left(begin, end - 1, y, z);
                               });
    return volume;
}

/// The mesh of the cells in a box, with places from the box's first vertex on.
CellMesh cells_within(const CellMesh& mesh, const VertexBox& box) {
    CellMesh kept = mesh;
    kept.triangles.clear();
    kept.cases.clear();
    std::size_t first = 0;
    for (const std::uint8_t of_cell : mesh.cases) {
        const std::size_t count = std::size_t{3} * mesh_cases()[of_cell].triangles;
        const auto at = cell_of_mesh(mesh.vertices[mesh.triangles[first]], of_cell);
        bool within = true;
        for (std::size_t axis = 0; axis < 3; ++axis)
            within &= at[axis] >= box.first[axis] && at[axis] < box.last[axis];
        if (within) {
            kept.cases.push_back(of_cell);
            const auto begin = mesh.triangles.begin() + static_cast<std::ptrdiff_t>(first);
            kept.triangles.insert(kept.triangles.end(), begin,
                                  begin + static_cast<std::ptrdiff_t>(count));
        }
        first += count;
    }
    drop_unused_vertices(kept);
    for (MeshVertex& vertex : kept.vertices) {
        vertex.x = static_cast<std::uint16_t>(vertex.x - box.first[0]);
        vertex.y = static_cast<std::uint16_t>(vertex.y - box.first[1]);
        vertex.z = static_cast<std::uint16_t>(vertex.z - box.first[2]);
    }
    return kept;
}

Grid grid_of(const Grid& whole, const VertexBox& box) {
    Grid part = whole.part(box.first, {box.last[0] + 1, box.last[1] + 1, box.last[2] + 1});
    part.origin = whole.physical({box.first[0], box.first[1], box.first[2]});
    return part;
}

} // namespace

MeasuredStep::MeasuredStep(const IndexFile& file, const Query& query, const CellMesh& mesh,
                           const std::optional<VertexBox>& box, const std::optional<CutPlane>& clip,
                           const PieceFilter& kept, bool complete, const std::stop_token& stop)
    : file_(file), query_(query), whole_(mesh), box_(box),
      grid_(box ? grid_of(file.info().grid, *box) : file.info().grid), complete_(complete),
      all_pieces_(kept.keeps_all()), stop_(stop) {
    if (box)
        cropped_ = cells_within(mesh, *box);
    if (!all_pieces_) {
        part_ = mesh_of_all();
        keep(*part_, kept_pieces(*part_, grid_, complete_, kept, 0));
    }
    if (clip) {
        clip_.emplace(*clip, grid_);
        cut_surface();
    }
}

std::vector<glm::dvec3> MeasuredStep::points_of_mesh() const {
    std::vector<glm::dvec3> points;
    points.reserve(mesh().vertices.size());
    for (const MeshVertex& vertex : mesh().vertices) {
        const glm::dvec3 at = position_of(vertex);
        points.push_back(grid_.direction * glm::dvec3(grid_.distance(0, at.x),
                                                      grid_.distance(1, at.y),
                                                      grid_.distance(2, at.z)));
    }
    return points;
}

void MeasuredStep::cut_surface() {
    const std::vector<glm::dvec3> points = points_of_mesh();
    std::vector<double> beyond;
    beyond.reserve(points.size());
    for (const glm::dvec3& at : points)
        beyond.push_back(clip_->beyond_physical(at));
    cut_ = cut(points, mesh().values, mesh().triangles, beyond, triangles_of_cells(mesh()),
               clip_->leaves_plane());
}

const std::vector<glm::dvec3>& MeasuredStep::points() {
    if (clip_)
        return cut_.points;
    if (!points_)
        points_ = points_of_mesh();
    return *points_;
}

const std::vector<glm::dvec3>& MeasuredStep::normals() {
    if (!normals_) {
        const std::vector<glm::dvec3>& at = points();
        normals_.emplace();
        normals_->reserve(triangles());
        for (std::size_t i = 0; i < corners().size(); i += 3) {
            const glm::dvec3& a = at[corners()[i]];
            normals_->push_back(0.5 *
                                glm::cross(at[corners()[i + 1]] - a, at[corners()[i + 2]] - a));
        }
    }
    return *normals_;
}

const std::vector<double>& MeasuredStep::areas() {
    if (!areas_) {
        areas_.emplace();
        areas_->reserve(triangles());
        for (const glm::dvec3& normal : normals())
            areas_->push_back(glm::length(normal));
    }
    return *areas_;
}

const MeshPieces& MeasuredStep::pieces() {
    if (!pieces_)
        pieces_ = clip_ ? pieces_of(cut_.corners) : pieces_of(mesh(), grid(), complete_);
    return *pieces_;
}

std::vector<std::uint32_t> MeasuredStep::cells_of_pieces() {
    return index::cells_of_pieces(clip_ ? cut_.triangles : triangles_of_cells(mesh()), pieces());
}

/// The side of the grid's first vertex; asked for where no cell is active.
bool MeasuredStep::corner_is_above() const {
    const StepView step = step_of_query(file_, query_.instant, {&query_.isovalue, 1});
    const auto first = [&](const std::byte* values) {
        return visit_value_type(step.type(), [&]<class T>(std::type_identity<T>) {
            return step.scaling()(static_cast<double>(*reinterpret_cast<const T*>(values)));
        });
    };
    if (!step.by_chunks())
        return first(step.whole(stop_).values.step_bytes(step.at().step).data()) >= query_.isovalue;
    const std::array<std::uint32_t, 1> place{step.chunk_grid().place(0, 0)};
    return first(step.chunks(0, place, stop_).front()->values.data()) >= query_.isovalue;
}

const VertexSides& MeasuredStep::sides() {
    if (!sides_) {
        uncut_ = complete_ ? VertexSides::of_mesh(whole_, file_.info().grid,
                                                  whole_.cases.empty() && corner_is_above())
                           : VertexSides::of_values(
                                 step_of_query(file_, query_.instant, {&query_.isovalue, 1}),
                                 query_.isovalue, stop_);
        if (box_)
            uncut_ = uncut_->within(*box_, grid_);
        sides_ = clip_ ? uncut_->left_by(*clip_) : *uncut_;
    }
    return *sides_;
}

const MeasuredStep::Volumes& MeasuredStep::volumes() {
    if (volumes_)
        return *volumes_;
    sides();
    const VertexSides& of = *uncut_;
    Volumes sum;
    const CellVolumes cells(grid(), clip_);
    sum.above = whole_cells(cells, [&](auto y, auto z) { return of.above(y, z); });
    sum.below = whole_cells(cells, [&](auto y, auto z) { return of.below(y, z); });
    const std::array<MeshCase, 256>& cases = mesh_cases();
    const std::span<const std::uint32_t> corners = mesh_of_all().triangles;
    std::size_t first = 0;
    for (const std::uint8_t of_cell : mesh_of_all().cases) {
        const std::size_t count = std::size_t{3} * cases[of_cell].triangles;
        const auto at = cell_of_mesh(mesh_of_all().vertices[corners[first]], of_cell);
        const double whole = cells.whole(at), left = cells.left(at);
        const auto triangles = corners.subspan(first, count);
        const double share =
            left == whole ? share_above(mesh_of_all().vertices, triangles, of_cell)
            : left == 0   ? 0
                          : share_above(mesh_of_all().vertices, triangles, of_cell, cells.cut(at));
        sum.above += share * whole;
        sum.below += left - share * whole;
        first += count;
    }
    const double skew = std::abs(glm::determinant(grid().direction));
    volumes_ = Volumes{sum.above * skew, sum.below * skew};
    return *volumes_;
}

std::uint64_t MeasuredStep::bodies() {
    const VertexSides& of = sides();
    const auto [nx, ny, nz] = grid().vertices;
    // Runs are numbered as they come; those of a plane before stay at hand.
    std::vector<std::uint32_t> firsts;
    std::uint32_t count = 0;
    for (std::uint32_t z = 0; z < nz; ++z)
        for (std::uint32_t y = 0; y < ny; ++y) {
            firsts.push_back(count);
            count += static_cast<std::uint32_t>(of.above(y, z).size());
        }
    DisjointSets sets(count);
    std::uint64_t bodies = count;
    const auto join = [&](std::size_t y, std::size_t z, std::size_t to_y, std::size_t to_z) {
        const auto here = of.above(static_cast<std::uint32_t>(y), static_cast<std::uint32_t>(z));
        const auto there =
            of.above(static_cast<std::uint32_t>(to_y), static_cast<std::uint32_t>(to_z));
        for (std::uint32_t i = 0, k = 0; i < here.size() && k < there.size();) {
            if (here[i].begin < there[k].end && there[k].begin < here[i].end) {
                const std::uint32_t a = sets.least_of(firsts[z * ny + y] + i),
                                    b = sets.least_of(firsts[to_z * ny + to_y] + k);
                if (a != b) {
                    sets.join(a, b);
                    --bodies;
                }
            }
            here[i].end < there[k].end ? ++i : ++k;
        }
    };
    for (std::size_t z = 0; z < nz; ++z)
        for (std::size_t y = 0; y < ny; ++y) {
            if (y > 0)
                join(y, z, y - 1, z);
            if (z > 0)
                join(y, z, y, z - 1);
        }
    return bodies;
}

} // namespace isochron::index
