// Makes triangles cell by cell and a vertex when an edge is first met, then positions and normals.
#include "index/surface/mesh_maker.h"

#include "index/surface/edge_key.h"
#include "index/surface/mesh_cases.h"
#include "index/surface/mesh_vertices.h"
#include "index/volume/cell_walk.h"
#include "index/volume/ordinal.h"
#include "index/volume/stored_cut.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>
#include <limits>
#include <numeric>

namespace isochron::index {
namespace {

/// The place of an edge relative to its cell.
struct EdgePlace {
    EdgeKey key;
    std::uint32_t axis, x, y, z; ///< offsets of the lower end
};
constexpr std::array<EdgePlace, kCellEdges> kEdgePlaces = [] {
    std::array<EdgePlace, kCellEdges> edges{};
    for (std::uint32_t e = 0; e < kCellEdges; ++e) {
        const std::uint32_t axis = e / 4, u = e % 2, v = e / 2 % 2;
        const std::uint32_t x = axis == 0 ? 0 : u, y = axis == 0 ? u : axis == 1 ? 0 : v;
        const std::uint32_t z = axis == 2 ? 0 : v;
        edges[e] = {key_of(x, y, z) | EdgeKey{axis} << 48, axis, x, y, z};
    }
    return edges;
}();
/// The edges that no earlier cell has, since their lower ends have the largest offsets.
constexpr std::array<std::size_t, 3> kNewEdges{3, 7, 11};
constexpr unsigned kOldEdges = 0xfff & ~(1u << 3 | 1u << 7 | 1u << 11);

/// Finds the vertices of cells that are on the upper side.
template <class T>
void find_cases(const StepValues& values, const Query& query, std::uint64_t cut,
                std::span<const CellId> ids, std::uint8_t* cases) {
    const T least = from_ordinal<T>(static_cast<Ordinal<T>>(cut));
    const unsigned flipped = values.scaling.slope < 0 ? 0xff : 0;
    const std::size_t row = values.grid.vertices[0], slice = row * values.grid.vertices[1];
    const T* const volume = values.step<T>(query.instant.step).data();
    const std::size_t ahead = 2 * slice * sizeof(T);
    const T* of_row = volume;
    CellWalk walk(values.grid);
    for (const CellId id : ids) {
        if (walk.to(id))
            of_row = volume + walk.z() * slice + walk.y() * row;
        const T* const v = of_row + walk.x();
        // Normals will soon read the slice behind the cell for the first time: fetch it meanwhile.
        __builtin_prefetch(reinterpret_cast<const char*>(v) + ahead);
        __builtin_prefetch(reinterpret_cast<const char*>(v) + ahead + row * sizeof(T));
        const auto pair = [least](const T* at) {
            return unsigned{at[0] >= least} | unsigned{at[1] >= least} << 1;
        };
        const unsigned upper =
            pair(v) | pair(v + row) << 2 | pair(v + slice) << 4 | pair(v + slice + row) << 6;
        *cases++ = static_cast<std::uint8_t>(upper ^ flipped);
    }
}

/// The corners of a cell in the earlier mesh.
const std::uint32_t* corners_in(const EarlierMesh& earlier, std::size_t cell) {
    return earlier.mesh->triangles.data() + earlier.cells->corners[earlier.places[cell]];
}

/// Number of inner cells from one on, before `end`, that follow each other in the earlier mesh, too. Of
/// all of them colors are kept, or of none.
std::size_t length_of_run(const EarlierMesh& earlier, std::size_t first, std::size_t end) {
    if (earlier.inner.empty())
        return 0;
    const auto goes_on = [&](std::size_t i) {
        return earlier.inner[i] && earlier.places[i] - earlier.places[first] == i - first &&
               (!earlier.has_colors() || earlier.has_colors_of(i) == earlier.has_colors_of(first));
    };
    std::size_t next = first;
    while (next < end && goes_on(next))
        ++next;
    return next - first;
}

/// Copies the vertices that a cell is the first to have, and their colors if these stay.
/// @param first number of the first of them @param corners of the cell, in the new mesh
void take_vertices(const EarlierMesh& earlier, std::size_t cell, std::uint32_t first,
                   std::span<const std::uint32_t> corners, MeshPart& part) {
    const std::uint32_t* const of_earlier = corners_in(earlier, cell);
    const bool colored = earlier.has_colors() && earlier.has_colors_of(cell);
    for (std::size_t k = 0; k < corners.size(); ++k)
        if (corners[k] >= first) {
            part.vertices[corners[k]] = earlier.mesh->vertices[of_earlier[k]];
            if (colored)
                part.colors[corners[k]] = earlier.mesh->colors[of_earlier[k]];
        }
}

void add_numbers(std::uint32_t first, std::uint32_t end, std::vector<std::uint32_t>& numbers) {
    for (std::uint32_t number = first; number < end; ++number)
        numbers.push_back(number);
}

} // namespace

/// Makes the triangles of cells in one pass over them.
///
/// A table holds the numbers of edges' vertices: two planes each of edges along x and along y, used
/// alternately, and one plane of edges along z. Tables are never cleared. Numbers grow from mesh to
/// mesh, so that a number that is too small is known to be of an older plane.
class MeshMaker::Pass {
  public:
    Pass(Tables& tables, const Grid& grid, std::uint32_t first_plane, MeshPart& part)
        : table_(tables.numbers.get()), base_(tables.base), row_(grid.vertices[0]),
          first_plane_(first_plane), part_(part) {
        const std::size_t plane = row_ * grid.vertices[1];
        for (std::size_t odd = 0; odd < 2; ++odd)
            for (std::size_t e = 0; e < kCellEdges; ++e) {
                const EdgePlace& edge = kEdgePlaces[e];
                const std::size_t table = edge.axis == 2 ? 4 : 2 * edge.axis + (edge.z ^ odd);
                places_[odd][e] = table * plane + edge.y * row_ + edge.x;
            }
    }

