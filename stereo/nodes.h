// Which windows of an installation which process of a job opens.
#pragma once

#include "stereo/installation.h"

#include <string>
#include <vector>

namespace isochron::stereo {

/// Nodes are counted from 0; there is one more than the largest that a window names.
int node_count(const Installation& installation);

/// Every process stands for one node. Where there are fewer processes than nodes, neighboring
/// nodes share one: the first process has the first nodes, the last one the last.
int rank_of(int node, int nodes, int ranks);

/// Numbers of the windows that the process `rank` of `ranks` opens, ascending.
std::vector<std::size_t> windows_of(const Installation& installation, int rank, int ranks);

/// Adds the operator's window to an installation on whose node 0 no wall is and to which a process
/// of its own is given: the first process reads keyboard and mouse, and shows the panel.
void add_console(Installation& installation, int ranks);

/// Why so many processes cannot show this installation; empty when they can.
std::string misfit(const Installation& installation, int ranks);

/// The monitor that each of a process's windows covers: its own, or else the first one that no
/// window of the process covers.
/// @param numbers of the windows in the installation
std::vector<int> monitors_of(const Installation& installation,
                             const std::vector<std::size_t>& numbers);

} // namespace isochron::stereo
