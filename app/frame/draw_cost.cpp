// The cost of drawing, by weighted least squares.
#include "app/frame/draw_cost.h"

#include <algorithm>

namespace isochron::app {
namespace {

constexpr double kKept = 0.9;   ///< weight of a measurement relative to the next one
constexpr double kRidge = 1e-3; ///< makes the fit unique if the measurements do not

} // namespace

void DrawCost::add(const DrawLoad& load, Milliseconds time) {
    const auto take = [](double& sum, double value) { sum = kKept * sum + value; };
    take(weight_, 1);
    take(pixels_, load.pixels);
    take(cells_, load.cells);
    take(pixels_pixels_, load.pixels * load.pixels);
    take(pixels_cells_, load.pixels * load.cells);
    take(cells_cells_, load.cells * load.cells);
    take(pixels_time_, load.pixels * time.count());
    take(cells_time_, load.cells * time.count());
    take(time_, time.count());
}

std::optional<Milliseconds> DrawCost::predict(const DrawLoad& load) const {
    if (weight_ == 0)
        return std::nullopt;
    // In units of the mean load, so that the units favor neither part.
    const double p = pixels_ / weight_, c = cells_ / weight_;
    if (p <= 0 && c <= 0)
        return Milliseconds(time_ / weight_);
    if (p <= 0 || c <= 0) {
        const double mean = time_ / weight_;
        return Milliseconds(c <= 0 ? mean * load.pixels / p : mean * load.cells / c);
    }
    const double pp = pixels_pixels_ / (p * p) + kRidge * weight_;
    const double pc = pixels_cells_ / (p * c);
    const double cc = cells_cells_ / (c * c) + kRidge * weight_;
    const double pt = pixels_time_ / p, ct = cells_time_ / c;
    const double determinant = pp * cc - pc * pc;
    double a = (pt * cc - ct * pc) / determinant;
    double b = (ct * pp - pt * pc) / determinant;
    if (a < 0) {
        a = 0;
        b = ct / cc;
    } else if (b < 0) {
        a = pt / pp;
        b = 0;
    }
    return Milliseconds(std::max(0.0, a * load.pixels / p + b * load.cells / c));
}

} // namespace isochron::app
