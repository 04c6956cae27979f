// Which places of a step lie behind a surface, blurred.
#include "index/extraction/surroundings.h"

#include "index/volume/ordinal.h"
#include "index/volume/stored_cut.h"

#include <algorithm>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "index/extraction/surroundings.cpp"
#include <hwy/foreach_target.h> // must come before highway.h

#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace isochron::index::HWY_NAMESPACE {
namespace {

using Size = std::array<std::uint32_t, 3>;

/// A sum takes in a place and its two neighbors on either side along an axis.
constexpr std::uint32_t kHalf = kSurroundingsReach / 2;
constexpr std::uint32_t kWidth = 2 * kHalf + 1;

/// Sums of five rows, place by place. The sums of all six passes are whole numbers that fit their
/// types, so that nothing is rounded before the end.
template <class From, class To>
void sum_of(const std::array<const From*, kWidth>& rows, std::size_t lanes, To* __restrict to) {
    const auto [a, b, c, d, e] = rows;
    for (std::size_t i = 0; i < lanes; ++i)
        to[i] = static_cast<To>(a[i] + b[i] + c[i] + d[i] + e[i]);
}

/// Blurs which places are behind a surface, plane after plane of places, so that all that is worked
/// on stays in the nearest cache.
class Blur {
  public:
    explicit Blur(const Size& size)
        : size_(size), plane_(std::size_t{size[0]} * size[1]), along_z_(kWidth * plane_),
          bytes_(2 * plane_), row_(size[0] + 2 * kHalf), words_(row_ * size[1]),
          words_again_(row_ * size[1]) {}

    /// @param field 1 where a place is behind the surface, else 0; then 255 times the shares
    void apply(std::span<std::uint8_t> field) {
        for (std::uint32_t z = 0, ready = 0; z < size_[2]; ++z) {
            for (; ready < std::min(z + kHalf + 1, size_[2]); ++ready)
                sum_of(near(field.data(), plane_, ready, size_[2]), plane_,
                       along_z_.data() + ready % kWidth * plane_);
            std::array<const std::uint8_t*, kWidth> planes{};
            for (std::uint32_t k = 0; k < kWidth; ++k)
                planes[k] = along_z_.data() + neighbor(z, k, size_[2]) % kWidth * plane_;
            sum_of(planes, plane_, bytes_.data());
            along_y();
            along_x(field.data() + z * plane_);
        }
    }

  private:
    /// The k-th of the five places around place i, of `count` in a row; a place beyond an end
    /// counts as the place at the end.
    static std::uint32_t neighbor(std::uint32_t i, std::uint32_t k, std::uint32_t count) {
        return std::min(std::max(i + k, kHalf) - kHalf, count - 1);
    }
    template <class T>
    static std::array<const T*, kWidth> near(const T* first, std::size_t apart, std::uint32_t i,
                                             std::uint32_t count) {
        std::array<const T*, kWidth> rows{};
        for (std::uint32_t k = 0; k < kWidth; ++k)
            rows[k] = first + neighbor(i, k, count) * apart;
        return rows;
    }

    void along_y() {
        std::uint8_t* const once = bytes_.data() + plane_;
        for (std::uint32_t y = 0; y < size_[1]; ++y)
            sum_of(near(bytes_.data(), size_[0], y, size_[1]), size_[0],
                   once + std::size_t{y} * size_[0]);
        for (std::uint32_t y = 0; y < size_[1]; ++y)
            sum_of(near(once, size_[0], y, size_[1]), size_[0], words_.data() + y * row_ + kHalf);
    }

    /// The whole plane at a time: what was written is not read again at once, which would stall.
    void along_x(std::uint8_t* to) {
        sum_of_neighbors(words_, words_again_);
        sum_of_neighbors(words_again_, words_);
        for (std::uint32_t y = 0; y < size_[1]; ++y)
            scale(words_.data() + y * row_ + kHalf, size_[0], to + std::size_t{y} * size_[0]);
    }
    void sum_of_neighbors(std::vector<std::uint16_t>& from, std::vector<std::uint16_t>& to) const {
        for (std::size_t end = row_; end <= from.size(); end += row_) {
            std::uint16_t* const row = from.data() + end - row_;
            std::fill_n(row, kHalf, row[kHalf]);
            std::fill_n(row + row_ - kHalf, kHalf, row[row_ - kHalf - 1]);
        }
        const std::uint16_t* const first = from.data();
        sum_of<std::uint16_t>({first, first + 1, first + 2, first + 3, first + 4},
                              from.size() - 2 * kHalf, to.data() + kHalf);
    }
    /// Scales sums of at most 5^6 to 255 / 5^6 of them, rounded.
    static void scale(const std::uint16_t* sums, std::size_t lanes, std::uint8_t* __restrict to) {
        constexpr std::uint32_t kFactor = (255u << 23) / 62500u + 1;
        for (std::size_t i = 0; i < lanes; ++i) {
            const auto sum = static_cast<std::uint16_t>(sums[i] * 4u);
            const auto high = static_cast<std::uint16_t>(std::uint32_t{sum} * kFactor >> 16);
            to[i] = static_cast<std::uint8_t>((high + 64u) >> 7);
        }
    }

