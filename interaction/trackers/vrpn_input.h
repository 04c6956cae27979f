// Devices of VRPN servers.
#pragma once

#include "interaction/trackers/tracked_device.h"

#include <memory>

namespace isochron::interaction {

/// Servers by VRPN's names, `Tracker0@host:3883`; an empty name: the device has none of these.
struct VrpnDevice {
    DeviceOptions device;
    std::string tracker, buttons, analog;
    int sensor = 0; ///< of the tracker
};

struct VrpnOptions {
    std::vector<VrpnDevice> devices;
};

/// Connecting to a server may take long and is tried again for ever: all of VRPN runs on a thread
/// of its own, and the frame takes over what has come since.
class VrpnInput final : public TrackedInput {
  public:
    explicit VrpnInput(const VrpnOptions& options);
    ~VrpnInput() override;
    InputState poll(Seconds now) override;
    InputState latch(Seconds now) override;
    /// `vrpn Tracker0@host: connected`, then the device.
    std::vector<std::string> status() const override;

  private:
    struct State;
    std::unique_ptr<State> state_;
};

} // namespace isochron::interaction
