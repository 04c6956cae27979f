// The values on a plane through an array.
#include "index/extraction/slice_values.h"

#include "index/error.h"
#include "index/file/step_view.h"
#include "index/volume/box_cut.h"

#include <fmt/format.h>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <span>

namespace isochron::index {
namespace {

using Vertex = std::array<std::uint32_t, 3>;

/// So many cells beyond what the plane cuts are held, so that single precision finds its cells.
constexpr double kRounding = 1.0 / 256;

/// A plane in distances along the grid's axes: `slope` times them is `at`.
struct GridPlane {
    glm::dvec3 slope;
    double at;
    int axis; ///< the one that the plane is most across, measured in mean cells

    GridPlane(const Grid& grid, const SliceQuery& query)
        : slope(glm::transpose(grid.direction) * query.normal),
          at(glm::dot(query.point - grid.origin, query.normal)), axis(0) {
        for (int other = 1; other < 3; ++other)
            if (std::abs(slope[other] * grid.spacing[other]) >
                std::abs(slope[axis] * grid.spacing[axis]))
                axis = other;
    }
};

/// Runs of vertices along one axis.
struct Runs {
    std::uint32_t along1, along2;           ///< columns along the two other axes
    std::vector<std::uint32_t> first, last; ///< vertices; first > last: none

    Runs(const Grid& grid, const GridPlane& plane)
        : along1(grid.vertices[static_cast<std::size_t>((plane.axis + 1) % 3)]),
          along2(grid.vertices[static_cast<std::size_t>((plane.axis + 2) % 3)]),
          first(std::size_t{along1} * along2, ~0u), last(first.size(), 0) {
        const int axis = plane.axis, axis1 = (axis + 1) % 3, axis2 = (axis + 2) % 3;
        const double cells = grid.vertices[static_cast<std::size_t>(axis)] - 1;
        // Where the plane meets each column.
        std::vector<double> height(first.size());
        for (std::uint32_t i2 = 0; i2 < along2; ++i2)
            for (std::uint32_t i1 = 0; i1 < along1; ++i1) {
                const double beside = plane.slope[axis1] * grid.distance(axis1, i1) +
                                      plane.slope[axis2] * grid.distance(axis2, i2);
                height[std::size_t{i2} * along1 + i1] =
                    grid.index_at(axis, (plane.at - beside) / plane.slope[axis]);
            }
        for (std::uint32_t i2 = 0; i2 + 1 < along2; ++i2)
            for (std::uint32_t i1 = 0; i1 + 1 < along1; ++i1) {
                const std::size_t here = std::size_t{i2} * along1 + i1;
                const std::array corners{here, here + 1, here + along1, here + along1 + 1};
                double low = height[here], high = low;
                for (const std::size_t corner : corners) {
                    low = std::min(low, height[corner]);
                    high = std::max(high, height[corner]);
                }
                if (!(high >= -kRounding && low <= cells + kRounding))
                    continue;
                const auto cell_at = [&](double at) {
                    return static_cast<std::uint32_t>(std::clamp(std::floor(at), 0.0, cells - 1));
                };
                const std::uint32_t from = cell_at(low - kRounding);
                const std::uint32_t to = cell_at(high + kRounding) + 1;
                for (const std::size_t corner : corners) {
                    first[corner] = std::min(first[corner], from);
                    last[corner] = std::max(last[corner], to);
                }
            }
    }
};

/// The polygon in which the plane cuts the box; a plane on a face of the box cuts it, too.
std::vector<glm::dvec3> outline_of(const Grid& grid, const GridPlane& plane) {
    glm::dvec3 size;
    for (int axis = 0; axis < 3; ++axis)
        size[axis] = grid.vertices[static_cast<std::size_t>(axis)] - 1;
    const glm::dvec3 slope = plane.slope * grid.spacing;
    double low = -plane.at, high = low;
    for (int axis = 0; axis < 3; ++axis)
        (slope[axis] < 0 ? low : high) += slope[axis] * size[axis];
    const double tiny = 1e-9 * (high - low);
    double at = plane.at;
    if (std::abs(low) <= tiny)
        at += low + tiny;
    else if (std::abs(high) <= tiny)
        at += high - tiny;
    return in_order(
        edges_cut(size, [&](const glm::dvec3& place) { return glm::dot(slope, place) - at; }),
        glm::normalize(slope));
}

/// Copies the parts of runs that lie in a block of stored values.
class Filling {
  public:
    Filling(SliceValues& slice, const Runs& runs) : slice_(slice), runs_(runs) {}

