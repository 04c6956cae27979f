// Times of operations that take anything from 50 ns to a second, measured in turn.
#include "app/bench/timing.h"

#include "app/bench/stopwatch.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace isochron::app::bench {

namespace {

constexpr double kMeasurable = 30e-6; ///< [s] so long that calling the clock does not count
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
    struct Timed {
        std::vector<unsigned> repeats;            ///< [step]
        std::vector<std::vector<double>> of_step; ///< [step][round]
    };
    std::vector<Timed> all(operations.size());
    for (Timed& timed : all) {
        timed.repeats.resize(steps);
        timed.of_step.resize(steps);
    }
    for (unsigned round = 0; round < std::max(rounds, 1u); ++round)
        for (std::uint32_t step = 0; step < steps; ++step)
            for (std::size_t i = 0; i < operations.size(); ++i) {
                Timed& timed = all[i];
                if (round == 0) {
                    // The first run of a step fetches what it reads into the cache.
                    const double first = seconds_of(operations[i], step, 1);
                    if (first > kSlow) {
                        timed.of_step[step].push_back(first);
                        continue; // and no repeats in the rounds that follow
                    }
                    timed.repeats[step] = static_cast<unsigned>(
                        std::clamp(std::ceil(kMeasurable / first), 1.0, kMostRepeats));
                }
                if (timed.repeats[step])
                    timed.of_step[step].push_back(
                        seconds_of(operations[i], step, timed.repeats[step]));
            }
    std::vector<double> medians;
    for (const Timed& timed : all) {
        std::vector<double> of_steps;
        for (const auto& of_rounds : timed.of_step)
            of_steps.push_back(median(of_rounds));
        medians.push_back(median(std::move(of_steps)));
    }
    return medians;
}

Sweep time_sweep(const Operation& go, std::uint32_t steps, unsigned rounds) {
    std::vector<double> sweeps, single;
    const auto there_and_back = [&](const Operation& visit) {
        for (std::uint32_t step = 0; step < steps; ++step)
            visit(step);
        for (std::uint32_t step = steps; step-- > 0;)
            visit(step);
    };
    there_and_back(go); // warms up
    for (unsigned round = 0; round < std::max(rounds, 1u); ++round) {
        const Stopwatch watch;
        there_and_back(go);
        sweeps.push_back(watch.seconds() / 2);
        there_and_back([&](std::uint32_t step) { single.push_back(seconds_of(go, step, 1)); });
    }
    return {median(std::move(sweeps)), median(std::move(single))};
}

} // namespace isochron::app::bench
