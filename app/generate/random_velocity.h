// The start of turbulence: a random velocity with a given energy spectrum.
#pragma once

#include "app/generate/navier_stokes.h"

#include <cstdint>

namespace isochron::app {

/// A random solenoidal velocity in a cube of n^3 points. Each shell of wave numbers has the energy
/// E(k) ~ k^4 exp(-2 (k / peak)^2), whatever the seed, and each component a mean square of 1
/// (Passot and Pouquet, J. Fluid Mech. 181, 1987, doi:10.1017/S0022112087002167).
/// @param peak wave number at which the energy is highest
NavierStokes::VectorField random_velocity(std::size_t n, std::uint64_t seed, double peak);

} // namespace isochron::app
