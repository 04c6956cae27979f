// Even and uneven axes: the mean step, and a note if the spacing is uneven.
#include "index/formats/axis_positions.h"

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
            throw Error(
                fmt::format("{}: {}: {} after {}, expected coordinates that all increase or "
                            "all decrease (--spacing does without them)",
                            file, label, at[i], at[i - 1]));
        least = std::min(least, gap);
        most = std::max(most, gap);
        off = std::max(off, std::abs(at[i] - first - static_cast<double>(i) * step));
    }
    AxisSpread spread{first, step};
    constexpr double kEven = 0.02; // of the spacing: admits Gaussian latitudes, coordinates in f32
    const std::string of_unit = unit.empty() ? "" : " " + unit;
    if (off > kEven * std::abs(step))
        spread.note = fmt::format("{} is not uniform: vertices {:.4g} to {:.4g}{} apart are "
                                  "shown evenly, {:.4g}{} apart; --resample makes it uniform",
                                  label, least, most, of_unit, std::abs(step), of_unit);
    return spread;
}

void set_positions(Grid& grid, std::size_t axis, const std::vector<double>& at, double factor) {
    std::vector<double> distances;
    for (const double coordinate : at)
        distances.push_back(std::abs(coordinate - at.front()) * std::abs(factor));
    grid.positions[axis] = AxisPositions(std::move(distances));
}

} // namespace isochron::index