    void enter_plane(std::uint32_t z) {
        const std::uint32_t before = z == z_ + 1 ? begin_ : base_ + count_;
        begin_ = base_ + count_;
        z_ = z;
        for (std::size_t e = 0; e < kCellEdges; ++e)
            least_[e] = kEdgePlaces[e].axis != 2 && kEdgePlaces[e].z == 0 ? before : begin_;
    }

    /// Takes over cells that follow each other in an earlier mesh, as do all around them.
    /// @param place of the first of them @param renumbered see MeshMaker; gets their vertices
    void take(const EarlierMesh& earlier, std::size_t place, std::size_t cells,
              std::uint32_t* renumbered) {
        const CellsOfMesh& of_mesh = *earlier.cells;
        const std::uint32_t first = of_mesh.vertices[place], end = of_mesh.vertices[place + cells];
        const std::size_t begin = of_mesh.corners[place],
                          corners = of_mesh.corners[place + cells] - begin;
        make_room(end - first, corners);
        std::copy_n(earlier.mesh->vertices.data() + first, end - first,
                    part_.vertices.data() + count_);
        std::iota(renumbered + first, renumbered + end, base_ + count_);
        const std::uint32_t* const from = earlier.mesh->triangles.data() + begin;
        std::uint32_t* const out = part_.triangles.data() + corners_;
        for (std::size_t k = 0; k < corners; ++k)
            out[k] = renumbered[from[k]] - base_;
        count_ += end - first;
        corners_ += corners;
    }

    /// Notes which vertices of a cell, that an earlier mesh has, have numbers already.
    void know(std::uint32_t x, std::uint32_t y, const MeshCase& of_cell,
              const std::uint32_t* of_earlier, const std::uint32_t* renumbered) {
        std::uint32_t* const table = table_ + std::size_t{y} * row_ + x;
        for (std::size_t k = 0; k < std::size_t{3} * of_cell.triangles; ++k)
            if (const std::uint32_t number = renumbered[of_earlier[k]]; number >= base_)
                table[places_[z_ & 1][of_cell.edges[k]]] = number;
    }

    void add(std::uint32_t x, std::uint32_t y, const MeshCase& of_cell) {
        make_room(kCellEdges, of_cell.edges.size());
        const auto& places = places_[z_ & 1];
        std::uint32_t* const table = table_ + std::size_t{y} * row_ + x;
        const EdgeKey key = key_of(x, y, z_ + first_plane_);
        std::array<std::uint32_t, kCellEdges> numbers;
        unsigned unknown = 0;
        for (std::size_t e = 0; e < kCellEdges; ++e) {
            numbers[e] = table[places[e]];
            unknown |= unsigned{numbers[e] < least_[e]} << e;
        }
        for (unsigned missing = unknown & of_cell.cut & kOldEdges; missing; missing &= missing - 1)
            name(static_cast<std::size_t>(std::countr_zero(missing)), key, places, table, numbers);
        // Without a branch: the entry of an edge that is not cut is overwritten by the next one.
        for (const std::size_t e : kNewEdges) {
            const std::uint32_t cut = of_cell.cut >> e & 1;
            put(key + kEdgePlaces[e].key);
            numbers[e] = base_ + count_;
            table[places[e]] = numbers[e] & (0 - cut);
            count_ += cut;
        }
        constexpr std::size_t kMostOften = 9; // corners that most cells have at most
        std::uint32_t* const out = part_.triangles.data() + corners_;
        for (std::size_t k = 0; k < kMostOften; ++k)
            out[k] = numbers[of_cell.edges[k]] - base_;
        const std::size_t corners = std::size_t{3} * of_cell.triangles;
        for (std::size_t k = kMostOften; k < corners; ++k)
            out[k] = numbers[of_cell.edges[k]] - base_;
        corners_ += corners;
    }

