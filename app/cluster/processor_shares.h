// Warns when processes of a cluster's job compete for the processors of one machine.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

namespace isochron::app {

/// The processors and threads that a process draws with.
struct ProcessorShare {
    std::string host;
    std::vector<int> processors; ///< numbers of those that it may run on
    std::size_t threads = 0;     ///< number that draw in software; 0: a GPU draws
};

/// @param shares of all processes
/// @return a line for each machine where more threads draw than there are processors for them; it
/// says what to set
std::vector<std::string> shared_processors(std::span<const ProcessorShare> shares);

} // namespace isochron::app
