// Solves incompressible flow in a periodic cube: the turbulence of the demo data.
#pragma once

#include "app/generate/fourier.h"

#include <array>
#include <complex>
#include <cstddef>
#include <vector>

namespace isochron::app {

/// Decaying flow of a viscous, incompressible fluid of density 1 in the periodic cube [0, 2 pi)^3,
/// du/dt = u x curl u - grad(p + u^2/2) + nu laplace u, div u = 0, without a driving force.
///
/// Pseudo-spectral (Orszag and Patterson, Phys. Rev. Lett. 28, 1972,
/// doi:10.1103/PhysRevLett.28.76): products are computed at the points; derivatives, and the
/// projection that replaces the pressure, on the coefficients. Only wave vectors with 3 |k| < n are
/// kept (the 2/3 rule), so that products do not alias into them and only viscosity takes energy
/// away. Time steps: the classical fourth-order Runge-Kutta method, with exact integration of
/// viscosity.
///
///     NavierStokes flow(64, 0.01, random_velocity(...));
///     while (flow.time() < 2.0)
///         flow.advance(0.01);
///     const Field vorticity = flow.vorticity_magnitude();
class NavierStokes {
  public:
    using VectorField = std::array<Field, 3>;

    /// @param n         points along each axis, at least 4
    /// @param viscosity kinematic, at least 0
    /// @param velocity  at time 0; only its solenoidal part below the cutoff is used
    NavierStokes(std::size_t n, double viscosity, const VectorField& velocity);

    /// Advances by one step. Stable while dt * n/3 * (highest speed) is below about 2.8.
    void advance(double dt);

    double time() const { return time_; }
    double energy() const;     ///< kinetic, mean of |u|^2 / 2
    double enstrophy() const;  ///< mean of |curl u|^2 / 2; energy falls at 2 nu enstrophy
    double divergence() const; ///< div u over the velocity gradient, root mean squares
    VectorField velocity() const;
    Field vorticity_magnitude() const; ///< |curl u| at the points

  private:
    /// One kept Fourier coefficient of a vector field.
    using Coefficient = std::array<std::complex<double>, 3>;
    using Coefficients = std::vector<Coefficient>;
    struct Mode {
        std::array<double, 3> k; ///< wave vector
        double k2;               ///< |k|^2
        double weight;           ///< in sums: 2 if it stands for its conjugate as well, else 1
        std::size_t place;       ///< index in a Spectrum
    };

    Coefficients kept(const VectorField& field) const;
    VectorField field_of(const Coefficients& coefficients) const;
    Coefficients curl(const Coefficients& coefficients) const;
    void project(Coefficients& coefficients) const;
    Coefficients advection(const Coefficients& velocity) const;

    Fourier fourier_;
    double viscosity_;
    double time_ = 0.0;
    std::vector<Mode> modes_;
    Coefficients velocity_;
};

} // namespace isochron::app
