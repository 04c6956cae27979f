// Whether processes of a cluster's job stand in each other's way on one machine.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

namespace isochron::app {

/// What a process draws with.
struct ProcessorShare {
    std::string host;
    std::vector<int> processors; ///< that it may run on
    std::size_t threads = 0;     ///< that draw in software; 0: a GPU draws
};

/// @param shares of all processes
/// @return a line for each machine on which more threads draw than there are processors for them,
/// with what to set
std::vector<std::string> shared_processors(std::span<const ProcessorShare> shares);

} // namespace isochron::app