    std::uint32_t vertices() const { return count_; }
    std::size_t corners() const { return corners_; }

  private:
    void make_room(std::size_t vertices, std::size_t corners) {
        const auto fit = [](auto& values, std::size_t count, std::size_t more) {
            if (values.size() < count + more)
                values.resize(values.size() + values.size() / 2 + more);
        };
        fit(part_.vertices, count_, vertices);
        fit(part_.triangles, corners_, corners);
    }
    void name(std::size_t e, EdgeKey key, const std::array<std::size_t, kCellEdges>& places,
              std::uint32_t* table, std::array<std::uint32_t, kCellEdges>& numbers) {
        put(key + kEdgePlaces[e].key);
        numbers[e] = table[places[e]] = base_ + count_++;
    }
    void put(EdgeKey edge) { std::memcpy(&part_.vertices[count_], &edge, sizeof(edge)); }

    std::uint32_t* table_;
    std::uint32_t base_, count_ = 0, begin_ = 0;
    std::size_t corners_ = 0;
    std::uint32_t z_ = ~1u;
    std::size_t row_;
    std::uint32_t first_plane_;
    MeshPart& part_;
    std::array<std::array<std::size_t, kCellEdges>, 2> places_;
    std::array<std::uint32_t, kCellEdges> least_{}; ///< least number of a valid entry
};

CellsOfMesh cells_of(const CellMesh& mesh) {
    const std::array<MeshCase, 256>& cases = mesh_cases();
    CellsOfMesh cells{std::vector<std::uint32_t>(mesh.cases.size() + 1),
                      std::vector<std::uint32_t>(mesh.cases.size() + 1)};
    std::uint32_t corner = 0, vertices = 0;
    for (std::size_t i = 0; i < mesh.cases.size(); ++i) {
        for (const std::uint32_t end = corner + 3u * cases[mesh.cases[i]].triangles; corner < end;
             ++corner)
            vertices = std::max(vertices, mesh.triangles[corner] + 1);
        cells.corners[i + 1] = corner;
        cells.vertices[i + 1] = vertices;
    }
    return cells;
}

/// Finds the cases of cells, taking over those that the earlier mesh has.
void MeshMaker::find_cases_of(const StepValues& values, const Query& query, std::uint64_t cut,
                              std::span<const CellId> ids, const EarlierMesh& earlier,
                              std::span<std::uint8_t> cases) {
    const auto find = [&](std::span<const CellId> some, std::uint8_t* out) {
        visit_value_type(values.type, [&]<class T>(std::type_identity<T>) {
            find_cases<T>(values, query, cut, some, out);
        });
    };
    if (!earlier.mesh)
        return find(ids, cases.data());
    ids_.clear();
    for (std::size_t i = 0; i < ids.size(); ++i)
        if (earlier.has(i))
            cases[i] = earlier.mesh->cases[earlier.places[i]];
        else
            ids_.push_back(ids[i]);
    cases_.resize(ids_.size());
    find(ids_, cases_.data());
    for (std::size_t i = 0, next = 0; i < ids.size(); ++i)
        if (!earlier.has(i))
            cases[i] = cases_[next++];
}

/// After a cell: takes over vertices and colors, or notes those that are new.
/// @param first, end numbers of the vertices that it is the first to have @param corners of the cell
void MeshMaker::finish_cell(const EarlierMesh& earlier, std::size_t cell, std::uint32_t first,
                            std::uint32_t end, std::span<const std::uint32_t> corners,
                            MeshPart& part) {
    if (earlier.has_colors()) {
        if (part.colors.size() < part.vertices.size())
            part.colors.resize(part.vertices.size());
        if (!earlier.has_colors_of(cell))
            add_numbers(first, end, uncolored_);
    }
    if (!earlier.has(cell))
        return add_numbers(first, end, numbers_);
    take_vertices(earlier, cell, first, corners, part);
    const std::uint32_t* const of_earlier = corners_in(earlier, cell);
    for (std::size_t k = 0; k < corners.size(); ++k)
        renumbered_[of_earlier[k]] = tables_.base + corners[k];
}

/// Colors cells that have been taken over together. @param cell the first of them
void MeshMaker::color_run(const EarlierMesh& earlier, std::size_t cell, std::uint32_t first,
                          std::uint32_t end, MeshPart& part) {
    if (!earlier.has_colors())
        return;
    if (part.colors.size() < part.vertices.size())
        part.colors.resize(part.vertices.size());
    if (earlier.has_colors_of(cell))
        std::copy_n(earlier.mesh->colors.data() + earlier.cells->vertices[earlier.places[cell]],
                    end - first, part.colors.data() + first);
    else
        add_numbers(first, end, uncolored_);
}

/// Places the vertices with the numbers that have been noted.
void MeshMaker::place_new(const StepValues& values, const Query& query, std::uint32_t first_plane,
                          std::span<MeshVertex> vertices) {
    vertices_.clear();
    for (const std::uint32_t number : numbers_)
        vertices_.push_back(vertices[number]);
    place_vertices(values, query, first_plane, vertices_);
    for (std::size_t i = 0; i < numbers_.size(); ++i)
        vertices[numbers_[i]] = vertices_[i];
}

void MeshMaker::Tables::fit(const Grid& grid, std::size_t cells) {
    const std::size_t wanted = std::size_t{5} * grid.vertices[0] * grid.vertices[1];
    const std::size_t most = std::size_t{kCellEdges} * (cells + 1);
    if (size >= wanted && most < std::numeric_limits<std::uint32_t>::max() - base)
        return;
    size = std::max(size, wanted);
    numbers = std::make_unique<std::uint32_t[]>(size);
    base = 1; // larger than every entry of the new table
}

bool MeshMaker::make(const StepValues& values, const Query& query, std::span<const CellId> ids,
                     MeshPart& part, std::uint32_t first_plane, const std::stop_token& stop,
                     const EarlierMesh& earlier) {
    part = {};
    uncolored_.clear();
    const auto cut = stored_cut(values.type, values.scaling, query.isovalue);
    if (ids.empty() || !cut)
        return true;
    // Most surfaces need a little less.
    part.vertices.resize(ids.size() + ids.size() / 16);
    part.triangles.resize(3 * (2 * ids.size() + ids.size() / 8));
    part.cases.resize(ids.size());
    tables_.fit(values.grid, ids.size());
    if (earlier.mesh) {
        if (tables_.base == 1) // the table is new
            renumbered_.clear();
        renumbered_.resize(earlier.mesh->vertices.size());
    }
    Pass pass(tables_, values.grid, first_plane, part);
    const std::array<MeshCase, 256>& cases = mesh_cases();
    const CellId plane_cells = values.grid.cells()[0] * values.grid.cells()[1];
    CellWalk walk(values.grid);
    // Plane by plane, so that values are still in the cache when vertices are placed.
    bool stopped = false;
    for (std::size_t i = 0; i < ids.size() && !stopped;) {
        const std::uint32_t z = ids[i] / plane_cells;
        const std::uint64_t end_id = (std::uint64_t{z} + 1) * plane_cells;
        const auto end = static_cast<std::size_t>(
            std::ranges::lower_bound(ids.begin() + static_cast<std::ptrdiff_t>(i), ids.end(),
                                     end_id) -
            ids.begin());
        find_cases_of(values, query, *cut, ids.subspan(i, end - i), earlier.part(i, end - i),
                      std::span(part.cases).subspan(i, end - i));
        const std::uint32_t first = pass.vertices();
        pass.enter_plane(z);
        numbers_.clear();
        // The vertices of the first plane may be those of another part.
        const bool may_run = z > ids.front() / plane_cells;
        while (i < end) {
            const std::uint32_t before = pass.vertices();
            if (const std::size_t run = may_run ? length_of_run(earlier, i, end) : 0) {
                pass.take(earlier, earlier.places[i], run, renumbered_.data());
                color_run(earlier, i, before, pass.vertices(), part);
                i += run;
                continue;
            }
            walk.to(ids[i]);
            const MeshCase& of_cell = cases[part.cases[i]];
            if (earlier.has(i))
                pass.know(walk.x(), walk.y(), of_cell, corners_in(earlier, i), renumbered_.data());
            const std::size_t corner = pass.corners();
            pass.add(walk.x(), walk.y(), of_cell);
            if (earlier.mesh)
                finish_cell(earlier, i, before, pass.vertices(),
                            std::span(part.triangles).subspan(corner, pass.corners() - corner),
                            part);
            ++i;
        }
        if (earlier.mesh)
            place_new(values, query, first_plane, part.vertices);
        else
            place_vertices(values, query, first_plane,
                           std::span(part.vertices).subspan(first, pass.vertices() - first));
        stopped = stop.stop_requested();
    }
    part.triangles.resize(pass.corners());
    part.vertices.resize(pass.vertices());
    part.colors.resize(earlier.has_colors() ? pass.vertices() : 0);
    tables_.base += pass.vertices();
    return !stopped;
}

} // namespace isochron::index
