// The part of a configuration that describes a cluster.
#pragma once

#include "app/config/toml_reader.h"
#include "stereo/cluster.h"

namespace isochron::app {

struct ClusterConfig {
    stereo::ClusterLimits limits;
    bool swap_group = false; ///< let the graphics driver swap all windows at once
};

/// Reads `cluster`; what is absent keeps its default. @throws ConfigError
void read_cluster(TomlReader& reader, ClusterConfig& cluster);

} // namespace isochron::app
