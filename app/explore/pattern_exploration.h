// `explore --test-pattern`: the test pattern instead of data.
#pragma once

#include "app/explore/cluster_job.h"
#include "app/explore/explore_options.h"

namespace isochron::app {

/// Shows the test pattern with the devices and windows of a session, until the user leaves.
void explore_test_pattern(const ExploreOptions& options, ClusterJob& job);

} // namespace isochron::app
