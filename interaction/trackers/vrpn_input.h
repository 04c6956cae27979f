// Input from devices of VRPN servers.
#pragma once

#include "interaction/trackers/tracked_device.h"

#include <memory>

namespace isochron::interaction {

/// Sources of a device, by VRPN's names: `Tracker0@host:3883`; an empty name: no such source.
struct VrpnDevice {
    DeviceOptions device;
    std::string tracker, buttons, analog;
    int sensor = 0; ///< number of the tracker's sensor
};

struct VrpnOptions {
    std::vector<VrpnDevice> devices;
    DeviceOptions common; ///< what its devices share: where the tracker is, and how late it sends
    int line = 0;         ///< line of the file that describes it; 0: none does
};

/// Connecting to a server may take long, and VRPN tries again forever. So all of VRPN runs on a
/// thread of its own; a poll takes over what that thread has received since.
class VrpnInput final : public TrackedInput {
  public:
    explicit VrpnInput(const VrpnOptions& options);
    ~VrpnInput() override;
    InputState poll(Seconds now) override;
    InputState latch(Seconds now) override;
    /// For each device `vrpn Tracker0@host Wand@host Stick@host: connected` (tracker, buttons,
    /// analog), then the device's line.
    std::vector<std::string> status() const override;

  private:
    struct State;
    std::unique_ptr<State> state_;
};

} // namespace isochron::interaction
