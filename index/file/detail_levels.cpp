// Makes coarser levels plane by plane: floating-point values are summed along x, then y, then z;
// sums of integers do not depend on the order, and rows of three planes come first.
#include "index/file/detail_levels.h"

#include "index/file/chunks/chunk_grid.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <type_traits>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "index/file/detail_levels.cpp"
#include <hwy/foreach_target.h> // must come before highway.h
#include <hwy/highway.h>

// Plain loops, which the compiler vectorizes for each SIMD target.
HWY_BEFORE_NAMESPACE();
namespace isochron::index::HWY_NAMESPACE {
namespace {

using Taps = Coarsener::Taps;

/// A type for sums with a weight of up to 64.
template <class T>
using Sum = std::conditional_t<
    std::is_floating_point_v<T>, double,
    std::conditional_t<sizeof(T) == 1, std::int16_t,
                       std::conditional_t<sizeof(T) == 2, std::int32_t, std::int64_t>>>;

/// (a + 2 b) + c of rows, without rows that do not exist.
template <class From, class S>
void add_rows(const Taps& taps, const From* middle, std::size_t stride, std::size_t count, S* out) {
    const From* below = taps.below ? middle - stride : middle;
    const From* above = taps.above ? middle + stride : middle;
    if (taps.below && taps.above)
        for (std::size_t i = 0; i < count; ++i)
            out[i] = static_cast<S>((S(below[i]) + 2 * S(middle[i])) + S(above[i]));
    else if (taps.below)
        for (std::size_t i = 0; i < count; ++i)
            out[i] = static_cast<S>(S(below[i]) + 2 * S(middle[i]));
    else
        for (std::size_t i = 0; i < count; ++i)
            out[i] = static_cast<S>(2 * S(middle[i]) + (taps.above ? S(above[i]) : S(0)));
}

template <class From, class S>
void reduce_row(const From* HWY_RESTRICT row, std::uint32_t from, std::uint32_t to,
                S* HWY_RESTRICT out) {
    for (const std::uint32_t x : {0u, to - 1}) {
        const Taps taps(x, from);
        add_rows(taps, row + taps.middle, 1, 1, out + x);
    }
    for (std::uint32_t x = 1; x + 1 < to; ++x)
        out[x] = static_cast<S>((S(row[2 * x - 1]) + 2 * S(row[2 * x])) + S(row[2 * x + 1]));
}

template <class T>
bool has_nan(const T* values, std::size_t count) {
    bool found = false;
    for (std::size_t i = 0; i < count; ++i)
        found |= values[i] != values[i];
    return found;
}

template <class S>
S* room(std::vector<std::uint64_t>& words, std::size_t count) {
    words.resize(std::max(words.size(), (count * sizeof(S) + 7) / 8));
    return reinterpret_cast<S*>(words.data());
}

/// Reduces a plane along x, then y. @param reduced_row writes a row that is reduced along x
template <class S, class Rows>
void reduce_plane(Coarsener::Work& work, const Rows& reduced_row, std::vector<std::uint64_t>& out) {
    const auto& from = work.from;
    const auto& to = work.to;
    S* rows = room<S>(work.rows, std::size_t{to[0]} * from[1]);
    for (std::uint32_t y = 0; y < from[1]; ++y)
        reduced_row(y, rows + std::size_t{y} * to[0]);
    S* sums = room<S>(out, std::size_t{to[0]} * to[1]);
    for (std::uint32_t y = 0; y < to[1]; ++y) {
        const Taps taps(y, from[1]);
        add_rows(taps, rows + std::size_t{taps.middle} * to[0], to[0], to[0],
                 sums + std::size_t{y} * to[0]);
    }
}

template <class T>
void reduce_plane_of(Coarsener::Work& work, const T* plane, Coarsener::Plane& out) {
    using S = Sum<T>;
    const std::size_t length = work.from[0];
    if constexpr (std::is_floating_point_v<T>) {
        out.gaps = has_nan(plane, length * work.from[1]);
        if (out.gaps) {
            S* values = room<S>(work.values, length);
            S* weights = room<S>(work.weights, length);
            reduce_plane<S>(
                work,
                [&](std::uint32_t y, S* to) {
                    const T* row = plane + y * length;
                    for (std::size_t x = 0; x < length; ++x)
                        values[x] = row[x] == row[x] ? static_cast<S>(row[x]) : S(0);
                    reduce_row(values, work.from[0], work.to[0], to);
                },
                out.values);
            reduce_plane<S>(
                work,
                [&](std::uint32_t y, S* to) {
                    const T* row = plane + y * length;
                    for (std::size_t x = 0; x < length; ++x)
                        weights[x] = row[x] == row[x] ? 1 : 0;
                    reduce_row(weights, work.from[0], work.to[0], to);
                },
                out.weights);
            return;
        }
    }
    reduce_plane<S>(
        work,
        [&](std::uint32_t y, S* to) {
            reduce_row(plane + y * length, work.from[0], work.to[0], to);
        },
        out.values);
}

/// Sets the weights of a plane without gaps.
void fill_weights(const Coarsener::Work& work, Coarsener::Plane& plane) {
    double* weights = room<double>(plane.weights, std::size_t{work.to[0]} * work.to[1]);
    for (std::uint32_t y = 0; y < work.to[1]; ++y)
        for (std::uint32_t x = 0; x < work.to[0]; ++x)
            *weights++ = Taps(y, work.from[1]).weight() * Taps(x, work.from[0]).weight();
}

std::int64_t rounded(std::int64_t sum, std::int64_t weight) {
    const std::int64_t a = 2 * sum + weight, b = 2 * weight;
    return a / b - (a % b < 0 ? 1 : 0);
}

/// Makes one plane of the next level.
/// @param planes the reduced planes around it; null for planes that do not exist
template <class T>
void finish_plane(Coarsener::Work& work, const Taps& taps,
                  const std::array<Coarsener::Plane*, 3>& planes, T* out) {
    using S = Sum<T>;
    const std::uint32_t width = work.to[0];
    S* row = room<S>(work.values, std::max(width, work.from[0]));
    S* weight = room<S>(work.weights, std::max(width, work.from[0]));
    bool gaps = false;
    for (const Coarsener::Plane* plane : planes)
        gaps |= plane && plane->gaps;
    if (gaps)
        for (Coarsener::Plane* plane : planes)
            if (plane && !plane->gaps)
                fill_weights(work, *plane);
    // Sums rows of three planes, which are not contiguous in memory.
    const auto sum_of = [&](std::size_t at, auto member, S* to) {
        const auto row_of = [&](std::size_t i) {
            return reinterpret_cast<const S*>((planes[i]->*member).data()) + at;
        };
        const S* HWY_RESTRICT middle = row_of(1);
        const S* below = taps.below ? row_of(0) : middle;
        const S* above = taps.above ? row_of(2) : middle;
        if (taps.below && taps.above)
            for (std::uint32_t x = 0; x < width; ++x)
                to[x] = static_cast<S>((below[x] + 2 * middle[x]) + above[x]);
        else if (taps.below)
            for (std::uint32_t x = 0; x < width; ++x)
                to[x] = static_cast<S>(below[x] + 2 * middle[x]);
        else
            for (std::uint32_t x = 0; x < width; ++x)
                to[x] = static_cast<S>(2 * middle[x] + (taps.above ? above[x] : S(0)));
    };
    for (std::uint32_t y = 0; y < work.to[1]; ++y, out += width) {
        const std::size_t at = std::size_t{y} * width;
        sum_of(at, &Coarsener::Plane::values, row);
        const int yz = taps.weight() * Taps(y, work.from[1]).weight();
        if (gaps) {
            sum_of(at, &Coarsener::Plane::weights, weight);
        } else {
            std::fill_n(weight, width, S(4) * S(yz));
            weight[0] = weight[width - 1] = S(3) * S(yz);
        }
        for (std::uint32_t x = 0; x < width; ++x)
            out[x] = static_cast<T>(row[x] / weight[x]);
    }
}

/// Sums of the rows around one, with weights of 1 or 2 along y and z, without rows that do not
/// exist. @param middle the row
template <class T, class S>
void sum_rows_around(const T* HWY_RESTRICT middle, const Taps& y, const Taps& z, std::size_t row,
                     std::size_t plane, S* HWY_RESTRICT out) {
    if (y.below && y.above && z.below && z.above) {
        const T* const below = middle - plane;
        const T* const above = middle + plane;
        const auto across = [row](const T* at) {
            return (S(at[-static_cast<std::ptrdiff_t>(row)]) + S(at[row])) + 2 * S(at[0]);
        };
        for (std::size_t x = 0; x < row; ++x)
            out[x] =
                static_cast<S>((across(below + x) + across(above + x)) + 2 * across(middle + x));
        return;
    }
    std::fill_n(out, row, S(0));
    for (int dz = z.below ? -1 : 0; dz <= (z.above ? 1 : 0); ++dz)
        for (int dy = y.below ? -1 : 0; dy <= (y.above ? 1 : 0); ++dy) {
            const T* const from = middle + dz * static_cast<std::ptrdiff_t>(plane) +
                                  dy * static_cast<std::ptrdiff_t>(row);
            const auto weight = static_cast<S>(S(dz == 0 ? 2 : 1) * S(dy == 0 ? 2 : 1));
            for (std::size_t x = 0; x < row; ++x)
                out[x] = static_cast<S>(out[x] + weight * S(from[x]));
        }
}

/// Makes one plane of the next level of integers. @param plane in the middle of those around it
template <class T>
void make_plane_of_integers(Coarsener::Work& work, const Taps& z, const T* plane, T* out) {
    using S = Sum<T>;
    const std::size_t length = work.from[0], size = length * work.from[1];
    const std::uint32_t width = work.to[0];
    S* const sums = room<S>(work.rows, length);
    S* const row = room<S>(work.values, width);
    for (std::uint32_t y = 0; y < work.to[1]; ++y, out += width) {
        const Taps taps(y, work.from[1]);
        sum_rows_around(plane + taps.middle * length, taps, z, length, size, sums);
        reduce_row(sums, work.from[0], width, row);
        const int yz = z.weight() * taps.weight();
        if (yz == 16)
            for (std::uint32_t x = 0; x < width; ++x)
                out[x] = static_cast<T>((row[x] + 32) >> 6); // most values have the weight 64
        else
            for (std::uint32_t x = 1; x + 1 < width; ++x)
                out[x] = static_cast<T>(rounded(row[x], 4 * yz));
        for (const std::uint32_t x : {0u, width - 1})
            out[x] = static_cast<T>(rounded(row[x], 3 * yz));
    }
}

template <class T>
void make_planes(Coarsener::Work& work, const T* held, std::uint32_t first, std::uint32_t begin,
                 std::uint32_t end, T* out) {
    const std::size_t size = std::size_t{work.from[0]} * work.from[1];
    for (Coarsener::Plane& plane : work.planes)
        plane.number.reset(); // it may be of another step
    for (std::uint32_t z = begin; z < end; ++z) {
        const Taps taps(z, work.from[2]);
        T* const to = out + std::size_t{z - begin} * work.to[0] * work.to[1];
        if constexpr (std::is_integral_v<T>) {
            make_plane_of_integers(work, taps, held + (taps.middle - first) * size, to);
            continue;
        }
        std::array<Coarsener::Plane*, 3> planes{};
        for (std::uint32_t i = taps.below ? 0 : 1; i < (taps.above ? 3u : 2u); ++i) {
            const std::uint32_t number = taps.middle + i - 1;
            Coarsener::Plane& plane = work.planes[number % 3];
            if (plane.number != number)
                reduce_plane_of(work, held + (number - first) * size, plane);
            plane.number = number;
            planes[i] = &plane;
        }
        finish_plane(work, taps, planes, to);
    }
}

void make_level(ValueType type, Coarsener::Work& work, const std::byte* held, std::uint32_t first,
                std::uint32_t begin, std::uint32_t end, std::byte* out) {
    visit_value_type(type, [&]<class T>(std::type_identity<T>) {
        make_planes(work, reinterpret_cast<const T*>(held), first, begin, end,
                    reinterpret_cast<T*>(out));
    });
}

} // namespace
} // namespace isochron::index::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace isochron::index {