    /// @param values [z][y][x], x fastest @param low its first vertex
    void copy(std::span<const std::byte> values, const Vertex& low, const Vertex& size) const {
        visit_value_type(slice_.type, [&]<class T>(std::type_identity<T>) {
            copy_of(reinterpret_cast<const T*>(values.data()), low, size);
        });
    }

  private:
    float share(double stored) const {
        const double value = slice_.scaling(stored);
        if (!std::isfinite(value))
            return kNoShare;
        const auto [low, high] = slice_.whole;
        const double half = high / 2 - low / 2;
        return half > 0 ? static_cast<float>((value / 2 - low / 2) / half) : 0.0f;
    }

    template <class T>
    void copy_of(const T* values, const Vertex& low, const Vertex& size) const {
        const std::array<std::size_t, 3> stride{1, size[0], std::size_t{size[0]} * size[1]};
        const auto axis = static_cast<std::size_t>(slice_.axis);
        const std::size_t axis1 = (axis + 1) % 3, axis2 = (axis + 2) % 3;
        for (std::uint32_t i2 = 0; i2 < size[axis2]; ++i2)
            for (std::uint32_t i1 = 0; i1 < size[axis1]; ++i1) {
                const std::size_t column =
                    std::size_t{low[axis2] + i2} * runs_.along1 + low[axis1] + i1;
                const std::uint32_t from = std::max(runs_.first[column], low[axis]);
                const std::uint32_t to = std::min(runs_.last[column], low[axis] + size[axis] - 1);
                if (from > to || runs_.first[column] > runs_.last[column])
                    continue;
                const T* value = values + i1 * stride[axis1] + i2 * stride[axis2] +
                                 (from - low[axis]) * stride[axis];
                const std::size_t place =
                    slice_.columns[column].offset + from - runs_.first[column];
                float* into = &slice_.shares[place];
                T* stored = reinterpret_cast<T*>(slice_.stored.data()) + place;
                for (std::uint32_t i = from; i <= to; ++i, value += stride[axis]) {
                    *into++ = share(static_cast<double>(*value));
                    *stored++ = *value;
                }
            }
    }

