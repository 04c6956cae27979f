// A solenoidal velocity as the sum of random Fourier modes.
#include "app/generate/fourier_modes.h"

#include "app/generate/random_numbers.h"
#include "index/system/parallel.h"

#include <cassert>
#include <cmath>
#include <complex>
#include <numbers>

namespace isochron::app {

namespace {

constexpr int kShortest = 2;
constexpr double kDecay = 0.0005;

using Vector = std::array<double, 3>;
using Complex = std::complex<double>;

double dot(const Vector& a, const Vector& b) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

Vector cross(const Vector& a, const Vector& b) {
    return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

Vector wave_vector(std::mt19937_64& bits, int longest) {
    for (;;) {
        Vector k{};
        for (double& along : k)
            along = std::floor((2 * longest + 1) * uniform(bits)) - longest;
        if (dot(k, k) >= kShortest * kShortest && dot(k, k) <= longest * longest)
            return k;
    }
}

/// Along one axis: exp(i k x) of every mode at every vertex, [vertex][mode].
std::vector<Complex> waves(const std::vector<FourierModes::Mode>& modes, std::size_t axis,
                           std::size_t n) {
    std::vector<Complex> all;
    all.reserve(n * modes.size());
    for (std::size_t vertex = 0; vertex < n; ++vertex)
        for (const FourierModes::Mode& mode : modes)
            all.push_back(std::polar(1.0, 2.0 * std::numbers::pi / static_cast<double>(n) *
                                              mode.k[axis] * static_cast<double>(vertex)));
    return all;
}

} // namespace

FourierModes::FourierModes(std::uint64_t seed, std::size_t modes, int longest)
    : longest_(longest), modes_(modes) {
    std::mt19937_64 bits(seed);
    for (Mode& mode : modes_) {
        mode.k = wave_vector(bits, longest);
        const double k2 = dot(mode.k, mode.k);
        const auto [a, b] = normal_pair(bits);
        const auto [c, f] = normal_pair(bits);
        // Keep the part of a random direction that is at right angles to k.
        mode.amplitude = {a, b, c};
        const double along = dot(mode.amplitude, mode.k) / k2;
        for (std::size_t i = 0; i < 3; ++i)
            mode.amplitude[i] -= along * mode.k[i];
        const double scale = std::pow(k2, -11.0 / 12.0) /
                             std::hypot(mode.amplitude[0], mode.amplitude[1], mode.amplitude[2]);
        for (double& component : mode.amplitude)
            component *= scale;
        mode.curl = cross(mode.k, mode.amplitude);
        mode.frequency = 0.1 * std::cbrt(k2) * f;
        mode.phase = 2.0 * std::numbers::pi * uniform(bits);
    }
}

double FourierModes::remaining(const Mode& mode, double time) {
    return std::exp(-kDecay * dot(mode.k, mode.k) * time);
}

/// Along a row of vertices every mode is a sine and a cosine with a whole wave number in x. So the
/// modes are first summed by that number: this leaves 21 waves to add instead of 96. Numbers
/// without a mode are skipped.
void FourierModes::vorticity_magnitude(std::size_t n, double time, std::span<float> out,
                                       unsigned threads) const {
    assert(out.size() == n * n * n);
    const std::vector<Complex> along_y = waves(modes_, 1, n), along_z = waves(modes_, 2, n);
    const std::size_t waves_along_x = static_cast<std::size_t>(longest_) + 1;
    std::vector<bool> used(waves_along_x);
    for (const Mode& mode : modes_)
        used[static_cast<std::size_t>(std::abs(mode.k[0]))] = true;
    std::vector<double> cosines(waves_along_x * n), sines(waves_along_x * n); // [wave number][x]
    for (std::size_t wave = 0; wave < waves_along_x; ++wave)
        for (std::size_t x = 0; x < n; ++x) {
            const double angle =
                2.0 * std::numbers::pi / static_cast<double>(n) * static_cast<double>(wave * x);
            cosines[wave * n + x] = std::cos(angle);
            sines[wave * n + x] = std::sin(angle);
        }

    const auto plane = [&](std::size_t z, unsigned) {
        std::vector<Complex> at_z(modes_.size());
        for (std::size_t m = 0; m < modes_.size(); ++m)
            at_z[m] = along_z[z * modes_.size() + m] *
                      std::polar(remaining(modes_[m], time),
                                 modes_[m].frequency * time + modes_[m].phase);
        std::array<std::vector<double>, 3> curl, of_cosine, of_sine;
        for (std::size_t y = 0; y < n; ++y) {
            // curl u = -sum of (k x a) sin(k_x x + angle), with exp(i angle) in `rest`.
            for (std::size_t c = 0; c < 3; ++c) {
                of_cosine[c].assign(waves_along_x, 0.0);
                of_sine[c].assign(waves_along_x, 0.0);
            }
            for (std::size_t m = 0; m < modes_.size(); ++m) {
                const Complex rest = at_z[m] * along_y[y * modes_.size() + m];
                const double k = modes_[m].k[0];
                const auto wave = static_cast<std::size_t>(std::abs(k));
                const double sine = k < 0 ? -rest.real() : rest.real();
                for (std::size_t c = 0; c < 3; ++c) {
                    of_cosine[c][wave] -= modes_[m].curl[c] * rest.imag();
                    of_sine[c][wave] -= modes_[m].curl[c] * sine;
                }
            }
            for (std::size_t c = 0; c < 3; ++c) {
                curl[c].assign(n, 0.0);
                for (std::size_t wave = 0; wave < waves_along_x; ++wave)
                    for (std::size_t x = 0; used[wave] && x < n; ++x)
                        curl[c][x] += of_cosine[c][wave] * cosines[wave * n + x] +
                                      of_sine[c][wave] * sines[wave * n + x];
            }
            float* row = out.data() + (z * n + y) * n;
            for (std::size_t x = 0; x < n; ++x)
                row[x] = static_cast<float>(std::sqrt(
                    curl[0][x] * curl[0][x] + curl[1][x] * curl[1][x] + curl[2][x] * curl[2][x]));
        }
    };
    index::parallel_for(n, index::thread_count(threads), plane, nullptr);
}

} // namespace isochron::app
