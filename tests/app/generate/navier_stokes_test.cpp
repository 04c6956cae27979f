// The flow behind the demo data, compared with exact results on such flows.
#include "app/generate/navier_stokes.h"
#include "app/generate/random_velocity.h"

#include <gmock/gmock.h>

#include <cmath>
#include <numbers>
#include <random>

namespace isochron::app {
namespace {

using VectorField = NavierStokes::VectorField;

/// Energy by shells of wave numbers, and the divergence relative to the gradient, from the points.
struct Analysis {
    std::vector<double> energy;
    double divergence = 0.0;
    double beyond_cutoff = 0.0; ///< energy where 3 |k| >= n
};

Analysis analyze(std::size_t n, const VectorField& velocity) {
    const Fourier fourier(n);
    const std::array u{fourier.spectrum_of(velocity[0]), fourier.spectrum_of(velocity[1]),
                       fourier.spectrum_of(velocity[2])};
    Analysis result;
    result.energy.resize(n + 1);
    double divergent = 0.0;
    double gradient = 0.0;
    for_each_wave_vector(n, [&](std::size_t i, const std::array<double, 3>& k, double weight) {
        const double length = std::hypot(k[0], k[1], k[2]);
        const double squared = std::norm(u[0][i]) + std::norm(u[1][i]) + std::norm(u[2][i]);
        result.energy[static_cast<std::size_t>(std::lround(length))] += 0.5 * weight * squared;
        divergent += weight * std::norm(k[0] * u[0][i] + k[1] * u[1][i] + k[2] * u[2][i]);
        gradient += weight * length * length * squared;
        if (3.0 * length >= static_cast<double>(n))
            result.beyond_cutoff += 0.5 * weight * squared;
    });
    result.divergence = std::sqrt(divergent / gradient);
    return result;
}

double mean_square(const VectorField& field) {
    double sum = 0.0;
    for (const Field& component : field)
        for (double value : component)
            sum += value * value;
    return sum / static_cast<double>(field[0].size());
}

VectorField difference(const VectorField& a, const VectorField& b) {
    VectorField result = a;
    for (std::size_t c = 0; c < 3; ++c)
        for (std::size_t i = 0; i < a[c].size(); ++i)
            result[c][i] -= b[c][i];
    return result;
}

/// A velocity given by a function of the point.
template <class Function>
VectorField field_at_points(std::size_t n, Function function) {
    VectorField field;
    const double spacing = 2.0 * std::numbers::pi / static_cast<double>(n);
    for (std::size_t z = 0; z < n; ++z)
        for (std::size_t y = 0; y < n; ++y)
            for (std::size_t x = 0; x < n; ++x) {
                const std::array<double, 3> value =
                    function(spacing * static_cast<double>(x), spacing * static_cast<double>(y),
                             spacing * static_cast<double>(z));
                for (std::size_t c = 0; c < 3; ++c)
                    field[c].push_back(value[c]);
            }
    return field;
}

class Seeded : public testing::TestWithParam<std::uint64_t> {};
INSTANTIATE_TEST_SUITE_P(Seeds, Seeded, testing::Values(1, 2, 77));

TEST_P(Seeded, DivergenceStaysAtRoundOff) {
    NavierStokes flow(32, 0.01, random_velocity(32, GetParam(), 2.0));
    for (int i = 0; i < 20; ++i)
        flow.advance(0.02);
    EXPECT_LT(analyze(32, flow.velocity()).divergence, 1e-14);
    EXPECT_LT(flow.divergence(), 1e-15);
}

TEST_P(Seeded, EnergyFallsAtEveryStep) {
    NavierStokes flow(16, 0.02, random_velocity(16, GetParam(), 2.0));
    double before = flow.energy();
    for (int i = 0; i < 100; ++i) {
        flow.advance(0.03);
        EXPECT_LT(flow.energy(), before) << "at time " << flow.time();
        before = flow.energy();
    }
}

TEST_P(Seeded, EnergyFallsByWhatViscosityTakes) {
    const double viscosity = 0.02;
    const double dt = 0.005;
    NavierStokes flow(24, viscosity, random_velocity(24, GetParam(), 2.0));
    for (int i = 0; i < 20; ++i) {
        const double before = flow.energy();
        flow.advance(dt);
        const double rate = -2.0 * viscosity * flow.enstrophy();
        flow.advance(dt);
        EXPECT_NEAR((flow.energy() - before) / (2.0 * dt), rate, 1e-4 * -rate);
    }
}

TEST_P(Seeded, EnergyAndEnstrophyAreThoseOfThePoints) {
    const NavierStokes flow(16, 0.02, random_velocity(16, GetParam(), 2.0));
    EXPECT_NEAR(flow.energy(), 0.5 * mean_square(flow.velocity()), 1e-12);
    double squares = 0.0;
    for (double w : flow.vorticity_magnitude())
        squares += w * w;
    EXPECT_NEAR(flow.enstrophy(), 0.5 * squares / (16.0 * 16.0 * 16.0), 1e-11);
}

TEST_P(Seeded, NothingLiesBeyondTheCutoff) {
    std::mt19937_64 bits(GetParam());
    VectorField noise = field_at_points(16, [&](double, double, double) {
        const auto number = [&] { return static_cast<double>(bits()) * 0x1p-64 - 0.5; };
        return std::array{number(), number(), number()};
    });
    ASSERT_GT(analyze(16, noise).beyond_cutoff, 0.1);
    NavierStokes flow(16, 0.0, noise);
    for (int i = 0; i < 10; ++i)
        flow.advance(0.01);
    EXPECT_GT(flow.energy(), 1e-3);
    EXPECT_LT(analyze(16, flow.velocity()).beyond_cutoff, 1e-28);
}

// Were products to alias, what a mode gains would differ from what it gains where twice the points
// leave aliases nowhere to fall: compared over a time so short that only the first product counts.
TEST_P(Seeded, ProductsAliasIntoNothing) {
    const double dt = 1e-6;
    const NavierStokes start(16, 0.0, random_velocity(16, GetParam(), 3.0));
    const Fourier coarse(16);
    const Fourier fine(32);

    VectorField same_on_fine;
    // Places of the coarse grid's kept modes in both.
    std::vector<std::array<std::size_t, 2>> places;
    for_each_wave_vector(16, [&](std::size_t place, const std::array<double, 3>& k, double) {
        const auto index = [](double wave_number) {
            return static_cast<std::size_t>(wave_number < 0.0 ? wave_number + 32.0 : wave_number);
        };
        if (3.0 * std::hypot(k[0], k[1], k[2]) < 16.0)
            places.push_back({place, (index(k[2]) * 32 + index(k[1])) * 17 + index(k[0])});
    });
    const VectorField on_coarse = start.velocity();
    for (std::size_t c = 0; c < 3; ++c) {
        const Spectrum spectrum = coarse.spectrum_of(on_coarse[c]);
        Spectrum padded(fine.spectrum_size());
        for (const auto& [from, to] : places)
            padded[to] = spectrum[from];
        same_on_fine[c] = fine.field_of(std::move(padded));
    }

    NavierStokes on16(16, 0.0, on_coarse);
    NavierStokes on32(32, 0.0, same_on_fine);
    on16.advance(dt);
    on32.advance(dt);
    const VectorField gain16 = difference(on16.velocity(), on_coarse);
    const VectorField gain32 = difference(on32.velocity(), same_on_fine);
    double error = 0.0;
    double gain = 0.0;
    for (std::size_t c = 0; c < 3; ++c) {
        const Spectrum a = coarse.spectrum_of(gain16[c]);
        const Spectrum b = fine.spectrum_of(gain32[c]);
        for (const auto& [in16, in32] : places) {
            error += std::norm(a[in16] - b[in32]);
            gain += std::norm(b[in32]);
        }
    }
    EXPECT_GT(std::sqrt(gain), dt);
    EXPECT_LT(std::sqrt(error / gain), 1e-5);
}

TEST_P(Seeded, TimeIntegratorIsOfFourthOrder) {
    const VectorField start = random_velocity(16, GetParam(), 2.0);
    const auto at_half = [&](int steps) {
        NavierStokes flow(16, 0.02, start);
        for (int i = 0; i < steps; ++i)
            flow.advance(0.5 / steps);
        return flow.velocity();
    };
    const VectorField exact = at_half(160);
    const double coarse = std::sqrt(mean_square(difference(at_half(10), exact)));
    const double fine = std::sqrt(mean_square(difference(at_half(20), exact)));
    const double order = std::log2(coarse / fine);
    EXPECT_GT(order, 3.7) << "errors " << coarse << ", " << fine;
    EXPECT_LT(order, 4.5) << "errors " << coarse << ", " << fine;
}

TEST_P(Seeded, RandomVelocityHasTheSpectrumThatWasAskedFor) {
    const double peak = 2.0;
    const Analysis analysis = analyze(32, random_velocity(32, GetParam(), peak));
    double total = 0.0;
    double expected_total = 0.0;
    for (std::size_t shell = 0; shell < analysis.energy.size(); ++shell) {
        total += analysis.energy[shell];
        const double k = static_cast<double>(shell) / peak;
        expected_total += std::pow(k, 4) * std::exp(-2.0 * k * k);
    }
    EXPECT_NEAR(total, 1.5, 1e-12);
    for (std::size_t shell = 1; shell <= 16; ++shell) {
        const double k = static_cast<double>(shell) / peak;
        EXPECT_NEAR(analysis.energy[shell] / total,
                    std::pow(k, 4) * std::exp(-2.0 * k * k) / expected_total, 1e-12);
    }
    EXPECT_LT(analysis.divergence, 1e-14);
}

// The two-dimensional vortices of Taylor and Green (Proc. R. Soc. A 158, 1937): advection is all
// gradient, which the pressure takes away, so the flow only fades, by exp(-2 nu k^2 t).
TEST(NavierStokes, TaylorGreenVorticesFadeAsTheClosedFormSays) {
    const double viscosity = 0.05;
    for (const double k : {1.0, 2.0}) {
        const auto vortices = [k](double x, double y, double) {
            return std::array{std::cos(k * x) * std::sin(k * y), -std::sin(k * x) * std::cos(k * y),
                              0.0};
        };
        NavierStokes flow(16, viscosity, field_at_points(16, vortices));
        for (int i = 0; i < 50; ++i)
            flow.advance(0.02);
        const double left = std::exp(-2.0 * viscosity * k * k * 1.0);
        const VectorField expected = field_at_points(16, [&](double x, double y, double z) {
            auto value = vortices(x, y, z);
            for (double& component : value)
                component *= left;
            return value;
        });
        EXPECT_LT(std::sqrt(mean_square(difference(flow.velocity(), expected))), 1e-12)
            << "k " << k;
        const Field vorticity = flow.vorticity_magnitude(); // 2 k |cos kx cos ky|
        const VectorField closed = field_at_points(16, [&](double x, double y, double) {
            return std::array{2.0 * k * left * std::abs(std::cos(k * x) * std::cos(k * y)), 0.0,
                              0.0};
        });
        for (std::size_t i = 0; i < vorticity.size(); ++i)
            ASSERT_NEAR(vorticity[i], closed[0][i], 1e-12);
    }
}

TEST(RandomVelocity, FollowsFromTheSeedAlone) {
    const VectorField one = random_velocity(16, 1, 2.0);
    EXPECT_EQ(one, random_velocity(16, 1, 2.0));
    // Independent fields of mean square 3 each differ by twice that.
    EXPECT_GT(mean_square(difference(one, random_velocity(16, 2, 2.0))), 2.0);
}

} // namespace
} // namespace isochron::app