    Size size_;
    std::size_t plane_;
    std::vector<std::uint8_t> along_z_; ///< five planes, each summed once along z
    std::vector<std::uint8_t> bytes_;   ///< a plane summed twice along z, and once along y
    std::size_t row_;                   ///< places of a row, with the places beyond its ends
    std::vector<std::uint16_t> words_;  ///< a plane summed twice along y, too, in such rows
    std::vector<std::uint16_t> words_again_;
};

void blur(std::span<std::uint8_t> field, const Size& size) {
    Blur(size).apply(field);
}

} // namespace
} // namespace isochron::index::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace isochron::index {

HWY_EXPORT(blur);

namespace {

using Size = std::array<std::uint32_t, 3>;

/// Sets 1 where a place of some planes is behind the surface; a NaN never is.
template <class T, class IsBehind>
void find_behind(std::span<const T> stored, const Size& vertices, std::uint32_t every,
                 const Size& size, PlaneRange planes, const IsBehind& is_behind, std::uint8_t* to) {
    const std::size_t plane = std::size_t{vertices[0]} * vertices[1];
    if (every == 1) {
        for (const T value :
             stored.subspan(planes.first * plane, (planes.end - planes.first) * plane))
            *to++ = is_behind(value);
        return;
    }
    for (std::uint32_t z = planes.first; z < planes.end; ++z)
        for (std::uint32_t y = 0; y < size[1]; ++y) {
            const T* const row = stored.data() + std::size_t{z} * every * plane +
                                 std::size_t{y} * every * vertices[0];
            for (std::size_t x = 0; x < size[0]; ++x)
                *to++ = is_behind(row[x * every]);
        }
}

std::uint32_t places_every(const Size& vertices) {
    return (*std::ranges::max_element(vertices) + kMostPlaces - 1) / kMostPlaces;
}

/// The shares at some planes of places, as far as places beyond these planes are like the last ones.
/// @param shares of these planes
void find_shares(const StepValues& values, std::uint32_t step, const Size& size, PlaneRange planes,
                 double isovalue, std::span<std::uint8_t> shares) {
    const Size& vertices = values.grid.vertices;
    const auto cut = stored_cut(values.type, values.scaling, isovalue);
    visit_value_type(values.type, [&]<class T>(std::type_identity<T>) {
        const auto find = [&](const auto& is_behind) {
            find_behind(values.step<T>(step), vertices, places_every(vertices), size, planes,
                        is_behind, shares.data());
        };
        if (!cut) { // all places are on one side
            find([&](T v) { return values.scaling(static_cast<double>(v)) >= isovalue; });
            return;
        }
        const T least = from_ordinal<T>(static_cast<Ordinal<T>>(*cut));
        if (values.scaling.slope > 0)
            find([least](T v) { return v >= least; });
        else
            find([least](T v) { return v < least; });
    });
    HWY_DYNAMIC_DISPATCH(blur)(shares, {size[0], size[1], planes.end - planes.first});
}

} // namespace

SurroundingField surroundings_of(const StepValues& values, std::uint32_t step, unsigned level,
                                 std::span<const double> isovalues) {
    SurroundingField field;
    const Size& vertices = values.grid.vertices;
    const std::uint32_t every = places_every(vertices);
    field.stride = every << level;
    for (std::size_t axis = 0; axis < 3; ++axis)
        field.size[axis] = (vertices[axis] - 1) / every + 1;
    const std::size_t places = std::size_t{field.size[0]} * field.size[1] * field.size[2];
    field.shares.resize(places * isovalues.size());
    for (std::size_t surface = 0; surface < isovalues.size(); ++surface)
        find_shares(values, step, field.size, {0, field.size[2]}, isovalues[surface],
                    std::span(field.shares).subspan(surface * places, places));
    return field;
}

void renew_surroundings(SurroundingField& field, const StepValues& values, std::uint32_t step,
                        std::span<const double> isovalues, PlaneRange changed) {
    if (changed.first >= changed.end)
        return;
    const auto [width, height, depth] = field.size;
    const std::uint32_t every = places_every(values.grid.vertices);
    // Planes of places: those that the change reaches, and those that these depend on.
    const auto around = [&](std::uint32_t reach) -> PlaneRange {
        const std::uint32_t first = changed.first / every, end = (changed.end - 1) / every + 1;
        return {first - std::min(first, reach), std::min(end + reach, depth)};
    };
    const PlaneRange reached = around(kSurroundingsReach), needed = around(2 * kSurroundingsReach);
    const std::size_t plane = std::size_t{width} * height;
    std::vector<std::uint8_t> shares((needed.end - needed.first) * plane);
    for (std::size_t surface = 0; surface < isovalues.size(); ++surface) {
        find_shares(values, step, field.size, needed, isovalues[surface], shares);
        std::copy_n(shares.data() + (reached.first - needed.first) * plane,
                    (reached.end - reached.first) * plane,
                    field.shares.data() + (surface * depth + reached.first) * plane);
    }
}

} // namespace isochron::index
#endif
