// Which places of a step lie behind a surface, blurred.
#include "index/extraction/surroundings.h"

#include <algorithm>

namespace isochron::index {
namespace {

using Size = std::array<std::uint32_t, 3>;

/// A mean is that of a place and its two neighbors on either side along an axis.
constexpr std::uint32_t kHalf = kSurroundingsReach / 2;
constexpr std::uint32_t kWidth = 2 * kHalf + 1;

/// Rounded means of five rows, place by place, in whole numbers of 16 bits: a fifth of one is its
/// product with 2^18 / 5, rounded up, without the last 18 bits.
void mean_of(const std::array<const std::uint8_t*, kWidth>& rows, std::size_t lanes,
             std::uint8_t* to) {
    const auto [a, b, c, d, e] = rows;
    for (std::size_t i = 0; i < lanes; ++i) {
        const auto sum = static_cast<std::uint16_t>(a[i] + b[i] + c[i] + d[i] + e[i] + kHalf);
        const auto high = static_cast<std::uint16_t>(std::uint32_t{sum} * 52429u >> 16);
        to[i] = static_cast<std::uint8_t>(high >> 2);
    }
}

/// Means along an axis that is not the first, twice; places beyond the ends are like the last ones.
/// @param lanes places of a row: they lie next to each other, and the rows one after the other
void blur_rows(std::span<std::uint8_t> field, std::size_t lanes, std::uint32_t rows,
               std::vector<std::uint8_t>& before) {
    for (int pass = 0; pass < 2; ++pass) {
        before.assign(field.begin(), field.end());
        for (std::uint32_t i = 0; i < rows; ++i) {
            std::array<const std::uint8_t*, kWidth> near{};
            for (std::uint32_t k = 0; k < kWidth; ++k)
                near[k] =
                    before.data() + lanes * std::min(std::max(i + k, kHalf) - kHalf, rows - 1);
            mean_of(near, lanes, field.data() + i * lanes);
        }
    }
}

/// The same along the first axis, for one row.
void blur_along(std::span<std::uint8_t> row, std::vector<std::uint8_t>& before) {
    before.resize(row.size() + 2 * kHalf);
    for (int pass = 0; pass < 2; ++pass) {
        std::fill_n(before.begin(), kHalf, row.front());
        std::ranges::copy(row, before.begin() + kHalf);
        std::fill_n(before.end() - kHalf, kHalf, row.back());
        const std::uint8_t* const first = before.data();
        mean_of({first, first + 1, first + 2, first + 3, first + 4}, row.size(), row.data());
    }
}

void blur(std::span<std::uint8_t> field, const Size& size) {
    std::vector<std::uint8_t> before;
    const std::size_t plane = std::size_t{size[0]} * size[1];
    blur_rows(field, plane, size[2], before);
    for (std::size_t z = 0; z < size[2]; ++z)
        blur_rows(field.subspan(z * plane, plane), size[0], size[1], before);
    for (std::size_t begin = 0; begin < field.size(); begin += size[0])
        blur_along(field.subspan(begin, size[0]), before);
}

} // namespace

SurroundingField surroundings_of(const StepValues& values, std::uint32_t step, unsigned level,
                                 std::span<const double> isovalues) {
    SurroundingField field;
    const Size& vertices = values.grid.vertices;
    const std::uint32_t most = *std::ranges::max_element(vertices);
    const std::uint32_t every = (most + kMostPlaces - 1) / kMostPlaces;
    field.stride = every << level;
    for (std::size_t axis = 0; axis < 3; ++axis)
        field.size[axis] = (vertices[axis] - 1) / every + 1;
    const std::size_t places = std::size_t{field.size[0]} * field.size[1] * field.size[2];
    field.shares.resize(places * isovalues.size());
    for (std::size_t surface = 0; surface < isovalues.size(); ++surface) {
        const std::span<std::uint8_t> shares =
            std::span(field.shares).subspan(surface * places, places);
        const double isovalue = isovalues[surface];
        visit_value_type(values.type, [&]<class T>(std::type_identity<T>) {
            const std::span<const T> stored = values.step<T>(step);
            auto to = shares.begin();
            for (std::uint32_t z = 0; z < field.size[2]; ++z)
                for (std::uint32_t y = 0; y < field.size[1]; ++y) {
                    const std::size_t row =
                        (std::size_t{z} * every * vertices[1] + y * every) * vertices[0];
                    for (std::uint32_t x = 0; x < field.size[0]; ++x) // a NaN is not behind
                        *to++ =
                            values.scaling(static_cast<double>(stored[row + x * every])) >= isovalue
                                ? 255
                                : 0;
                }
        });
        blur(shares, field.size);
    }
    return field;
}

} // namespace isochron::index
