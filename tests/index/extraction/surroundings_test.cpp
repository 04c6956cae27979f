// What lies around places of a step, against sums over all neighbors.
#include "index/extraction/surroundings.h"

#include "tests/support/test_field.h"
#include "tests/support/test_seed.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

namespace isochron::index {
namespace {

using Places = std::array<std::uint32_t, 3>;

/// Means of 5 neighbors along an axis, twice, those beyond the ends being like the last ones.
std::vector<double> blurred(std::vector<double> field, const Places& size) {
    const std::array<std::size_t, 3> apart{1, size[0], std::size_t{size[0]} * size[1]};
    for (std::size_t axis = 0; axis < 3; ++axis)
        for (int pass = 0; pass < 2; ++pass) {
            const std::vector<double> before = field;
            for (std::size_t i = 0; i < field.size(); ++i) {
                const auto place = static_cast<std::int64_t>(i / apart[axis] % size[axis]);
                double sum = 0;
                for (std::int64_t k = -2; k <= 2; ++k) {
                    const auto at = std::clamp<std::int64_t>(place + k, 0, size[axis] - 1);
                    sum += before[i + static_cast<std::size_t>(at - place) * apart[axis]];
                }
                field[i] = sum / 5;
            }
        }
    return field;
}

TEST(Surroundings, AreTheSharesBehindTheSurfaceBlurred) {
    std::mt19937 random(test_seed());
    for (const auto& [vertices, every] : {std::pair{Places{9, 7, 12}, 1u},
                                          {Places{64, 3, 5}, 1u},
                                          {Places{70, 9, 2}, 2u},
                                          {Places{2, 2, 2}, 1u},
                                          {Places{130, 66, 4}, 3u}}) {
        TestField field({vertices[0], vertices[1], vertices[2]}, 2, ValueType::f32,
                        white_noise(random), {random() % 2 ? -2.0 : 1.0, 0.25});
        field.at<float>(1, 3) = std::nanf("");
        const StepValues values = field.view();
        const std::array isovalues{0.0, 0.6, 1e9};
        const SurroundingField found = surroundings_of(values, 1, 1, isovalues);
        EXPECT_EQ(found.stride, 2 * every);
        Places size{};
        for (std::size_t axis = 0; axis < 3; ++axis)
            size[axis] = (vertices[axis] - 1) / every + 1;
        ASSERT_EQ(found.size, size);
        const std::size_t places = std::size_t{size[0]} * size[1] * size[2];
        ASSERT_EQ(found.shares.size(), 3 * places);
        for (std::size_t surface = 0; surface < 3; ++surface) {
            std::vector<double> behind;
            for (std::uint32_t z = 0; z < size[2]; ++z)
                for (std::uint32_t y = 0; y < size[1]; ++y)
                    for (std::uint32_t x = 0; x < size[0]; ++x) {
                        const std::size_t at =
                            (std::size_t{z} * every * vertices[1] + y * every) * vertices[0] +
                            x * every;
                        const double value = values.scaling(values.step<float>(1)[at]);
                        behind.push_back(value >= isovalues[surface] ? 255 : 0);
                    }
            const std::vector<double> wanted = blurred(behind, size);
            for (std::size_t i = 0; i < places; ++i)
                ASSERT_NEAR(found.shares[surface * places + i], wanted[i], 3.0) << i;
        }
    }
}

TEST(Surroundings, BeforeAPlaneAreFewAndInAGrooveMany) {
    // Below z = 20 all is behind the surface; a groove three wide runs along y at x = 20.
    TestField field({41, 41, 41}, 1, ValueType::u8, [](double x, double, double z, double) {
        const bool groove = std::abs(x - 20) <= 1;
        return z <= (groove ? 14 : 20) ? 200.0 : 0.0;
    });
    const std::array isovalues{100.0};
    const SurroundingField found = surroundings_of(field.view(), 0, 0, isovalues);
    const auto share = [&](std::size_t x, std::size_t z) {
        return found.shares[(z * 41 + 20) * 41 + x] / 255.0;
    };
    EXPECT_NEAR(0.5 * (share(5, 22) + share(5, 23)), 0.16, 0.03);
    EXPECT_GT(share(20, 17), 0.5) << "in the groove";
}

} // namespace
} // namespace isochron::index
