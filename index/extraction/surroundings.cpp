// Which places of a step lie behind a surface, blurred.
#include "index/extraction/surroundings.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace isochron::index {
namespace {

using Size = std::array<std::uint32_t, 3>;

/// Sums over 2 kHalf + 1 neighbors along a line, those beyond its ends being like the last ones.
constexpr std::uint32_t kHalf = kSurroundingsReach / 2;
constexpr std::uint32_t kWidth = 2 * kHalf + 1;

/// One pass along an axis, for all lines along it at once: `lanes` places lie next to each other
/// and belong to different lines.
/// @param sums of as many lanes: work space
void blur_lines(std::span<std::uint8_t> field, std::size_t lanes, std::uint32_t count,
                std::vector<std::uint8_t>& line, std::vector<std::uint16_t>& sums) {
    line.assign(field.begin(), field.end());
    const auto row = [&](std::int64_t i) {
        const auto at = static_cast<std::size_t>(std::clamp<std::int64_t>(i, 0, count - 1));
        return line.data() + at * lanes;
    };
    sums.assign(lanes, 0);
    for (std::int64_t k = -std::int64_t{kHalf}; k <= std::int64_t{kHalf}; ++k)
        std::transform(sums.begin(), sums.end(), row(k), sums.begin(), std::plus{});
    for (std::uint32_t i = 0; i < count; ++i) {
        std::uint8_t* const to = field.data() + i * lanes;
        const std::uint8_t* const next = row(std::int64_t{i} + kHalf + 1);
        const std::uint8_t* const last = row(std::int64_t{i} - kHalf);
        for (std::size_t lane = 0; lane < lanes; ++lane) {
            to[lane] = static_cast<std::uint8_t>((sums[lane] * (65536u / kWidth) + 32768u) >> 16);
            sums[lane] = static_cast<std::uint16_t>(sums[lane] + next[lane] - last[lane]);
        }
    }
}

/// The axis that lies first is worked on as the others are, turned over.
void turn(std::span<std::uint8_t> plane, std::uint32_t width, std::uint32_t height,
          std::vector<std::uint8_t>& work) {
    work.assign(plane.begin(), plane.end());
    for (std::uint32_t y = 0; y < height; ++y)
        for (std::uint32_t x = 0; x < width; ++x)
            plane[std::size_t{x} * height + y] = work[std::size_t{y} * width + x];
}

void blur(std::span<std::uint8_t> field, const Size& size) {
    std::vector<std::uint8_t> line;
    std::vector<std::uint16_t> sums;
    const std::size_t plane = std::size_t{size[0]} * size[1];
    for (int pass = 0; pass < 2; ++pass)
        blur_lines(field, plane, size[2], line, sums);
    for (std::uint32_t z = 0; z < size[2]; ++z) {
        const auto own = field.subspan(z * plane, plane);
        for (int pass = 0; pass < 2; ++pass)
            blur_lines(own, size[0], size[1], line, sums);
        turn(own, size[0], size[1], line);
        for (int pass = 0; pass < 2; ++pass)
            blur_lines(own, size[1], size[0], line, sums);
        turn(own, size[1], size[0], line);
    }
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
