// Finds the runs of vertices above and below, from a mesh or from values.
#include "index/measure/vertex_sides.h"

#include "index/surface/mesh_cases.h"
#include "index/volume/ordinal.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <numeric>
#include <ranges>

namespace isochron::index {

std::array<std::uint32_t, 3> cell_of_mesh(const MeshVertex& first_vertex, std::uint8_t of_cell) {
    const unsigned edge = mesh_cases()[of_cell].edges[0];
    const std::size_t axis = edge / 4;
    std::array<std::uint32_t, 3> at{first_vertex.x, first_vertex.y, first_vertex.z};
    at[axis == 0 ? 1 : 0] -= edge % 2;
    at[axis == 2 ? 1 : 2] -= edge / 2 % 2;
    return at;
}

VertexSides::VertexSides(const Grid& grid) : grid_(grid) {
    const std::size_t rows = std::size_t{grid.vertices[1]} * grid.vertices[2];
    above_.ends.reserve(rows);
    below_.ends.reserve(rows);
}

void VertexSides::end_row() {
    above_.ends.push_back(static_cast<std::uint32_t>(above_.runs.size()));
    below_.ends.push_back(static_cast<std::uint32_t>(below_.runs.size()));
}

/// Follows the cut edges from vertex to vertex: each leads to the other side.
class VertexSides::OfMesh {
  public:
    OfMesh(const CellMesh& mesh, const Grid& grid)
        : ny_(grid.vertices[1]), rows_(std::size_t{ny_} * grid.vertices[2]), cut_up_(rows_),
          cut_deep_(grid.vertices[2]), ends_(rows_ + 1) {
        for (const MeshVertex& vertex : mesh.vertices)
            if (vertex.axis == 0)
                ++ends_[row(vertex.y, vertex.z) + 1];
            else if (vertex.x == 0 && vertex.axis == 1)
                cut_up_[row(vertex.y, vertex.z)] = 1;
            else if (vertex.x == 0 && vertex.y == 0)
                cut_deep_[vertex.z] = 1;
        std::partial_sum(ends_.begin(), ends_.end(), ends_.begin());
        cuts_.resize(ends_.back());
        std::vector<std::uint32_t> next(ends_.begin(), ends_.end() - 1);
        for (const MeshVertex& vertex : mesh.vertices)
            if (vertex.axis == 0)
                cuts_[next[row(vertex.y, vertex.z)]++] = vertex.x;
        for (std::size_t i = 0; i < rows_; ++i)
            std::sort(cuts_.begin() + ends_[i], cuts_.begin() + ends_[i + 1]);
    }

    /// The lower ends of the cut edges along x in a row, ascending.
    std::span<const std::uint16_t> cuts(std::size_t row) const {
        return std::span(cuts_).subspan(ends_[row], ends_[row + 1] - ends_[row]);
    }
    /// Whether the vertices at (0, y, z) and at the grid's corner are on different sides.
    std::vector<std::uint8_t> starts() const {
        std::vector<std::uint8_t> sides(rows_);
        std::uint8_t corner = 0;
        for (std::size_t first = 0, z = 0; first < rows_; first += ny_, ++z) {
            std::uint8_t side = corner;
            for (std::size_t i = first; i < first + ny_; ++i) {
                sides[i] = side;
                side ^= cut_up_[i];
            }
            corner ^= cut_deep_[z];
        }
        return sides;
    }

  private:
    std::size_t row(std::size_t y, std::size_t z) const { return z * ny_ + y; }

