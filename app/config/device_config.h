// The trackers and other devices of an installation, as configuration files describe them.
#pragma once

#include "app/config/toml_reader.h"
#include "interaction/controls/desktop_emulation.h"
#include "interaction/navigation/comfort.h"
#include "interaction/trackers/dtrack_input.h"
#include "interaction/trackers/osc_input.h"
#include "interaction/trackers/vrpn_input.h"

#include <vector>

namespace isochron::app {

/// Lines of the file that describe the trackers, in the order of the trackers.
struct DevicePlaces {
    std::vector<int> dtrack, osc, vrpn;
};

/// The trackers, any number of each kind.
struct DeviceConfig {
    std::vector<interaction::DTrackOptions> dtrack;
    std::vector<interaction::OscOptions> osc;
    std::vector<interaction::VrpnOptions> vrpn;
    DevicePlaces places;
    bool empty() const { return dtrack.empty() && osc.empty() && vrpn.empty(); }
};

/// Reads the tables `tracking`, `dtrack`, `osc`, `vrpn` and `gamepad` of a configuration file.
void read_devices(TomlReader& root, DeviceConfig& devices,
                  interaction::EmulationOptions& emulation);

/// Reads the table `comfort`.
void read_comfort(TomlReader& root, interaction::ComfortOptions& comfort, bool& grid);

} // namespace isochron::app
