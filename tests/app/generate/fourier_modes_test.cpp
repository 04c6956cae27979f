// The field of random Fourier modes agrees with its formula, and is solenoidal.
#include "app/generate/fourier_modes.h"

#include "app/generate/demo_fields.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <map>
#include <numbers>

namespace isochron::app {
namespace {

using Vector = std::array<double, 3>;

double dot(const Vector& a, const Vector& b) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/// The velocity by its definition.
Vector velocity(const FourierModes& flow, const Vector& at, double time) {
    Vector sum{};
    for (const FourierModes::Mode& mode : flow.modes()) {
        const double wave = std::exp(-0.0005 * dot(mode.k, mode.k) * time) *
                            std::cos(dot(mode.k, at) + mode.frequency * time + mode.phase);
        for (std::size_t c = 0; c < 3; ++c)
            sum[c] += mode.amplitude[c] * wave;
    }
    return sum;
}

/// Derivative of a component of the velocity along an axis, by central differences.
double derivative(const FourierModes& flow, Vector at, double time, std::size_t component,
                  std::size_t axis) {
    constexpr double kStep = 1e-4;
    at[axis] += kStep;
    const double above = velocity(flow, at, time)[component];
    at[axis] -= 2 * kStep;
    return (above - velocity(flow, at, time)[component]) / (2 * kStep);
}

TEST(FourierModes, AreDrawnFromTheShellAndSolenoidal) {
    const FourierModes flow(12345);
    ASSERT_EQ(flow.modes().size(), 96u);
    double square_of_frequency = 0;
    for (const FourierModes::Mode& mode : flow.modes()) {
        const double k = std::sqrt(dot(mode.k, mode.k));
        EXPECT_GE(k, 2);
        EXPECT_LE(k, 10);
        EXPECT_NEAR(dot(mode.k, mode.amplitude), 0, 1e-12);
        EXPECT_NEAR(std::sqrt(dot(mode.amplitude, mode.amplitude)), std::pow(k, -11.0 / 6.0),
                    1e-12);
        square_of_frequency += std::pow(mode.frequency / (0.1 * std::pow(k, 2.0 / 3.0)), 2);
    }
    EXPECT_NEAR(square_of_frequency / 96, 1.0, 0.45) << "three standard deviations";
}

TEST(FourierModes, HaveTheVorticityOfTheirVelocity) {
    const FourierModes flow(7);
    constexpr std::size_t kVertices = 20;
    for (const double time : {0.0, 31.0}) {
        std::vector<float> magnitude(kVertices * kVertices * kVertices);
        flow.vorticity_magnitude(kVertices, time, magnitude);
        for (const std::array<std::size_t, 3> vertex :
             {std::array<std::size_t, 3>{0, 0, 0}, {1, 2, 3}, {19, 0, 7}, {5, 18, 19}}) {
            Vector at{};
            for (std::size_t c = 0; c < 3; ++c)
                at[c] = 2 * std::numbers::pi / kVertices * static_cast<double>(vertex[c]);
            const auto d = [&](std::size_t component, std::size_t axis) {
                return derivative(flow, at, time, component, axis);
            };
            EXPECT_NEAR(d(0, 0) + d(1, 1) + d(2, 2), 0, 1e-5) << "divergence";
            const double curl = std::hypot(d(2, 1) - d(1, 2), d(0, 2) - d(2, 0), d(1, 0) - d(0, 1));
            EXPECT_NEAR(magnitude[(vertex[2] * kVertices + vertex[1]) * kVertices + vertex[0]],
                        curl, 1e-4 * (1 + curl));
        }
    }
}

TEST(FourierModes, HaveTheEnstrophyOfTheirAmplitudes) {
    // Parseval: what modes of one wave vector add up to, and its opposite, is one wave.
    const FourierModes flow(3, 40);
    constexpr double kTime = 12;
    // Amplitudes of sines and of cosines.
    std::map<std::array<double, 3>, std::array<Vector, 2>> waves;
    for (const FourierModes::Mode& mode : flow.modes()) {
        const bool turned = mode.k < Vector{};
        Vector k = mode.k;
        for (double& along : k)
            along = turned ? -along : along;
        const double angle = mode.frequency * kTime + mode.phase;
        auto& [sine, cosine] = waves[k];
        for (std::size_t c = 0; c < 3; ++c) {
            const double strength = FourierModes::remaining(mode, kTime) * mode.curl[c];
            sine[c] += strength * std::cos(angle) * (turned ? -1 : 1);
            cosine[c] += strength * std::sin(angle);
        }
    }
    double expected = 0;
    for (const auto& [k, wave] : waves)
        expected += 0.5 * (dot(wave[0], wave[0]) + dot(wave[1], wave[1]));

    constexpr std::size_t kVertices = 24; // resolves twice the highest wave number
    std::vector<float> magnitude(kVertices * kVertices * kVertices);
    flow.vorticity_magnitude(kVertices, kTime, magnitude);
    double sum = 0;
    for (const float value : magnitude)
        sum += double{value} * value;
    EXPECT_NEAR(sum / (kVertices * kVertices * kVertices), expected, 1e-5 * expected);
}

TEST(FourierModes, AreTheSameForEveryNumberOfThreadsAndSampledByAnyGrid) {
    const FourierModes flow(12345);
    std::vector<float> one(32 * 32 * 32), three(one.size()), coarse(16 * 16 * 16);
    flow.vorticity_magnitude(32, 5, one, 1);
    flow.vorticity_magnitude(32, 5, three, 3);
    EXPECT_EQ(one, three);
    flow.vorticity_magnitude(16, 5, coarse);
    for (std::size_t i = 0; i < coarse.size(); ++i)
        ASSERT_NEAR(coarse[i], one[(i / 256 * 2 * 32 + i / 16 % 16 * 2) * 32 + i % 16 * 2], 1e-5);
}

/// All steps as they are made.
template <class T>
std::vector<std::vector<T>> steps_of(const FourierSeries& series) {
    std::vector<std::vector<T>> steps;
    make_steps(
        series,
        [&](std::span<const std::byte> values, double time) {
            EXPECT_EQ(time, static_cast<double>(steps.size()));
            steps.emplace_back(values.size() / sizeof(T));
            std::memcpy(steps.back().data(), values.data(), values.size());
        },
        [](std::string_view, double) {});
    return steps;
}

TEST(FourierSeries, RoundsOverTheWholeSeriesAndFollowsFromTheSeedAlone) {
    const FourierSeries series{.size = 16, .steps = 3};
    const auto exact = steps_of<float>(series);
    EXPECT_EQ(exact, steps_of<float>(series));
    FourierSeries other = series;
    other.seed = 2;
    EXPECT_NE(exact, steps_of<float>(other));
    other = series;
    other.type = index::ValueType::u8;
    const auto rounded = steps_of<std::uint8_t>(other);
    float highest = 0;
    for (const auto& step : exact)
        highest = std::max(highest, *std::max_element(step.begin(), step.end()));
    ASSERT_EQ(exact.size(), 3u);
    ASSERT_EQ(rounded.size(), 3u);
    for (std::size_t step = 0; step < 3; ++step)
        for (std::size_t i = 0; i < exact[step].size(); ++i)
            ASSERT_NEAR(rounded[step][i], 255 * exact[step][i] / highest, 0.5 + 1e-3);
}

} // namespace
} // namespace isochron::app
