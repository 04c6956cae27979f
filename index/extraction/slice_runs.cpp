// The vertices that a plane through a grid needs.
#include "index/extraction/slice_runs.h"

#include "index/volume/box_cut.h"

#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include <algorithm>
#include <cmath>
#include <type_traits>

namespace isochron::index {
namespace {

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

float share_of(const SliceValues& slice, double stored) {
    const double value = slice.scaling(stored);
    if (!std::isfinite(value))
        return kNoShare;
    const auto [low, high] = slice.whole;
    const double half = high / 2 - low / 2;
    return half > 0 ? static_cast<float>((value / 2 - low / 2) / half) : 0.0f;
}

} // namespace

SliceRuns::SliceRuns(const Grid& grid, const SliceQuery& query) : query_(query) {
    const GridPlane plane(grid, query);
    axis_ = plane.axis;
    outline_ = outline_of(grid, plane);
    if (outline_.empty())
        return;
    along1_ = grid.vertices[static_cast<std::size_t>((plane.axis + 1) % 3)];
    along2_ = grid.vertices[static_cast<std::size_t>((plane.axis + 2) % 3)];
    first_.assign(std::size_t{along1_} * along2_, ~0u);
    last_.assign(first_.size(), 0);
    const int axis = plane.axis, axis1 = (axis + 1) % 3, axis2 = (axis + 2) % 3;
    const double cells = grid.vertices[static_cast<std::size_t>(axis)] - 1;
    // Where the plane meets each column.
    std::vector<double> height(first_.size());
    for (std::uint32_t i2 = 0; i2 < along2_; ++i2)
        for (std::uint32_t i1 = 0; i1 < along1_; ++i1) {
            const double beside = plane.slope[axis1] * grid.distance(axis1, i1) +
                                  plane.slope[axis2] * grid.distance(axis2, i2);
            height[std::size_t{i2} * along1_ + i1] =
                grid.index_at(axis, (plane.at - beside) / plane.slope[axis]);
        }
    for (std::uint32_t i2 = 0; i2 + 1 < along2_; ++i2)
        for (std::uint32_t i1 = 0; i1 + 1 < along1_; ++i1) {
            const std::size_t here = std::size_t{i2} * along1_ + i1;
            const std::array corners{here, here + 1, here + along1_, here + along1_ + 1};
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
                first_[corner] = std::min(first_[corner], from);
                last_[corner] = std::max(last_[corner], to);
            }
        }
    for (std::size_t column = 0; column < first_.size(); ++column)
        if (first_[column] <= last_[column])
            values_ += last_[column] - first_[column] + 1;
}

SliceValues SliceRuns::empty_slice(const std::array<double, 2>& whole, ValueType type,
                                   const Scaling& scaling) const {
    SliceValues slice{.query = query_,
                      .whole = whole,
                      .axis = axis_,
                      .columns = {},
                      .shares = {},
                      .stored = {},
                      .type = type,
                      .scaling = scaling,
                      .outline = outline_};
    slice.columns.resize(columns());
    std::size_t count = 0;
    for (std::size_t column = 0; column < columns(); ++column) {
        slice.columns[column] = {static_cast<std::uint32_t>(count), first_[column]};
        if (first_[column] <= last_[column])
            count += last_[column] - first_[column] + 1;
    }
    slice.shares.resize(count, kNoShare);
    slice.stored.resize(count * size_of(type));
    return slice;
}

std::vector<std::vector<std::uint32_t>> SliceRuns::chunks(const ChunkGrid& chunks) const {
    std::vector<std::vector<bool>> needed(chunks.layers());
    for (std::vector<bool>& layer : needed)
        layer.resize(chunks.chunks_of_layer());
    Vertex at{};
    const auto column_axis = static_cast<std::size_t>(axis_);
    for (std::uint32_t i2 = 0; i2 < along2_; ++i2)
        for (std::uint32_t i1 = 0; i1 < along1_; ++i1) {
            const std::size_t column = std::size_t{i2} * along1_ + i1;
            if (first_[column] > last_[column])
                continue;
            at[(column_axis + 1) % 3] = i1 / kChunkEdge;
            at[(column_axis + 2) % 3] = i2 / kChunkEdge;
            for (std::uint32_t chunk = first_[column] / kChunkEdge;
                 chunk <= last_[column] / kChunkEdge; ++chunk) {
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

template <class T>
void SliceRuns::copy_of(const T* values, const Vertex& low, const Vertex& size,
                        SliceValues& slice) const {
    const std::array<std::size_t, 3> stride{1, size[0], std::size_t{size[0]} * size[1]};
    const auto axis = static_cast<std::size_t>(slice.axis);
    const std::size_t axis1 = (axis + 1) % 3, axis2 = (axis + 2) % 3;
    for (std::uint32_t i2 = 0; i2 < size[axis2]; ++i2)
        for (std::uint32_t i1 = 0; i1 < size[axis1]; ++i1) {
            const std::size_t column = std::size_t{low[axis2] + i2} * along1_ + low[axis1] + i1;
            const std::uint32_t from = std::max(first_[column], low[axis]);
            const std::uint32_t to = std::min(last_[column], low[axis] + size[axis] - 1);
            if (from > to || first_[column] > last_[column])
                continue;
            const T* value = values + i1 * stride[axis1] + i2 * stride[axis2] +
                             (from - low[axis]) * stride[axis];
            const std::size_t place = slice.columns[column].offset + from - first_[column];
            float* into = &slice.shares[place];
            T* stored = reinterpret_cast<T*>(slice.stored.data()) + place;
            for (std::uint32_t i = from; i <= to; ++i, value += stride[axis]) {
                *into++ = share_of(slice, static_cast<double>(*value));
                *stored++ = *value;
            }
        }
}

void SliceRuns::copy(std::span<const std::byte> values, const Vertex& low, const Vertex& size,
                     SliceValues& slice) const {
    visit_value_type(slice.type, [&]<class T>(std::type_identity<T>) {
        copy_of(reinterpret_cast<const T*>(values.data()), low, size, slice);
    });
}

} // namespace isochron::index
