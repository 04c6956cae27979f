// The data that the program can generate: to try it out, to test it and to measure it.
#pragma once

#include "index/progress.h"
#include "index/volume/volume_series.h"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>

namespace isochron::app {

/// The moving spherical isosurface of the paper's measurements (section 6): 61 x 50 x 60 vertices
/// at distance 1, 255 exp(-d^2 / 242) at distance d from a center that moves along a line. At
/// isovalue 112.5 the sphere has radius 14.07 and some 3,730 active cells.
struct SphereSeries {
    static constexpr const char* kName = "sphere";
    index::ValueType type = index::ValueType::f32; ///< or u8: rounded
    std::size_t steps = 55;                        ///< at least 1; step t is at time t
};

/// Vorticity magnitude of decaying turbulence, a real run of the Navier-Stokes equations in the
/// periodic cube [0, 2 pi)^3 (see navier_stokes.h), from a start that depends on the seed alone.
/// Between two steps surfaces move by about half a cell.
struct VorticitySeries {
    static constexpr const char* kName = "vorticity";
    std::uint64_t seed = 1;
    index::ValueType type = index::ValueType::f32; ///< or u8: 255 stands for the highest value
    std::size_t size = 64;                         ///< vertices along each axis, 16 to 256
    std::size_t steps = 64;                        ///< at least 1

    // Chosen by measurement over several seeds, at the isovalue with 3,940 active cells on average:
    // from one step to the next, added and removed cells together are about 45 % of the active
    // ones. Finer grids have shorter steps, so that surfaces move by the same number of cells.
    static constexpr double kPeak = 1.0;        ///< most energy in vortices as large as the cube
    static constexpr double kViscosity = 0.008; ///< the smallest eddies are just resolved at 64^3
    /// Steps of the integrator for one step of the series.
    static constexpr std::size_t kSubsteps = 3;
    double substep() const { return 0.0222 * 64.0 / static_cast<double>(size); }
    // The series starts when vortices have stretched each other into tubes. When that happens
    // depends on the seed and shows in the enstrophy, which starts below 3 and peaks near 15. In
    // cubes too coarse to reach kFirstEnstrophy the series starts at time kLatestStart.
    static constexpr double kFirstEnstrophy = 10.0;
    static constexpr double kLatestStart = 4.0;
};

/// Vorticity magnitude of random Fourier modes in the periodic cube [0, 2 pi)^3 (fourier_modes.h):
/// turbulence of any size at little cost, without the coherence of a real flow. A finer grid
/// samples the same field, so its surfaces move by more cells from step to step.
struct FourierSeries {
    static constexpr const char* kName = "fourier";
    std::uint64_t seed = 12345;
    index::ValueType type = index::ValueType::f32; ///< or u8: 255 stands for the highest value
    std::size_t size = 128;                        ///< vertices along each axis, 16 to 1024
    std::size_t steps = 64;                        ///< at least 1; step t is at time t
    std::size_t modes = 96;                        ///< 1 to 4096
    int longest = 10;                              ///< longest wave vector, 2 to size / 2
};

/// Array name, grid and type; without times.
index::SeriesInfo describe(const SphereSeries& series);
index::SeriesInfo describe(const VorticitySeries& series);
index::SeriesInfo describe(const FourierSeries& series);

/// Receives the steps in order: stored values [z][y][x] of the series' type, and the step's time.
using StepSink = std::function<void(std::span<const std::byte> values, double time)>;

/// Makes all steps, in order. The same request gives the same values.
void make_steps(const SphereSeries& series, const StepSink& sink, const index::Progress& progress);
void make_steps(const VorticitySeries& series, const StepSink& sink,
                const index::Progress& progress);
void make_steps(const FourierSeries& series, const StepSink& sink, const index::Progress& progress);

} // namespace isochron::app
