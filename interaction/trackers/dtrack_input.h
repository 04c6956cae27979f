// Input from an ART tracking system: turns DTrack's datagrams into devices.
#pragma once

#include "interaction/enum_names.h"
#include "interaction/trackers/tracked_device.h"
#include "interaction/trackers/udp_socket.h"

#include <memory>

namespace isochron::interaction {

enum class DTrackKind : std::uint8_t { body, flystick, marker };
template <>
inline constexpr std::array<std::string_view, 3> kNames<DTrackKind>{"body", "flystick", "marker"};

/// A body, Flystick or marker of DTrack as a device. A marker has a position only; it is oriented
/// along the tracker's axes.
struct DTrackDevice {
    DeviceOptions device;
    DTrackKind kind = DTrackKind::body;
    int id = 0; ///< in DTrack: bodies and Flysticks from 0, markers from 1
};

struct DTrackOptions {
    Endpoint endpoint{"127.0.0.1", 5000};
    std::optional<Endpoint> from; ///< the only allowed sender; port 0: any port of that address
    std::vector<DTrackDevice> devices;
    DatagramAges ages = DatagramAges::measured;
    DeviceOptions common; ///< what its devices share: where the tracker is, and how late it sends
    int line = 0;         ///< line of the file that describes it; 0: none does
};

/// A datagram whose frame counter is not newer than the newest so far is dropped. The time of a
/// pose is the controller's time stamp if it sends one (`ts`), else the time of arrival. One sender
/// counts at a time (`UsedSender`).
class DTrackInput final : public TrackedInput {
  public:
    /// @throws Error when the address cannot be bound
    explicit DTrackInput(const DTrackOptions& options);
    ~DTrackInput() override;
    InputState poll(Seconds now) override;
    InputState latch(Seconds now) override;
    void begin() override;
    /// `dtrack 127.0.0.1:5000: 3600 frames, 2 missing, 1 late, 0 malformed, 0 thrown away`, then a
    /// line for each device.
    std::vector<std::string> status() const override;
    /// The address and port on which it listens.
    const Endpoint& endpoint() const;

  private:
    struct State;
    std::unique_ptr<State> state_;
};

} // namespace isochron::interaction
