// What involves several keys of a table: how an item of a list starts, and what is refused.
#pragma once

#include "app/config/config.h"
#include "app/config/toml_table.h"

namespace isochron::app {

/// Each is called with the last item of a list before its table is read.
/// @param owner the table or file that has the list
template <class Tracker>
requires requires(Tracker tracker) {
    tracker.common;
}
void begin(const Config& owner, std::vector<Tracker>& all) {
    all.back().common = owner.devices.common;
}
template <class Tracker, class Device>
requires requires(Device device) {
    device.device = Tracker().common;
}
void begin(const Tracker& owner, std::vector<Device>& all) {
    all.back().device = owner.common;
}
/// Colors differ from surface to surface.
void begin(const Config& owner, std::vector<ConfiguredSurface>& all);

/// Each is called when a table has been read. @param config what has been read so far
/// @throws ConfigError
void check(const TomlTable& at, const Config& config, stereo::Viewer& viewer);
void check(const TomlTable& at, const Config& config, stereo::Screen& screen);
void check(const TomlTable& at, const Config& config, stereo::Viewport& viewport);
void check(const TomlTable& at, const Config& config, stereo::Window& window);
void check(const TomlTable& at, const Config& config, interaction::PoseFilterLimits& limits);
void check(const TomlTable& at, const Config& config, interaction::DTrackDevice& device);
void check(const TomlTable& at, const Config& config, interaction::DTrackOptions& dtrack);
void check(const TomlTable& at, const Config& config, interaction::OscDevice& device);
void check(const TomlTable& at, const Config& config, interaction::OscOptions& osc);
void check(const TomlTable& at, const Config& config, interaction::VrpnDevice& device);
void check(const TomlTable& at, const Config& config, interaction::VrpnOptions& vrpn);
void check(const TomlTable& at, const Config& config, interaction::Coloring& coloring);
void check(const TomlTable& at, const Config& config, ConfiguredSurface& surface);
/// Takes over what one part of a file says of another, too.
void check(const TomlTable& at, const Config& same, Config& config);

} // namespace isochron::app
