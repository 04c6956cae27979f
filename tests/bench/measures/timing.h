// Measures processor times of operations in turn; each may take from 50 ns to a second.
#pragma once

#include "tests/bench/measures/structure.h"

#include <cstdint>
#include <functional>
#include <vector>

namespace isochron::bench {

/// One full search of a step, or anything else that is timed step by step. Repeating it must give
/// the same result.
using Operation = std::function<void(std::uint32_t step)>;

/// Runs all operations in turn at each step, over all steps, several times, so that other work on
/// the machine affects all of them. Each runs once to warm up the caches, then as often as the
/// clock needs; slow ones (above 5 ms) run once in each round.
/// @return for each operation the median over the steps of the medians over the rounds, in seconds
std::vector<double> time_in_turn(const std::vector<Operation>& operations, std::uint32_t steps,
                                 unsigned rounds);

/// Time to play all steps once, in seconds: the mean of forwards and backwards, as the median over
/// the rounds.
/// @param go goes to a step from the previous one
double time_sweep(const Operation& go, std::uint32_t steps, unsigned rounds);

/// The median of some numbers; of an even count the mean of the middle two. @param numbers not
/// empty
double median(std::vector<double> numbers);

} // namespace isochron::bench
