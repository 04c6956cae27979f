// Synthetic turbulence without a solver: a solenoidal velocity as a sum of random Fourier modes.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace isochron::app {

/// The velocity u(x, t) = sum of a exp(-0.0005 k^2 t) cos(k x + f t + p) in the periodic cube
/// [0, 2 pi)^3. Wave vectors k of whole numbers are drawn evenly from the shell
/// 2 <= |k| <= `longest`. Amplitudes a have length |k|^(-11/6) and are at right angles to k, so
/// that the divergence is zero and the energy falls as k^(-5/3). Frequencies f = 0.1 |k|^(2/3) N(0,
/// 1); random phases p. The sum can be evaluated on a grid of any size.
class FourierModes {
  public:
    explicit FourierModes(std::uint64_t seed, std::size_t modes = 96, int longest = 10);

    struct Mode {
        std::array<double, 3> k, amplitude, curl; ///< curl: k x amplitude
        double frequency, phase;
    };
    const std::vector<Mode>& modes() const { return modes_; }

    /// |curl u| at the n^3 vertices (2 pi / n)(x, y, z), [z][y][x], x fastest. The result does not
    /// depend on the number of threads.
    /// @param threads 0: one for each processor
    void vorticity_magnitude(std::size_t n, double time, std::span<float> out,
                             unsigned threads = 0) const;

    /// Factor to which a mode's amplitude has decayed at a time.
    static double remaining(const Mode& mode, double time);

  private:
    int longest_; ///< wave number
    std::vector<Mode> modes_;
};

} // namespace isochron::app
