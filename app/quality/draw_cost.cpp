// The cost of drawing, by recursive least squares.
#include "app/quality/draw_cost.h"

#include <algorithm>
#include <cmath>

namespace isochron::app {
namespace {

constexpr double kKept =
    0.9; ///< weight of a measurement relative to the next one that tells the same
/// Information on the difference between the two parts that is as good as none, where one
/// measurement counts as 1: times scatter by some tenths, so loads that differ by a tenth tell
/// nothing.
constexpr double kScatter = 0.02;

/// Where there are more cells than were ever measured, the time grows at least by this share of the
/// growth in cells: a first picture without cells may have taken longer than later ones with some,
/// as if any number of cells cost nothing.
constexpr double kLeastGrowth = 0.05;

/// What a load is measured in, so that the units favor neither part.
double unit_of(double load, double information) {
    return load > 0 ? load : information > 0 ? std::sqrt(information) : 1.0;
}

} // namespace

void DrawCost::add(const DrawLoad& load, Milliseconds time) {
    measured_ = true;
    most_cells_ = std::max(most_cells_, load.cells);
    // Forget along this load.
    const double along_pixels = pixels_pixels_ * load.pixels + pixels_cells_ * load.cells;
    const double along_cells = pixels_cells_ * load.pixels + cells_cells_ * load.cells;
    const double known = along_pixels * load.pixels + along_cells * load.cells;
    const double forgotten = known > 0 ? (1 - kKept) / known : 0;
    pixels_pixels_ += load.pixels * load.pixels - forgotten * along_pixels * along_pixels;
    pixels_cells_ += load.pixels * load.cells - forgotten * along_pixels * along_cells;
    cells_cells_ += load.cells * load.cells - forgotten * along_cells * along_cells;

    const double pixel = unit_of(load.pixels, pixels_pixels_);
    const double cell = unit_of(load.cells, cells_cells_);
    const double p = load.pixels / pixel, c = load.cells / cell; // 1, or 0 where there is nothing
    if (p == 0 && c == 0)
        return;
    // Pulls the difference between the two parts a little towards its last estimate.
    const double pp = pixels_pixels_ / (pixel * pixel) + kScatter * c * c;
    const double pc = pixels_cells_ / (pixel * cell) - kScatter * p * c;
    const double cc = cells_cells_ / (cell * cell) + kScatter * p * p;
    const double determinant = pp * cc - pc * pc;
    if (!(determinant > 0))
        return;
    const double unexpected = time.count() - of_pixel_ * load.pixels - of_cell_ * load.cells;
    of_pixel_ += (p * cc - c * pc) / determinant / pixel * unexpected;
    of_cell_ += (c * pp - p * pc) / determinant / cell * unexpected;
}

std::optional<Milliseconds> DrawCost::predict(const DrawLoad& load) const {
    if (!measured_ || (load.cells > 0 && cells_cells_ <= 0))
        return std::nullopt;
    // The best fit of those that are not below 0.
    double of_pixel = of_pixel_, of_cell = of_cell_;
    if (of_pixel < 0 && cells_cells_ > 0)
        of_cell += of_pixel * pixels_cells_ / cells_cells_;
    else if (of_cell < 0 && pixels_pixels_ > 0)
        of_pixel += of_cell * pixels_cells_ / pixels_pixels_;
    const auto fitted = [&](double cells) {
        return std::max(of_pixel, 0.0) * load.pixels + std::max(of_cell, 0.0) * cells;
    };
    double time = fitted(load.cells);
    if (load.cells > most_cells_ && most_cells_ > 0)
        time = std::max(time,
                        fitted(most_cells_) * (1 + kLeastGrowth * (load.cells / most_cells_ - 1)));
    return Milliseconds(time);
}

} // namespace isochron::app
