// How well the blend of two steps stands for what lies between them.
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>

namespace isochron::index {

/// The error of a blend of neighboring steps, as a share of the error with every second step left
/// out, told by how the error grows with the distance. The error of a blend of steps d apart is
/// taken as A (1 - exp(-c d^2)): it grows with the square of d, up to A. With q = exp(-4 c), the
/// errors at d = 1, 2 and 4 are A (1 - q^(1/4)), A (1 - q) and A (1 - q^4).
/// @param grown error of steps four times as far apart over that of steps twice as far apart
/// @return 0.25 (smooth motion) to 1 (what is new in every step)
inline double share_of_nearer(double grown) {
    double low = 0, high = 1; // 1 + q + q^2 + q^3 = grown
    for (int i = 0; i < 40; ++i) {
        const double q = (low + high) / 2;
        (1 + q + q * q + q * q * q < grown ? low : high) = q;
    }
    constexpr double kSmooth = 0.25, kNearlyOne = 0.999;
    return low > kNearlyOne ? kSmooth : (1 - std::pow(low, 0.25)) / (1 - low);
}

/// The surface of the blend beside that of a step that was left out. Distances are in voxels, 95 %
/// of the cells are not farther off, and none counts as farther than kFarthest. A part of a surface
/// is lone if it has more than kSmallPart cells in a row in a chunk, and no cell there or in the chunks
/// around it that is next to one of the other surface.
struct BlendQuality {
    static constexpr double kFarthest = 16;
    static constexpr std::size_t kSmallPart = 50;
    double every_second = 0; ///< the step between two others
    /// The middle one of three between two others; none in a series of fewer than five steps.
    std::optional<double> every_fourth;
    std::uint64_t cells = 0;       ///< cells that were compared
    std::uint64_t lone_second = 0; ///< lone parts where every second step is left out
    /// Lone parts that are expected between two steps of the series itself.
    std::uint64_t lone = 0;

    /// How far the surface of the blend is expected to be off between two steps of the series
    /// itself.
    double expected() const {
        return every_fourth && every_second > 0
                   ? every_second * share_of_nearer(*every_fourth / every_second)
                   : every_second;
    }
    /// Whether to show the step before instead of the blend.
    bool holds() const { return expected() > 1.0 || lone > 0; }
    bool operator==(const BlendQuality&) const = default;
};

} // namespace isochron::index
