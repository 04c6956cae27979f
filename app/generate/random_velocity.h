// Where turbulence starts from: a random velocity whose energy spectrum is given.
#pragma once

#include "app/generate/navier_stokes.h"

#include <cstdint>

namespace isochron::app {

/// A random solenoidal velocity in a cube of n^3 points with one and the same energy in every shell
/// of wave numbers for every seed, E(k) ~ k^4 exp(-2 (k / peak)^2), and a mean square of 1 in each
/// component (Passot and Pouquet, J. Fluid Mech. 181, 1987, doi:10.1017/S0022112087002167).
/// @param peak wave number at which the energy is highest
NavierStokes::VectorField random_velocity(std::size_t n, std::uint64_t seed, double peak);

} // namespace isochron::app
