// The series that the program can make by itself, to try it and to test it.
#pragma once

#include "index/progress.h"
#include "index/value_type.h"

#include <cstddef>
#include <cstdint>
#include <filesystem>

namespace isochron::app {

/// The moving spherical isosurface of the paper's measurements (section 6): 61 x 50 x 60 vertices
/// at distance 1, 255 exp(-d^2 / 242) at distance d from a centre that moves along a line. At
/// isovalue 112.5 the sphere has radius 14.07 and some 3,730 active cells.
struct SphereSeries {
    index::ValueType type = index::ValueType::f32; ///< or u8: rounded
    std::size_t steps = 55;                        ///< at least 1; step t is at time t
};

/// Vorticity magnitude of decaying turbulence, a real run of the Navier-Stokes equations in the
/// periodic cube [0, 2 pi)^3 (see navier_stokes.h), from a start that depends on the seed alone.
/// Between two steps surfaces move by about half a cell.
struct VorticitySeries {
    std::uint64_t seed = 1;
    index::ValueType type = index::ValueType::f32; ///< or u8: 255 stands for the highest value
    std::size_t size = 64;                         ///< vertices along each axis, 16 to 256
    std::size_t steps = 64;                        ///< at least 1
};

/// Writes the series as `dir/sphere.pvd` or `dir/vorticity.pvd` with one .vti per step, and beside
/// it how it was made, `dir/sphere.json` or `dir/vorticity.json`. The same request gives the same
/// bytes.
/// @return false when the folder held exactly this series already; then nothing is written
/// @throws index::Error when the folder holds another series of that name, or cannot be written
bool generate(const SphereSeries& series, const std::filesystem::path& dir,
              const index::Progress& progress);
bool generate(const VorticitySeries& series, const std::filesystem::path& dir,
              const index::Progress& progress);

} // namespace isochron::app
