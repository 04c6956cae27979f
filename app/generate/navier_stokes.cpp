// Incompressible flow in a periodic cube, pseudo-spectral.
#include "app/generate/navier_stokes.h"

#include <cmath>
#include <future>

namespace isochron::app {

namespace {

template <class Vector>
auto dot(const std::array<double, 3>& k, const Vector& v) {
    return k[0] * v[0] + k[1] * v[1] + k[2] * v[2];
}

std::complex<double> times_i(std::complex<double> z) {
    return {-z.imag(), z.real()};
}

double squared(const std::array<std::complex<double>, 3>& v) {
    return std::norm(v[0]) + std::norm(v[1]) + std::norm(v[2]);
}

} // namespace

NavierStokes::NavierStokes(std::size_t n, double viscosity, const VectorField& velocity)
    : fourier_(n), viscosity_(viscosity) {
    const double limit = static_cast<double>(n * n) / 9.0;
    for_each_wave_vector(n, [&](std::size_t place, const std::array<double, 3>& k, double weight) {
        const double k2 = dot(k, k);
        // Leave out the mean flow (k = 0), which would only move the whole picture.
        if (k2 > 0.0 && k2 < limit)
            modes_.push_back({k, k2, weight, place});
    });
    velocity_ = kept(velocity);
    project(velocity_);
}

void NavierStokes::advance(double dt) {
    const std::size_t count = modes_.size();
    std::vector<double> half(count); // decay of each mode by viscosity in half a step
    for (std::size_t m = 0; m < count; ++m)
        half[m] = std::exp(-0.5 * viscosity_ * modes_[m].k2 * dt);

    const Coefficients& u = velocity_;
    Coefficients stage(count);
    const auto fill = [&](auto value) {
        for (std::size_t m = 0; m < count; ++m)
            for (std::size_t c = 0; c < 3; ++c)
                stage[m][c] = value(m, c);
    };
    const Coefficients k1 = advection(u);
    fill([&](std::size_t m, std::size_t c) { return half[m] * (u[m][c] + 0.5 * dt * k1[m][c]); });
    const Coefficients k2 = advection(stage);
    fill([&](std::size_t m, std::size_t c) { return half[m] * u[m][c] + 0.5 * dt * k2[m][c]; });
    const Coefficients k3 = advection(stage);
    fill([&](std::size_t m, std::size_t c) {
        return half[m] * (half[m] * u[m][c] + dt * k3[m][c]);
    });
    const Coefficients k4 = advection(stage);
    fill([&](std::size_t m, std::size_t c) {
        const double e = half[m];
        return e * e * u[m][c] +
               dt / 6.0 * (e * e * k1[m][c] + 2.0 * e * (k2[m][c] + k3[m][c]) + k4[m][c]);
    });
    velocity_ = std::move(stage);
    project(velocity_); // removes divergence by rounding before it adds up
    time_ += dt;
}

double NavierStokes::energy() const {
    double sum = 0.0;
    for (std::size_t m = 0; m < modes_.size(); ++m)
        sum += 0.5 * modes_[m].weight * squared(velocity_[m]);
    return sum;
}

double NavierStokes::enstrophy() const {
    double sum = 0.0;
    for (std::size_t m = 0; m < modes_.size(); ++m)
        sum += 0.5 * modes_[m].weight * modes_[m].k2 * squared(velocity_[m]);
    return sum;
}

double NavierStokes::divergence() const {
    double divergent = 0.0;
    double gradient = 0.0;
    for (std::size_t m = 0; m < modes_.size(); ++m) {
        const Mode& mode = modes_[m];
        divergent += mode.weight * std::norm(dot(mode.k, velocity_[m]));
        gradient += mode.weight * mode.k2 * squared(velocity_[m]);
    }
    return gradient > 0.0 ? std::sqrt(divergent / gradient) : 0.0;
}

NavierStokes::VectorField NavierStokes::velocity() const {
    return field_of(velocity_);
}

Field NavierStokes::vorticity_magnitude() const {
    const VectorField vorticity = field_of(curl(velocity_));
    Field magnitude(fourier_.field_size());
    for (std::size_t i = 0; i < magnitude.size(); ++i)
        magnitude[i] =
            std::sqrt(vorticity[0][i] * vorticity[0][i] + vorticity[1][i] * vorticity[1][i] +
                      vorticity[2][i] * vorticity[2][i]);
    return magnitude;
}

NavierStokes::Coefficients NavierStokes::kept(const VectorField& field) const {
    Coefficients coefficients(modes_.size());
    const auto keep = [&](std::size_t c) {
        const Spectrum spectrum = fourier_.spectrum_of(field[c]);
        for (std::size_t m = 0; m < modes_.size(); ++m)
            coefficients[m][c] = spectrum[modes_[m].place];
    };
    auto first = std::async(std::launch::async, keep, 0);
    keep(1);
    keep(2);
    first.get();
    return coefficients;
}

NavierStokes::VectorField NavierStokes::field_of(const Coefficients& coefficients) const {
    VectorField field;
    for (std::size_t c = 0; c < 3; ++c) {
        Spectrum spectrum(fourier_.spectrum_size());
        for (std::size_t m = 0; m < modes_.size(); ++m)
            spectrum[modes_[m].place] = coefficients[m][c];
        field[c] = fourier_.field_of(std::move(spectrum));
    }
    return field;
}

NavierStokes::Coefficients NavierStokes::curl(const Coefficients& v) const {
    Coefficients result(v.size());
    for (std::size_t m = 0; m < v.size(); ++m)
        for (std::size_t c = 0; c < 3; ++c) {
            const std::size_t a = (c + 1) % 3;
            const std::size_t b = (c + 2) % 3;
            result[m][c] = times_i(modes_[m].k[a] * v[m][b] - modes_[m].k[b] * v[m][a]);
        }
    return result;
}

void NavierStokes::project(Coefficients& coefficients) const {
    for (std::size_t m = 0; m < modes_.size(); ++m) {
        const Mode& mode = modes_[m];
        const std::complex<double> along = dot(mode.k, coefficients[m]) / mode.k2;
        for (std::size_t c = 0; c < 3; ++c)
            coefficients[m][c] -= mode.k[c] * along;
    }
}

NavierStokes::Coefficients NavierStokes::advection(const Coefficients& velocity) const {
    // Transforms take nearly all of the time, so two processors share them.
    auto vorticity = std::async(std::launch::async, [&] { return field_of(curl(velocity)); });
    VectorField u = field_of(velocity);
    const VectorField w = vorticity.get();
    for (std::size_t i = 0; i < fourier_.field_size(); ++i) {
        const std::array ui{u[0][i], u[1][i], u[2][i]};
        for (std::size_t c = 0; c < 3; ++c)
            u[c][i] = ui[(c + 1) % 3] * w[(c + 2) % 3][i] - ui[(c + 2) % 3] * w[(c + 1) % 3][i];
    }
    Coefficients result = kept(u);
    project(result);
    return result;
}

} // namespace isochron::app
