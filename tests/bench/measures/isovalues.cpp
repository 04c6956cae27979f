// Chooses the isovalues at which a series is measured.
#include "tests/bench/measures/isovalues.h"

#include "index/scan/scan.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>

namespace isochron::bench {

namespace {

constexpr std::size_t kSample = 1 << 22; ///< values
constexpr std::size_t kSampleSteps = 8;

std::vector<double> sorted_sample(const index::StepValues& values) {
    const std::size_t vertices = values.grid.vertex_count();
    // An odd stride reaches all places along an axis of 2^n vertices.
    const std::size_t stride = values.steps * vertices / kSample | 1;
    std::vector<double> sample;
    index::visit_value_type(values.type, [&]<class T>(std::type_identity<T>) {
        for (std::size_t i = 0; i < values.steps * vertices; i += stride) {
            const auto stored = static_cast<double>(values.step<T>(i / vertices)[i % vertices]);
            if (std::isfinite(stored))
                sample.push_back(values.scaling(stored));
        }
    });
    std::sort(sample.begin(), sample.end());
    return sample;
}

double mean_active(const index::StepValues& values, double isovalue) {
    const std::size_t steps = std::min(values.steps, kSampleSteps);
    double sum = 0;
    std::vector<index::CellId> found;
    for (std::size_t i = 0; i < steps; ++i) {
        found.clear();
        index::scan(
            values,
            {index::Instant(static_cast<std::uint32_t>(i * values.steps / steps)), isovalue},
            found);
        sum += static_cast<double>(found.size());
    }
    return sum / static_cast<double>(steps);
}

/// Rounds to four digits, or between whole numbers if the values are whole numbers.
double rounded(const index::StepValues& values, double isovalue) {
    if (values.type != index::ValueType::f32 && values.type != index::ValueType::f64 &&
        values.scaling == index::Scaling{})
        return std::ceil(isovalue) - 0.5;
    if (isovalue == 0)
        return 0;
    const double unit = std::pow(10.0, std::floor(std::log10(std::abs(isovalue))) - 3);
    return std::round(isovalue / unit) * unit;
}

} // namespace

std::vector<double> quantile_isovalues(const index::StepValues& values, int count) {
    const std::vector<double> sample = sorted_sample(values);
    std::vector<double> isovalues;
    for (int k = 1; k <= count && !sample.empty(); ++k)
        isovalues.push_back(sample[sample.size() * static_cast<std::size_t>(k) /
                                   static_cast<std::size_t>(count + 1)]);
    return isovalues;
}

double isovalue_with(const index::StepValues& values, double active) {
    const std::vector<double> sample = sorted_sample(values);
    if (sample.empty())
        return 0;
    constexpr std::size_t kCoarse = 64;
    double best = sample.front(), most = -1;
    for (std::size_t k = kCoarse; k > 0; --k) {
        double low = sample[(sample.size() - 1) * (k - 1) / kCoarse];
        const double cells = mean_active(values, low);
        if (cells > most) {
            most = cells;
            best = low;
        }
        if (cells < active)
            continue;
        // Between this quantile and the next, the number of active cells falls below `active`.
        double high = sample[(sample.size() - 1) * k / kCoarse];
        for (int halving = 0; halving < 20; ++halving) {
            const double middle = (low + high) / 2;
            (mean_active(values, middle) < active ? high : low) = middle;
        }
        return rounded(values, low);
    }
    return rounded(values, best);
}

} // namespace isochron::bench
