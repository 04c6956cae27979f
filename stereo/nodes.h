// Assigns the windows of an installation to the processes of a job.
#pragma once

#include "stereo/installation.h"

#include <string>
#include <vector>

namespace isochron::stereo {

/// Number of nodes: one more than the largest node of a window, as they count from 0.
int node_count(const Installation& installation);

/// The process of a node. With fewer processes than nodes, neighboring nodes share a process, in
/// order.
int rank_of(int node, int nodes, int ranks);

/// Numbers of the windows that the process `rank` of `ranks` opens, ascending.
std::vector<std::size_t> windows_of(const Installation& installation, int rank, int ranks);

/// Adds the operator's window if rank 0 has no window: rank 0 reads keyboard and mouse, and shows
/// the panel.
void add_console(Installation& installation, int ranks);

/// Why this number of processes cannot show the installation; empty if they can.
std::string misfit(const Installation& installation, int ranks);

/// The monitor of each of a process's windows: the configured one, or for fullscreen windows with
/// kNextMonitor the first that no other window of the process covers.
/// @param numbers of the windows in the installation
std::vector<int> monitors_of(const Installation& installation,
                             const std::vector<std::size_t>& numbers);

} // namespace isochron::stereo
