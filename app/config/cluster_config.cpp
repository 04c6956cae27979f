// The part of a configuration that describes a cluster.
#include "app/config/cluster_config.h"

namespace isochron::app {

void read_cluster(TomlReader& reader, ClusterConfig& cluster) {
    reader.table("cluster", [&](TomlReader& inner) {
        double silence = cluster.limits.silence.count(), stall = cluster.limits.stall.count();
        inner.number("timeout", 0.5, 600.0, silence);
        inner.number("frame_timeout", 1.0, 86400.0, stall);
        cluster.limits = {stereo::ClusterLimits::Duration(silence),
                          stereo::ClusterLimits::Duration(stall)};
        inner.flag("swap_group", cluster.swap_group);
    });
}

} // namespace isochron::app
