// Fields of thin and of small things.
#include "tests/bench/motion/fields.h"

#include "app/generate/random_numbers.h"
#include "index/system/parallel.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <memory>
#include <numbers>
#include <random>
#include <vector>

namespace isochron::bench {
namespace {

constexpr double kCircle = 2 * std::numbers::pi;

/// A sum of waves in a periodic cube, with its gradient, row by row.
class Waves {
  public:
    static constexpr int kWaves = 20, kShortest = 3, kLongest = 6; ///< wave numbers

    explicit Waves(std::uint64_t seed) {
        std::mt19937_64 bits(seed);
        while (waves_.size() < kWaves) {
            std::array<double, 3> k{};
            for (double& along : k)
                along = std::floor((2 * kLongest + 1) * app::uniform(bits)) - kLongest;
            const double length = std::hypot(k[0], k[1], k[2]);
            if (length >= kShortest && length <= kLongest)
                waves_.push_back({k, kCircle * app::uniform(bits), app::uniform(bits) - 0.5});
        }
    }

    /// Values and gradients, the latter for each voxel, along a row of `size` vertices.
    struct Row {
        std::vector<float> value, x, y, z;
        explicit Row(std::size_t size) : value(size), x(size), y(size), z(size) {}
    };
    void row(std::size_t size, double time, std::size_t y, std::size_t z, Row& row) const {
        for (auto* part : {&row.value, &row.x, &row.y, &row.z})
            std::ranges::fill(*part, 0.0F);
        const double unit = kCircle / static_cast<double>(size);
        for (const Wave& wave : waves_) {
            const double start =
                unit * (wave.k[1] * static_cast<double>(y) + wave.k[2] * static_cast<double>(z)) +
                wave.phase + wave.pace * time;
            std::complex<double> at = std::polar(1.0, start);
            const std::complex<double> turn = std::polar(1.0, unit * wave.k[0]);
            const std::array<double, 3> k{unit * wave.k[0], unit * wave.k[1], unit * wave.k[2]};
            for (std::size_t x = 0; x < size; ++x, at *= turn) {
                const double slope = -at.imag();
                row.value[x] += static_cast<float>(at.real());
                row.x[x] += static_cast<float>(k[0] * slope);
                row.y[x] += static_cast<float>(k[1] * slope);
                row.z[x] += static_cast<float>(k[2] * slope);
            }
        }
    }

  private:
    struct Wave {
        std::array<double, 3> k;
        double phase, pace;
    };
    std::vector<Wave> waves_;
};

/// Where a speck is, in parts of the cube.
struct Speck {
    std::array<double, 3> at, way; ///< way: in a step
    double radius;                 ///< at which it is 0.5 [voxels]
};

} // namespace

MakeField tubes_of(std::size_t size) {
    constexpr double kRadius = 1.6; ///< at 0.5 [voxels]
    const auto first = std::make_shared<Waves>(1), second = std::make_shared<Waves>(2);
    return [=](std::size_t step, std::span<float> values) {
        const auto plane = [&](std::size_t z, unsigned) {
            Waves::Row a(size), b(size);
            for (std::size_t y = 0; y < size; ++y) {
                first->row(size, static_cast<double>(step), y, z, a);
                second->row(size, static_cast<double>(step), y, z, b);
                float* out = values.data() + (z * size + y) * size;
                for (std::size_t x = 0; x < size; ++x) {
                    // To the nearest place where both are 0, as far as the gradients tell.
                    const double aa = a.x[x] * a.x[x] + a.y[x] * a.y[x] + a.z[x] * a.z[x];
                    const double bb = b.x[x] * b.x[x] + b.y[x] * b.y[x] + b.z[x] * b.z[x];
                    const double ab = a.x[x] * b.x[x] + a.y[x] * b.y[x] + a.z[x] * b.z[x];
                    const double u = a.value[x], v = b.value[x];
                    const double square =
                        (u * u * bb - 2 * u * v * ab + v * v * aa) / (aa * bb - ab * ab + 1e-9);
                    out[x] = static_cast<float>(
                        std::exp2(-std::min(square / (kRadius * kRadius), 100.0)));
                }
            }
        };
        index::parallel_for(size, index::thread_count(0), plane, nullptr);
    };
}

MakeField specks_of(std::size_t size) {
    constexpr std::size_t kSpecks = 4000;
    constexpr double kLeast = 0.8, kMost = 1.6, kWay = 0.004;
    std::vector<Speck> specks(kSpecks);
    std::mt19937_64 bits(3);
    for (Speck& speck : specks) {
        for (double& at : speck.at)
            at = app::uniform(bits);
        for (double& way : speck.way)
            way = kWay * (2 * app::uniform(bits) - 1);
        speck.radius = kLeast + (kMost - kLeast) * app::uniform(bits);
    }
    return [size, specks](std::size_t step, std::span<float> values) {
        std::ranges::fill(values, 0.0F);
        constexpr int kReach = 6;
        const int n = static_cast<int>(size);
        for (const Speck& speck : specks) {
            std::array<double, 3> at{};
            std::array<int, 3> low{}, high{};
            for (std::size_t axis = 0; axis < 3; ++axis) {
                const double moved = speck.at[axis] + static_cast<double>(step) * speck.way[axis];
                at[axis] = (moved - std::floor(moved)) * n;
                low[axis] = std::max(static_cast<int>(at[axis]) - kReach, 0);
                high[axis] = std::min(static_cast<int>(at[axis]) + kReach, n - 1);
            }
            for (int z = low[2]; z <= high[2]; ++z)
                for (int y = low[1]; y <= high[1]; ++y)
                    for (int x = low[0]; x <= high[0]; ++x) {
                        const double square = (x - at[0]) * (x - at[0]) +
                                              (y - at[1]) * (y - at[1]) + (z - at[2]) * (z - at[2]);
                        float& value = values[(static_cast<std::size_t>(z) * size + y) * size + x];
                        value = std::max(value, static_cast<float>(std::exp2(
                                                    -square / (speck.radius * speck.radius))));
                    }
        }
    };
}

} // namespace isochron::bench
