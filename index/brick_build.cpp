// Extremes of bricks: first along y and z, whole rows at a time, then along x, then as ranks.
#include "index/bricks.h"

#include <algorithm>
#include <cassert>
#include <limits>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "index/brick_build.cpp"
#include <hwy/foreach_target.h> // must come before highway.h
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace isochron::index::HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;

/// The smaller one; `a` where `b` is NaN.
template <class V>
HWY_INLINE V lower_of(V a, V b) {
    if constexpr (hwy::IsFloat<hn::TFromV<V>>())
        return hn::IfThenElse(hn::Lt(b, a), b, a);
    else
        return hn::Min(a, b);
}
template <class V>
HWY_INLINE V higher_of(V a, V b) {
    if constexpr (hwy::IsFloat<hn::TFromV<V>>())
        return hn::IfThenElse(hn::Lt(a, b), b, a);
    else
        return hn::Max(a, b);
}

/// What no value lies above, and below; they stay where there are only NaN.
template <class T>
constexpr T kHighest = std::is_floating_point_v<T> ? std::numeric_limits<T>::infinity()
                                                   : std::numeric_limits<T>::max();
template <class T>
constexpr T kLowest = std::is_floating_point_v<T> ? -std::numeric_limits<T>::infinity()
                                                  : std::numeric_limits<T>::lowest();

/// Extremes of `rows` x `planes` vertices for every x below `length`.
template <class D, class T = hn::TFromD<D>>
void reduce_rows(D d, const T* first, std::size_t length, std::size_t plane, std::uint32_t rows,
                 std::uint32_t planes, T* low, T* high) {
    if constexpr (hn::MaxLanes(D()) > 1)
        if (length < hn::Lanes(d))
            return reduce_rows(hn::Half<D>(), first, length, plane, rows, planes, low, high);
    for (std::size_t at = 0; at < length; at += hn::Lanes(d)) {
        const std::size_t x = std::min(at, length - hn::Lanes(d)); // the last vector may overlap
        auto lowest = hn::Set(d, kHighest<T>), highest = hn::Set(d, kLowest<T>);
        for (std::uint32_t z = 0; z < planes; ++z)
            for (std::uint32_t y = 0; y < rows; ++y) {
                const auto values = hn::LoadU(d, first + z * plane + y * length + x);
                lowest = lower_of(lowest, values);
                highest = higher_of(highest, values);
            }
        hn::StoreU(lowest, d, low + x);
        hn::StoreU(highest, d, high + x);
    }
}

template <class T>
void build_values(const StepValues& values, const LevelMap& levels, std::size_t step,
                  std::span<std::uint8_t> out) {
    constexpr auto kCells = BrickGrid::kCells;
    const BrickGrid grid(values.grid);
    const auto [bricks_x, bricks_y, bricks_z] = grid.bricks();
    const auto [nx, ny, nz] = values.grid.vertices;
    const std::size_t plane = std::size_t{nx} * ny;
    const T* s = values.step<T>(step).data();
    // A brick's last vertex is the first of the next one; behind the border the last one repeats.
    std::vector<T> low(bricks_x * kCells[0] + 1), high(low.size());
    std::vector<T> extremes(2 * grid.count());
    T* lowest = extremes.data();
    T* highest = lowest + grid.count();
    for (std::uint32_t bz = 0; bz < bricks_z; ++bz)
        for (std::uint32_t by = 0; by < bricks_y; ++by) {
            const std::uint32_t y = by * kCells[1], z = bz * kCells[2];
            const std::uint32_t rows = std::min(kCells[1] + 1, ny - y);
            const std::uint32_t planes = std::min(kCells[2] + 1, nz - z);
            const T* first = s + z * plane + std::size_t{y} * nx;
            reduce_rows(hn::ScalableTag<T>(), first, nx, plane, rows, planes, low.data(),
                        high.data());
            std::fill(low.begin() + nx, low.end(), low[nx - 1]);
            std::fill(high.begin() + nx, high.end(), high[nx - 1]);
            for (std::uint32_t bx = 0; bx < bricks_x; ++bx) {
                const T* column_low = low.data() + bx * kCells[0];
                const T* column_high = high.data() + bx * kCells[0];
                *lowest++ = *std::min_element(column_low, column_low + kCells[0] + 1);
                *highest++ = *std::max_element(column_high, column_high + kCells[0] + 1);
            }
        }
    levels.ranks(std::as_bytes(std::span<const T>(extremes)), out);
    for (std::size_t i = 0; i < grid.count(); ++i)
        if (extremes[i] > extremes[grid.count() + i]) {
            out[i] = 255;
            out[grid.count() + i] = 0;
        }
}

void build_step(const StepValues& values, const LevelMap& levels, std::size_t step,
                std::span<std::uint8_t> out) {
    visit_value_type(values.type, [&]<class T>(std::type_identity<T>) {
        build_values<T>(values, levels, step, out);
    });
}

} // namespace
} // namespace isochron::index::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace isochron::index {

HWY_EXPORT(build_step);

void build_bricks(const StepValues& values, const LevelMap& levels, std::size_t step,
                  std::span<std::uint8_t> out) {
    assert(step < values.steps && levels.type() == values.type);
    assert(out.size() == BrickGrid(values.grid).bytes_per_step());
    HWY_DYNAMIC_DISPATCH(build_step)(values, levels, step, out);
}

} // namespace isochron::index
#endif
