// Processor times of operations that take anything from 50 ns to a second, measured in turn.
#pragma once

#include "tests/bench/measures/structure.h"

#include <cstdint>
#include <functional>
#include <vector>

namespace isochron::bench {

/// One full search of some step, or whatever else is timed step by step. Repeating it must give the
/// same result.
using Operation = std::function<void(std::uint32_t step)>;

/// Runs all operations one after the other at each step, over all steps, several times: what
/// disturbs the machine for a while disturbs all of them. Each runs once to fetch what it reads,
/// then as often as the clock needs; slow ones (above 5 ms) run once in each round.
/// @return for each operation the median over the steps of the medians over the rounds, in seconds
std::vector<double> time_in_turn(const std::vector<Operation>& operations, std::uint32_t steps,
                                 unsigned rounds);

/// Time of playback through all steps once, in seconds: the mean of forwards and backwards, the
/// median over the rounds.
/// @param go moves on to a step from the one before
double time_sweep(const Operation& go, std::uint32_t steps, unsigned rounds);

/// The middle of the numbers, which are not empty; of an even number the mean of the middle two.
double median(std::vector<double> numbers);

} // namespace isochron::bench
