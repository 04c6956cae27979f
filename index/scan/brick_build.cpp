// Extremes of bricks: along y and z by whole rows, in the order of the file, then along x; then
// turns them into ranks.
#include "index/scan/bricks.h"

#include <algorithm>
#include <cassert>
#include <limits>
#include <utility>
#include <vector>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "index/scan/brick_build.cpp"
#include <hwy/foreach_target.h> // must come before highway.h
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace isochron::index::HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;

/// The smaller value; `a` if `b` is NaN.
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

/// Bounds of all values; they remain as extremes where there are only NaN.
template <class T>
constexpr T kHighest = std::is_floating_point_v<T> ? std::numeric_limits<T>::infinity()
                                                   : std::numeric_limits<T>::max();
template <class T>
constexpr T kLowest = std::is_floating_point_v<T> ? -std::numeric_limits<T>::infinity()
                                                  : std::numeric_limits<T>::lowest();

/// Extremes of the vertices of some rows, for every x.
template <class T>
struct RowExtremes {
    explicit RowExtremes(std::size_t length) : low(length), high(length) {}

    /// Takes the extremes over `rows` rows of `length` vertices.
    template <class D>
    void reduce(D d, const T* first, std::uint32_t rows, std::size_t length) {
        if constexpr (hn::MaxLanes(D()) > 1)
            if (length < hn::Lanes(d))
                return reduce(hn::Half<D>(), first, rows, length);
        for (std::size_t at = 0; at < length; at += hn::Lanes(d)) {
            const std::size_t x = std::min(at, length - hn::Lanes(d)); // the last may overlap
            auto lowest = hn::Set(d, kHighest<T>), highest = hn::Set(d, kLowest<T>);
            for (std::uint32_t row = 0; row < rows; ++row) {
                const auto values = hn::LoadU(d, first + row * length + x);
                lowest = lower_of(lowest, values);
                highest = higher_of(highest, values);
            }
            hn::StoreU(lowest, d, low.data() + x);
            hn::StoreU(highest, d, high.data() + x);
        }
    }

    void include(const RowExtremes& other) {
        const hn::ScalableTag<T> d;
        for (std::size_t x = 0; x + hn::Lanes(d) <= low.size(); x += hn::Lanes(d)) {
            hn::StoreU(lower_of(hn::LoadU(d, low.data() + x), hn::LoadU(d, other.low.data() + x)),
                       d, low.data() + x);
            hn::StoreU(
                higher_of(hn::LoadU(d, high.data() + x), hn::LoadU(d, other.high.data() + x)), d,
                high.data() + x);
        }
    }

    std::vector<T> low, high;
};

template <class T>
void build_values(const StepValues& values, const LevelMap& levels, std::size_t step,
                  std::span<std::uint8_t> out) {
    constexpr auto kCells = BrickGrid::kCells;
    const BrickGrid grid(values.grid);
    const auto [nx, ny, nz] = values.grid.vertices;
    // Beyond the border the last vertex repeats. Neighboring bricks share a vertex.
    const std::size_t used = grid.bricks()[0] * kCells[0] + 1;
    const std::size_t length = hwy::RoundUpTo(used, hn::Lanes(hn::ScalableTag<T>()));
    RowExtremes<T> rows(length);
    std::vector<RowExtremes<T>> layer(grid.bricks()[1], rows);
    std::vector<T> extremes(2 * grid.count());
    T* lowest = extremes.data();
    T* highest = lowest + grid.count();
    const T* plane = values.step<T>(step).data();
    for (std::uint32_t z = 0; z < nz; ++z, plane += std::size_t{nx} * ny) {
        // The plane between two layers of bricks belongs to both.
        const bool begins = z % kCells[2] == 0, ends = z > 0 && (begins || z + 1 == nz);
        for (std::uint32_t by = 0; by < grid.bricks()[1]; ++by) {
            const std::uint32_t y = by * kCells[1];
            rows.reduce(hn::ScalableTag<T>(), plane + std::size_t{y} * nx,
                        std::min(kCells[1] + 1, ny - y), nx);
            if (z > 0)
                layer[by].include(rows);
            if (ends) {
                auto& [low, high] = layer[by];
                std::fill(low.begin() + nx, low.begin() + used, low[nx - 1]);
                std::fill(high.begin() + nx, high.begin() + used, high[nx - 1]);
                for (std::size_t x = 0; x + 1 < used; x += kCells[0]) {
                    *lowest++ = *std::min_element(&low[x], &low[x] + kCells[0] + 1);
                    *highest++ = *std::max_element(&high[x], &high[x] + kCells[0] + 1);
                }
            }
            if (begins)
                std::swap(layer[by], rows);
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