    std::uint32_t ny_;
    std::size_t rows_;
    std::vector<std::uint8_t> cut_up_;   ///< by row: whether the edge along y at x = 0 is cut
    std::vector<std::uint8_t> cut_deep_; ///< by z: whether the edge along z at x = y = 0 is cut
    std::vector<std::uint32_t> ends_;    ///< where the cuts of each row begin
    std::vector<std::uint16_t> cuts_;
};

VertexSides VertexSides::of_mesh(const CellMesh& mesh, const Grid& grid, bool all_above) {
    VertexSides sides(grid);
    const OfMesh cut(mesh, grid);
    const std::vector<std::uint8_t> starts = cut.starts();
    bool corner_above = all_above;
    if (!mesh.cases.empty()) {
        // Bit 0 of a case is the side of the cell's lowest vertex: from there back to the corner.
        const auto [x, y, z] = cell_of_mesh(mesh.vertices[mesh.triangles[0]], mesh.cases[0]);
        const std::size_t row = sides.row(y, z);
        const auto between = std::ranges::count_if(cut.cuts(row), [x](auto at) { return at < x; });
        corner_above = ((mesh.cases[0] ^ starts[row] ^ between) & 1) != 0;
    }
    for (std::size_t row = 0; row < starts.size(); ++row) {
        bool above = corner_above != (starts[row] != 0);
        std::uint32_t begin = 0;
        const auto add = [&](std::uint32_t end) {
            (above ? sides.above_ : sides.below_).runs.push_back({begin, end});
            begin = end;
            above = !above;
        };
        for (const std::uint32_t at : cut.cuts(row))
            add(at + 1);
        add(grid.vertices[0]);
        sides.end_row();
    }
    return sides;
}

template <class T>
void VertexSides::add_row(const T* values, T least, bool upper_is_above) {
    const std::uint32_t count = grid_.vertices[0];
    const auto side = [&](T value) {
        return is_nan(value) ? 0 : (value >= least) == upper_is_above ? 1 : 2;
    };
    for (std::uint32_t begin = 0, end; begin < count; begin = end) {
        const int here = side(values[begin]);
        for (end = begin + 1; end < count && side(values[end]) == here;)
            ++end;
        if (here != 0)
            (here == 1 ? above_ : below_).runs.push_back({begin, end});
    }
    end_row();
}

namespace {

/// Calls `plane(values)` with the stored values of each plane of vertices along z.
template <class T, class F>
void for_each_plane(const StepView& step, const std::stop_token& stop, F&& plane) {
    const auto [nx, ny, nz] = step.grid().vertices;
    const std::size_t area = std::size_t{nx} * ny;
    if (!step.by_chunks()) {
        const T* const values = step.whole(stop).values.template step<T>(step.at().step).data();
        for (std::size_t z = 0; z < nz; ++z)
            plane(values + z * area);
        return;
    }
    const ChunkGrid& chunks = step.chunk_grid();
    std::vector<std::uint32_t> places(chunks.chunks_of_layer());
    std::iota(places.begin(), places.end(), 0u);
    std::vector<T> values(area * kChunkEdge);
    for (std::uint32_t layer = 0; layer < chunks.layers(); ++layer) {
        const std::vector<ChunkPtr> read = step.chunks(layer, places, stop);
        std::uint32_t planes = 0;
        for (const std::uint32_t place : places) {
            const auto [cx, cy] = chunks.at(place);
            const auto [width, height, depth] = read[place]->size;
            const std::byte* from = read[place]->values.data();
            planes = depth;
            for (std::size_t z = 0; z < depth; ++z)
                for (std::size_t y = 0; y < height; ++y, from += width * sizeof(T))
                    std::memcpy(&values[z * area + (cy * kChunkEdge + y) * nx + cx * kChunkEdge],
                                from, width * sizeof(T));
        }
        for (std::uint32_t z = 0; z < planes; ++z)
            plane(values.data() + z * area);
    }
}

} // namespace

VertexSides VertexSides::within(const VertexBox& box, const Grid& part) const {
    VertexSides sides(part);
    const auto add = [&](std::span<const Run> runs, Rows& to) {
        for (const Run& run : runs) {
            const std::uint32_t begin = std::max(run.begin, box.first[0]),
                                end = std::min(run.end, box.last[0] + 1);
            if (begin < end)
                to.runs.push_back({begin - box.first[0], end - box.first[0]});
        }
    };
    for (std::uint32_t z = box.first[2]; z <= box.last[2]; ++z)
        for (std::uint32_t y = box.first[1]; y <= box.last[1]; ++y) {
            add(above(y, z), sides.above_);
            add(below(y, z), sides.below_);
            sides.end_row();
        }
    return sides;
}

VertexSides VertexSides::left_by(const PlaneCut& plane) const {
    VertexSides sides(grid_);
    const auto places = std::views::iota(0u, grid_.vertices[0]);
    for (std::uint32_t z = 0; z < grid_.vertices[2]; ++z)
        for (std::uint32_t y = 0; y < grid_.vertices[1]; ++y) {
            const auto is_left = [&](std::uint32_t x) {
                return plane.beyond(
                           {grid_.distance(0, x), grid_.distance(1, y), grid_.distance(2, z)}) <= 0;
            };
            // Along a row, those that are left are at one end of it.
            const bool starts = is_left(0);
            const auto end = static_cast<std::uint32_t>(
                std::ranges::partition_point(
                    places, [&](std::uint32_t x) { return is_left(x) == starts; }) -
                places.begin());
            const Run left = starts ? Run{0, end} : Run{end, grid_.vertices[0]};
            const auto add = [&](std::span<const Run> runs, Rows& to) {
                for (const Run& run : runs)
                    if (std::max(run.begin, left.begin) < std::min(run.end, left.end))
                        to.runs.push_back(
                            {std::max(run.begin, left.begin), std::min(run.end, left.end)});
            };
            add(above(y, z), sides.above_);
            add(below(y, z), sides.below_);
            sides.end_row();
        }
    return sides;
}

VertexSides VertexSides::of_values(const StepView& step, double isovalue,
                                   const std::stop_token& stop) {
    VertexSides sides(step.grid());
    visit_value_type(step.type(), [&]<class T>(std::type_identity<T>) {
        const auto cut = step.stored_cut(isovalue);
        const bool upper_is_above = step.scaling().slope > 0;
        // Without a cut all values are on one side: that of zero, which every type has.
        const bool above = cut ? upper_is_above : step.scaling()(0.0) >= isovalue;
        const T least = cut ? from_ordinal<T>(static_cast<Ordinal<T>>(*cut))
                            : from_ordinal<T>(lowest_ordinal<T>());
        for_each_plane<T>(step, stop, [&](const T* plane) {
            stop_if_asked(stop);
            for (std::uint32_t y = 0; y < step.grid().vertices[1]; ++y)
                sides.add_row(plane + std::size_t{y} * step.grid().vertices[0], least, above);
        });
    });
    return sides;
}

} // namespace isochron::index
