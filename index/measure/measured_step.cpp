// Makes what measures need of a step.
#include "index/measure/measured_step.h"

#include "index/measure/cell_volume.h"
#include "index/measure/disjoint_sets.h"
#include "index/search/index_search.h"
#include "index/surface/mesh_cases.h"
#include "index/surface/mesh_crop.h"

#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

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

/// Distances of all vertices along each axis from the first, in physical units.
class Distances {
  public:
    explicit Distances(const Grid& grid) {
        for (std::size_t axis = 0; axis < 3; ++axis)
            for (std::uint32_t i = 0; i < grid.vertices[axis]; ++i)
                along_[axis].push_back(grid.distance(static_cast<int>(axis), i));
    }
    double between(std::size_t axis, std::uint32_t begin, std::uint32_t end) const {
        return along_[axis][end] - along_[axis][begin];
    }
    double cell(const std::array<std::uint32_t, 3>& at) const {
        return between(0, at[0], at[0] + 1) * between(1, at[1], at[1] + 1) *
               between(2, at[2], at[2] + 1);
    }

  private:
    std::array<std::vector<double>, 3> along_;
};

/// Adds up the cells all of whose vertices are on a side.
template <class RowsOfSide>
double whole_cells(const Grid& grid, const Distances& distances, const RowsOfSide& row) {
    const auto [nx, ny, nz] = grid.cells();
    double volume = 0;
    for (std::uint32_t z = 0; z < nz; ++z)
        for (std::uint32_t y = 0; y < ny; ++y) {
            double along = 0;
            for_each_common<4>({row(y, z), row(y + 1, z), row(y, z + 1), row(y + 1, z + 1)},
                               [&](std::uint32_t begin, std::uint32_t end) {
                                   along += distances.between(0, begin, end - 1);
                               });
            volume += along * distances.between(1, y, y + 1) * distances.between(2, z, z + 1);
        }
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
                           const std::optional<VertexBox>& box, bool complete,
                           const std::stop_token& stop)
    : file_(file), query_(query), whole_(mesh), box_(box),
      grid_(box ? grid_of(file.info().grid, *box) : file.info().grid), complete_(complete),
      stop_(stop) {
    if (box)
        cropped_ = cells_within(mesh, *box);
}

const std::vector<glm::dvec3>& MeasuredStep::points() {
    if (!points_) {
        points_.emplace();
        points_->reserve(mesh().vertices.size());
        const Grid& of = grid();
        for (const MeshVertex& vertex : mesh().vertices) {
            const glm::dvec3 at = position_of(vertex);
            points_->push_back(of.direction * glm::dvec3(of.distance(0, at.x), of.distance(1, at.y),
                                                         of.distance(2, at.z)));
        }
    }
    return *points_;
}

const std::vector<glm::dvec3>& MeasuredStep::normals() {
    if (!normals_) {
        const std::vector<glm::dvec3>& at = points();
        normals_.emplace();
        normals_->reserve(triangles());
        for (std::size_t i = 0; i < mesh().triangles.size(); i += 3) {
            const glm::dvec3& a = at[mesh().triangles[i]];
            normals_->push_back(
                0.5 * glm::cross(at[mesh().triangles[i + 1]] - a, at[mesh().triangles[i + 2]] - a));
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
        pieces_ = pieces_of(mesh(), grid(), complete_);
    return *pieces_;
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
        sides_ = complete_ ? VertexSides::of_mesh(whole_, file_.info().grid,
                                                  whole_.cases.empty() && corner_is_above())
                           : VertexSides::of_values(
                                 step_of_query(file_, query_.instant, {&query_.isovalue, 1}),
                                 query_.isovalue, stop_);
        if (box_)
            sides_ = sides_->within(*box_, grid_);
    }
    return *sides_;
}

const MeasuredStep::Volumes& MeasuredStep::volumes() {
    if (volumes_)
        return *volumes_;
    const VertexSides& of = sides();
    Volumes sum;
    const Distances distances(grid());
    sum.above = whole_cells(grid(), distances, [&](auto y, auto z) { return of.above(y, z); });
    sum.below = whole_cells(grid(), distances, [&](auto y, auto z) { return of.below(y, z); });
    const std::array<MeshCase, 256>& cases = mesh_cases();
    const std::span<const std::uint32_t> corners = mesh().triangles;
    std::size_t first = 0;
    for (const std::uint8_t of_cell : mesh().cases) {
        const std::size_t count = std::size_t{3} * cases[of_cell].triangles;
        const auto at = cell_of_mesh(mesh().vertices[corners[first]], of_cell);
        const double whole = distances.cell(at);
        const double share = share_above(mesh().vertices, corners.subspan(first, count), of_cell);
        sum.above += share * whole;
        sum.below += (1 - share) * whole;
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
