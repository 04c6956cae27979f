// Measures times of operations in turn.
#include "tests/bench/measures/timing.h"

#include "tests/bench/measures/stopwatch.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace isochron::bench {

namespace {

constexpr double kMeasurable = 30e-6; ///< [s] long enough that the cost of the clock is negligible
constexpr double kSlow = 5e-3;        ///< [s]
constexpr double kMostRepeats = 1000;

double seconds_of(const Operation& run, std::uint32_t step, unsigned repeats) {
    const Stopwatch watch;
    for (unsigned i = 0; i < repeats; ++i)
        run(step);
    return watch.seconds() / repeats;
}

} // namespace

double median(std::vector<double> numbers) {
    const auto middle = numbers.begin() + static_cast<std::ptrdiff_t>(numbers.size() / 2);
    std::nth_element(numbers.begin(), middle, numbers.end());
    if (numbers.size() % 2)
        return *middle;
    return (*middle + *std::max_element(numbers.begin(), middle)) / 2;
}

std::vector<double> time_in_turn(const std::vector<Operation>& operations, std::uint32_t steps,
                                 unsigned rounds) {
    // [operation][step][round]
    std::vector<std::vector<std::vector<double>>> times(operations.size(),
                                                        std::vector<std::vector<double>>(steps));
    for (unsigned round = 0; round < std::max(rounds, 1u); ++round)
        for (std::uint32_t step = 0; step < steps; ++step)
            for (std::size_t i = 0; i < operations.size(); ++i) {
                std::vector<double>& of_rounds = times[i][step];
                const double first = seconds_of(operations[i], step, 1);
                if (first > kSlow) {
                    of_rounds.push_back(first);
                    continue;
                }
                const double warm = seconds_of(operations[i], step, 1);
                of_rounds.push_back(
                    seconds_of(operations[i], step,
                               static_cast<unsigned>(
                                   std::clamp(std::ceil(kMeasurable / warm), 1.0, kMostRepeats))));
            }
    std::vector<double> medians;
    for (const auto& of_operation : times) {
        std::vector<double> of_steps;
        for (const auto& of_rounds : of_operation)
            of_steps.push_back(median(of_rounds));
        medians.push_back(median(std::move(of_steps)));
    }
    return medians;
}

double time_sweep(const Operation& go, std::uint32_t steps, unsigned rounds) {
    const auto there_and_back = [&] {
        const Stopwatch watch;
        for (std::uint32_t step = 0; step < steps; ++step)
            go(step);
        for (std::uint32_t step = steps; step-- > 0;)
            go(step);
        return watch.seconds() / 2;
    };
    there_and_back(); // warms up the caches
    std::vector<double> sweeps;
    for (unsigned round = 0; round < std::max(rounds, 1u); ++round)
        sweeps.push_back(there_and_back());
    return median(std::move(sweeps));
}

} // namespace isochron::bench
