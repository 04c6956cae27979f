// Input from devices that send their state as Open Sound Control messages.
#pragma once

#include "interaction/trackers/tracked_device.h"
#include "interaction/trackers/udp_socket.h"

#include <memory>

namespace isochron::interaction {

struct OscDevice {
    DeviceOptions device;
    std::string source; ///< NAME in the addresses below
};

/// Addresses under `prefix`, with any numeric argument types:
///
///     PREFIX/NAME/pose x y z qx qy qz qw     meters, unit quaternion
///     PREFIX/NAME/velocity vx vy vz wx wy wz meters and radians per second, of the next pose
///     PREFIX/NAME/button i state             0 is up
///     PREFIX/NAME/valuator i value
///
/// The time tag of a bundle is the time of measurement by the sender's clock. While a button is
/// down or a valuator is not at rest, the sender must send something at least every
/// `limits.lost_after`, or all of them go to rest.
struct OscOptions {
    Endpoint endpoint{"127.0.0.1", 9000};
    std::string prefix = "/isochron";
    std::vector<OscDevice> devices;
    DatagramAges ages = DatagramAges::measured;
    DeviceOptions common; ///< what its devices share: where the tracker is, and how late it sends
    int line = 0;         ///< line of the file that describes it; 0: none does
};

class OscInput final : public TrackedInput {
  public:
    /// @throws Error when the address cannot be bound
    explicit OscInput(const OscOptions& options);
    ~OscInput() override;
    InputState poll(Seconds now) override;
    InputState latch(Seconds now) override;
    void begin() override;
    /// `osc 127.0.0.1:9000: 3600 messages, 2 of wrong types, ..`, then a line for each device.
    std::vector<std::string> status() const override;
    const Endpoint& endpoint() const;

  private:
    struct State;
    std::unique_ptr<State> state_;
};

} // namespace isochron::interaction
