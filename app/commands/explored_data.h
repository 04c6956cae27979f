// Data to explore that no index was made of yet.
#pragma once

#include "app/commands/cluster_job.h"
#include "app/commands/explore_options.h"

namespace isochron::app {

/// With the index to show: the one that was given, or of files of values one that is kept in the
/// user's cache folder, made where it is not there.
/// @throws index::Error, UsageError
ExploreOptions with_index(ExploreOptions options, ClusterJob& job);

} // namespace isochron::app