    SliceValues& slice_;
    const Runs& runs_;
};

/// The chunks that hold vertices of the runs: by layer, their places, ascending.
std::vector<std::vector<std::uint32_t>> needed_chunks(const ChunkGrid& chunks, const Runs& runs,
                                                      int axis) {
    std::vector<std::vector<bool>> needed(chunks.layers());
    for (std::vector<bool>& layer : needed)
        layer.resize(chunks.chunks_of_layer());
    Vertex at{};
    const auto column_axis = static_cast<std::size_t>(axis);
    for (std::uint32_t i2 = 0; i2 < runs.along2; ++i2)
        for (std::uint32_t i1 = 0; i1 < runs.along1; ++i1) {
            const std::size_t column = std::size_t{i2} * runs.along1 + i1;
            if (runs.first[column] > runs.last[column])
                continue;
            at[(column_axis + 1) % 3] = i1 / kChunkEdge;
            at[(column_axis + 2) % 3] = i2 / kChunkEdge;
            for (std::uint32_t chunk = runs.first[column] / kChunkEdge;
                 chunk <= runs.last[column] / kChunkEdge; ++chunk) {
                at[column_axis] = chunk;
                needed[at[2]][chunks.place(at[0], at[1])] = true;
            }
        }
    std::vector<std::vector<std::uint32_t>> places(needed.size());
    for (std::size_t layer = 0; layer < needed.size(); ++layer)
        for (std::uint32_t place = 0; place < needed[layer].size(); ++place)
            if (needed[layer][place])
                places[layer].push_back(place);
    return places;
}

} // namespace

SliceValues slice_values(const IndexFile& array, const SliceQuery& query,
                         const std::stop_token& stop) {
    const Grid& grid = array.info().grid;
    const GridPlane plane(grid, query);
    SliceValues slice{.query = query,
                      .whole = {array.stats().low, array.stats().high},
                      .axis = plane.axis,
                      .columns = {},
                      .shares = {},
                      .stored = {},
                      .type = {},
                      .scaling = {},
                      .outline = outline_of(grid, plane)};
    if (slice.outline.empty())
        return slice;
    // Small steps are read as a whole, of others only the chunks that the plane cuts.
    const StepView step =
        array.referral() ? step_of(array, query.instant) : part_of_step(array, query.instant);
    slice.type = step.type();
    slice.scaling = step.scaling();
    const Runs runs(grid, plane);
    slice.columns.resize(runs.first.size());
    std::size_t count = 0;
    for (std::size_t column = 0; column < slice.columns.size(); ++column) {
        slice.columns[column] = {static_cast<std::uint32_t>(count), runs.first[column]};
        if (runs.first[column] <= runs.last[column])
            count += runs.last[column] - runs.first[column] + 1;
    }
    if (std::max(count, slice.columns.size()) > kMostSliceValues)
        throw Error(fmt::format("{}: a slice of {} values, expected at most {}", array.name(),
                                std::max(count, slice.columns.size()), kMostSliceValues));
    slice.shares.resize(count, kNoShare);
    slice.stored.resize(count * size_of(slice.type));
    const Filling filling(slice, runs);
    if (!step.by_chunks()) {
        const LoadedStep& whole = step.whole(stop);
        filling.copy(whole.values.step_bytes(step.at().step), {0, 0, 0}, grid.vertices);
        return slice;
    }
    const ChunkGrid& chunks = step.chunk_grid();
    const auto places = needed_chunks(chunks, runs, slice.axis);
    step.expect(0, places);
    for (std::uint32_t layer = 0; layer < chunks.layers(); ++layer) {
        if (places[layer].empty())
            continue;
        const std::vector<ChunkPtr> read = step.chunks(layer, places[layer], stop);
        for (std::size_t i = 0; i < read.size(); ++i) {
            const auto [x, y] = chunks.at(places[layer][i]);
            filling.copy(read[i]->values, {x * kChunkEdge, y * kChunkEdge, layer * kChunkEdge},
                         read[i]->size);
        }
    }
    return slice;
}

std::optional<double> value_on(const SliceValues& slice, const Grid& grid, const glm::dvec3& at) {
    constexpr double kBeside = 1e-6; // cells: rounding of places on the box's faces
    if (slice.columns.empty())
        return std::nullopt;
    const glm::dvec3 place = grid.index_of(at);
    const auto cells = grid.cells();
    Vertex cell{};
    std::array<double, 3> local{};
    for (int axis = 0; axis < 3; ++axis) {
        const auto a = static_cast<std::size_t>(axis);
        const double last = cells[a];
        if (!(place[axis] >= -kBeside && place[axis] <= last + kBeside))
            return std::nullopt;
        cell[a] = static_cast<std::uint32_t>(std::clamp(std::floor(place[axis]), 0.0, last - 1));
        local[a] = std::clamp(place[axis] - cell[a], 0.0, 1.0);
    }
    const auto axis = static_cast<std::size_t>(slice.axis);
    const std::size_t axis1 = (axis + 1) % 3, axis2 = (axis + 2) % 3;
    double sum = 0;
    for (unsigned corner = 0; corner < 8; ++corner) {
        const std::array<unsigned, 3> up{corner & 1, corner >> 1 & 1, corner >> 2};
        const std::size_t column =
            std::size_t{cell[axis2] + up[2]} * grid.vertices[axis1] + cell[axis1] + up[1];
        const SliceValues::Column& run = slice.columns[column];
        const std::size_t end = column + 1 < slice.columns.size() ? slice.columns[column + 1].offset
                                                                  : slice.shares.size();
        const std::size_t along = cell[axis] + up[0];
        if (along < run.first || run.offset + along - run.first >= end)
            return std::nullopt;
        const float share = slice.shares[run.offset + along - run.first];
        if (share == kNoShare)
            return std::nullopt;
        sum += double{share} * (up[0] ? local[axis] : 1 - local[axis]) *
               (up[1] ? local[axis1] : 1 - local[axis1]) *
               (up[2] ? local[axis2] : 1 - local[axis2]);
    }
    return slice.whole[0] + 2 * sum * (slice.whole[1] / 2 - slice.whole[0] / 2);
}

} // namespace isochron::index
