// A random velocity with a given energy spectrum.
#include "app/generate/random_velocity.h"

#include "app/generate/random_numbers.h"

#include <cmath>
#include <numeric>

namespace isochron::app {

namespace {

Field white_noise(std::size_t size, std::mt19937_64& bits) {
    Field noise(size);
    for (std::size_t i = 0; i < size; i += 2) {
        const auto [first, second] = normal_pair(bits);
        noise[i] = first;
        if (i + 1 < size)
            noise[i + 1] = second;
    }
    return noise;
}

} // namespace

NavierStokes::VectorField random_velocity(std::size_t n, std::uint64_t seed, double peak) {
    std::mt19937_64 bits(seed);
    const Fourier fourier(n);
    std::array<Spectrum, 3> velocity;
    for (Spectrum& component : velocity)
        component = fourier.spectrum_of(white_noise(fourier.field_size(), bits));

    // Shell s holds the wave numbers that round to s; the longest wave vector has 0.87 n.
    const auto shell_of = [](const std::array<double, 3>& k) {
        return static_cast<std::size_t>(std::lround(std::hypot(k[0], k[1], k[2])));
    };
    std::vector<double> energy(n + 1); // energy of the solenoidal noise, by shell
    for_each_wave_vector(n, [&](std::size_t place, const std::array<double, 3>& k, double weight) {
        const double k2 = k[0] * k[0] + k[1] * k[1] + k[2] * k[2];
        std::complex<double> along{};
        for (std::size_t c = 0; c < 3 && k2 > 0.0; ++c)
            along += k[c] / k2 * velocity[c][place];
        for (std::size_t c = 0; c < 3; ++c) {
            velocity[c][place] -= k[c] * along;
            energy[shell_of(k)] += 0.5 * weight * std::norm(velocity[c][place]);
        }
    });

    constexpr double kEnergy = 1.5; // three components of mean square 1
    std::vector<double> wanted(energy.size());
    for (std::size_t shell = 0; shell < wanted.size(); ++shell) {
        const double k = static_cast<double>(shell) / peak;
        wanted[shell] = std::pow(k, 4) * std::exp(-2.0 * k * k);
    }
    const double total = std::accumulate(wanted.begin(), wanted.end(), 0.0);
    for_each_wave_vector(n, [&](std::size_t place, const std::array<double, 3>& k, double) {
        const std::size_t shell = shell_of(k);
        const double scale =
            energy[shell] > 0.0 ? std::sqrt(kEnergy * wanted[shell] / total / energy[shell]) : 0.0;
        for (Spectrum& component : velocity)
            component[place] *= scale;
    });

    NavierStokes::VectorField field;
    for (std::size_t c = 0; c < 3; ++c)
        field[c] = fourier.field_of(std::move(velocity[c]));
    return field;
}

} // namespace isochron::app
