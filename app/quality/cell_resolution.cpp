// In how many pixels the cells of a moving picture are drawn.
#include "app/quality/cell_resolution.h"

#include <utility>

namespace isochron::app {

CellResolution::CellResolution(double least) {
    constexpr double kRounding = 1e-3;
    while (count_ < kCellResolutions.size() && kCellResolutions[count_] >= least - kRounding)
        ++count_;
    if (count_ <= kBeforeCells)
        shares_[kBeforeCells] = 1;
}

double CellResolution::learn(std::size_t step, double share) {
    constexpr double kNewestShare = 0.15, kMost = 1.3;
    /// By number: cells take their time in however few pixels.
    constexpr std::array<double, kCellResolutions.size()> kLeast{1.0, 0.5, 0.35, 0.3};
    if (step == 0)
        return 1;
    if (share < kLeast[step] || share > kMost)
        return shares_[step];
    const double newest = std::exchange(measured_[step], true) ? kNewestShare : 1;
    shares_[step] += newest * (share - shares_[step]);
    return share;
}

std::size_t CellResolution::choose(const std::optional<Milliseconds>& expected, Milliseconds budget,
                                   interaction::Seconds now) {
    constexpr double kFits = 0.9, kFitsFiner = 0.75; ///< shares of the budget
    const auto fits = [&](std::size_t step) {
        return !expected ||
               shares_[step] * *expected <= (step < step_.value() ? kFitsFiner : kFits) * budget;
    };
    std::size_t wanted = 0;
    while (wanted + 1 < count_ && !fits(wanted))
        ++wanted;
    // Where fewer pixels save nothing, there is no reason for them.
    constexpr double kSaves = 0.95;
    for (std::size_t step = wanted; step-- > 0;)
        if (shares_[wanted] > kSaves * shares_[step])
            wanted = step;
    return step_.turn(wanted, now);
}

} // namespace isochron::app
