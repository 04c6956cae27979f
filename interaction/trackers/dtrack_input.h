// An ART tracking system: DTrack's datagrams as devices.
#pragma once

#include "interaction/trackers/tracked_device.h"
#include "interaction/trackers/udp_socket.h"

#include <memory>

namespace isochron::interaction {

enum class DTrackKind : std::uint8_t { body, flystick, marker };

/// One of DTrack's things, by its number there from 0 (markers: from 1), as a device. A marker has
/// a position only; its orientation is the tracker's.
struct DTrackDevice {
    DeviceOptions device;
    DTrackKind kind = DTrackKind::body;
    int id = 0;
};

struct DTrackOptions {
    Endpoint endpoint{"127.0.0.1", 5000};
    std::optional<Endpoint> from; ///< who may send; port 0: from any port there
    std::vector<DTrackDevice> devices;
};

/// Datagrams that overtake each other are put right by their frame counter: one that is not newer
/// than the newest is dropped. Poses are dated by the controller's time stamps where it sends them
/// (`ts`), else by their arrival. One sender counts at a time (`SenderChoice`).
class DTrackInput final : public TrackedInput {
  public:
    /// @throws Error when the address cannot be bound
    explicit DTrackInput(const DTrackOptions& options);
    ~DTrackInput() override;
    InputState poll(Seconds now) override;
    InputState latch(Seconds now) override;
    void begin() override;
    /// `dtrack 127.0.0.1:5000: 3600 frames, 2 missing, 1 late, 0 malformed`, then its devices.
    std::vector<std::string> status() const override;
    /// Where it listens.
    const Endpoint& endpoint() const;

  private:
    struct State;
    std::unique_ptr<State> state_;
};

} // namespace isochron::interaction
