// Even and uneven axes: the mean step, and a note if the spacing is very uneven.
#include "index/readers/formats/axis_positions.h"

#include "index/error.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace isochron::index {

AxisSpread spread_of(const std::vector<double>& at, const std::string& label,
                     const std::string& unit, const std::string& file) {
    const auto last = static_cast<double>(at.size() - 1);
    const double first = at.front(), step = (at.back() - first) / last;
    double least = HUGE_VAL, most = 0, off = 0;
    for (std::size_t i = 1; i < at.size(); ++i) {
        const double gap = (at[i] - at[i - 1]) * (step < 0 ? -1 : 1);
        if (!(gap > 0) || !std::isfinite(gap))
            throw Error("{}: {}: {} after {}, expected coordinates that all increase or all "
                        "decrease (--spacing does without them)",
                        file, label, at[i], at[i - 1]);
        least = std::min(least, gap);
        most = std::max(most, gap);
        off = std::max(off, std::abs(at[i] - first - static_cast<double>(i) * step));
    }
    AxisSpread spread{first, step};
    // Rounding does not make vertices uneven: of the spacing, and of coordinates in f32.
    constexpr double kOfSpacing = 1e-5, kOfCoordinates = 4 * 0x1p-23;
    const double rounding =
        std::max(kOfSpacing * std::abs(step),
                 kOfCoordinates * std::max(std::abs(first), std::abs(at.back())));
    spread.uneven = off > rounding;
    constexpr double kWorthANote = 0.02; // share of the spacing; Gaussian latitudes stay below
    if (off > kWorthANote * std::abs(step))
        spread.note = fmt::format("{} is not uniform: vertices {:.4g} to {:.4g}{} apart", label,
                                  least, most, unit.empty() ? "" : " " + unit);
    return spread;
}

void set_positions(Grid& grid, std::size_t axis, const std::vector<double>& at, double factor) {
    std::vector<double> distances;
    for (const double coordinate : at)
        distances.push_back(std::abs(coordinate - at.front()) * std::abs(factor));
    grid.positions[axis] = AxisPositions(std::move(distances));
}

std::string with_own_unit(const std::string& name, const std::string& unit) {
    return unit.empty() ? name : fmt::format("{} ({})", name, unit);
}

} // namespace isochron::index
