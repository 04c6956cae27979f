// Finds or makes the index of the data that a user wants to explore.
#pragma once

#include "app/commands/cluster_job.h"
#include "app/commands/explore_options.h"

namespace isochron::app {

/// Replaces files of values in the options by an index of them, which is kept in the user's cache
/// folder and made if it is missing. An index that was given stays.
/// @throws index::Error, UsageError
ExploreOptions with_index(ExploreOptions options, ClusterJob& job);

} // namespace isochron::app