HWY_EXPORT(make_level);

namespace {

/// Vertices of the next level along an axis.
constexpr std::uint32_t coarser(std::uint32_t vertices) {
    return vertices / 2 + 1;
}

} // namespace

std::vector<Grid> detail_grids(const Grid& grid) {
    std::vector<Grid> grids{grid};
    while (std::ranges::any_of(grids.back().vertices,
                               [](std::uint32_t vertices) { return vertices > kChunkEdge; })) {
        Grid next = grids.back();
        for (std::size_t axis = 0; axis < 3; ++axis) {
            next.vertices[axis] = coarser(next.vertices[axis]);
            if (const auto& at = next.positions[axis].distances(); !at.empty()) {
                std::vector<double> kept;
                for (std::size_t i = 0; i + 1 < at.size(); i += 2)
                    kept.push_back(at[i]);
                kept.push_back(at.back());
                next.positions[axis] = AxisPositions(std::move(kept));
            }
        }
        next.spacing *= 2.0;
        grids.push_back(next);
    }
    return grids;
}

Coarsener::Coarsener(ValueType type, const Grid& grid) : type_(type) {
    work_.from = grid.vertices;
    for (std::size_t axis = 0; axis < 3; ++axis)
        work_.to[axis] = coarser(grid.vertices[axis]);
}

std::uint32_t Coarsener::made_of(std::uint32_t planes) const {
    // The last plane of a level is also the last of the next, whether its number is even or odd.
    return planes < work_.from[2] ? (planes + 1) / 2 : work_.to[2];
}

void Coarsener::make(std::span<const std::byte> held, std::uint32_t first, std::uint32_t begin,
                     std::uint32_t end, std::span<std::byte> out) {
    assert(out.size() == (end - begin) * std::size_t{work_.to[0]} * work_.to[1] * size_of(type_));
    HWY_DYNAMIC_DISPATCH(make_level)
    (type_, work_, held.data(), first, begin, end, out.data());
}

} // namespace isochron::index
#endif
