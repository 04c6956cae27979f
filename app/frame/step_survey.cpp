// What the values of one step are like.
#include "app/frame/step_survey.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <numeric>

namespace isochron::app {
namespace {

constexpr std::uint16_t kNoBin = 0xffff; ///< bin of a vertex without a value

std::vector<std::uint16_t> bins_of(const index::StepValues& values, std::size_t step,
                                   StepSurvey& survey) {
    std::vector<std::uint16_t> bins(values.grid.vertex_count(), kNoBin);
    index::visit_value_type(values.type, [&]<class T>(std::type_identity<T>) {
        const auto stored = values.step<T>(step);
        for (const T each : stored)
            if (const double value = values.scaling(static_cast<double>(each));
                std::isfinite(value)) {
                survey.low = std::min(survey.low, value);
                survey.high = std::max(survey.high, value);
            }
        if (!survey.has_values())
            return;
        for (std::size_t i = 0; i < stored.size(); ++i)
            if (const double value = values.scaling(static_cast<double>(stored[i]));
                std::isfinite(value))
                bins[i] = static_cast<std::uint16_t>(survey.bin_of(value));
    });
    return bins;
}

/// Counts a cell where it becomes active, and takes it back where it is no longer active: an isovalue
/// at the middle of a bin lies above what is in the bins below.
void count_cells(const index::Grid& grid, const std::vector<std::uint16_t>& bins,
                 std::vector<std::uint64_t>& cells) {
    std::vector<std::int64_t> change(StepSurvey::kBins + 1, 0);
    const std::array<std::uint32_t, 3> size = grid.vertices;
    const std::size_t row = size[0], plane = row * size[1];
    for (std::size_t z = 0; z + 1 < size[2]; ++z)
        for (std::size_t y = 0; y + 1 < size[1]; ++y)
            for (std::size_t x = 0; x + 1 < size[0]; ++x) {
                const std::uint16_t* const at = bins.data() + z * plane + y * row + x;
                const auto [low, high] =
                    std::minmax({at[0], at[1], at[row], at[row + 1], at[plane], at[plane + 1],
                                 at[plane + row], at[plane + row + 1]});
                if (high == kNoBin || low == high)
                    continue;
                ++change[low + std::size_t{1}];
                --change[high + std::size_t{1}];
            }
    std::partial_sum(change.begin(), change.end(), change.begin());
    cells.assign(change.begin(), change.begin() + StepSurvey::kBins);
}

/// With as few digits as keep the value in its bin.
double with_few_digits(const StepSurvey& step, std::size_t bin) {
    const double value = step.middle_of(bin);
    const double width = (step.high / 2 - step.low / 2) / StepSurvey::kBins * 2;
    // A factor of 10^n rounds to the double nearest to the decimal, which 10^-n would miss.
    const double digits = -std::floor(std::log10(width)), factor = std::pow(10.0, std::abs(digits));
    const double rounded =
        digits > 0 ? std::round(value * factor) / factor : std::round(value / factor) * factor;
    return std::isfinite(rounded) && rounded > step.low && rounded < step.high &&
                   step.bin_of(rounded) == bin
               ? rounded
               : value;
}

} // namespace

double StepSurvey::middle_of(std::size_t bin) const {
    return std::lerp(low, high, (static_cast<double>(bin) + 0.5) / kBins);
}

std::size_t StepSurvey::bin_of(double value) const {
    const double span = high / 2 - low / 2; // halves keep it finite for any two doubles
    if (!(span > 0))
        return 0;
    const double share = (value / 2 - low / 2) / span;
    return std::min(static_cast<std::size_t>(std::clamp(share, 0.0, 1.0) * kBins), kBins - 1);
}

std::uint64_t StepSurvey::cells_at(double isovalue) const {
    return isovalue > low && isovalue <= high ? cells[bin_of(isovalue)] : 0;
}

StepSurvey survey_of(const index::StepValues& values, std::size_t step, bool whole) {
    StepSurvey survey;
    survey.whole = whole;
    const std::vector<std::uint16_t> bins = bins_of(values, step, survey);
    survey.histogram.assign(StepSurvey::kBins, 0);
    for (const std::uint16_t bin : bins)
        if (bin != kNoBin)
            ++survey.histogram[bin];
    count_cells(values.grid, bins, survey.cells);
    return survey;
}

std::optional<double> surface_in(const StepSurvey& step, double share) {
    if (!step.has_values() || step.is_constant())
        return std::nullopt;
    const auto total =
        std::accumulate(step.histogram.begin(), step.histogram.end(), std::uint64_t{0});
    std::uint64_t below = 0;
    std::size_t bin = 0;
    for (; bin + 1 < StepSurvey::kBins; ++bin)
        if (below += step.histogram[bin];
            static_cast<double>(below) >= share * static_cast<double>(total))
            break;
    if (step.cells[bin] == 0)
        bin = static_cast<std::size_t>(std::ranges::max_element(step.cells) - step.cells.begin());
    return step.cells[bin] > 0 ? std::optional(with_few_digits(step, bin)) : std::nullopt;
}

std::optional<double> further_isovalue(const StepSurvey& step, double first,
                                       std::span<const double> there) {
    constexpr double kWanted =
        0.25; ///< share of the first one's cells, in the middle of what may be
    constexpr std::size_t kApart = StepSurvey::kBins / 64; ///< from other surfaces, at least
    if (!step.has_values() || step.is_constant())
        return std::nullopt;
    const std::uint64_t most = *std::ranges::max_element(step.cells);
    const std::uint64_t of_first = step.cells_at(first);
    const auto base = static_cast<double>(of_first > 0 ? of_first : most);
    const auto is_near = [&](std::size_t bin) {
        return std::ranges::any_of(there, [&](double isovalue) {
            const auto other = static_cast<std::ptrdiff_t>(step.bin_of(isovalue));
            return isovalue >= step.low && isovalue <= step.high &&
                   std::abs(other - static_cast<std::ptrdiff_t>(bin)) <
                       static_cast<std::ptrdiff_t>(kApart);
        });
    };
    std::optional<std::size_t> best;
    double best_off = 0;
    for (std::size_t bin = 0; bin < StepSurvey::kBins; ++bin) {
        if (step.cells[bin] == 0 || is_near(bin))
            continue;
        const double off =
            std::abs(std::log(static_cast<double>(step.cells[bin]) / base / kWanted));
        // Among two that are as good, the one with the higher isovalue lies inside the other.
        if (!best || off <= best_off) {
            best = bin;
            best_off = off;
        }
    }
    return best ? std::optional(with_few_digits(step, *best)) : std::nullopt;
}

} // namespace isochron::app
