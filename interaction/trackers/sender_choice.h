// Whose datagrams count, where anybody can send.
#pragma once

#include "interaction/trackers/udp_socket.h"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace isochron::interaction {

/// One sender counts at a time: of those allowed, the first that was heard, until it has been silent
/// for a second. Who starts with nonsense is passed over. Senders differ by address and port, so a
/// second program on the tracker's own machine is another sender.
class SenderChoice {
  public:
    /// @param from who may send at all: an address, with a port or (0) any; none: anybody
    explicit SenderChoice(std::optional<Endpoint> from) : from_(std::move(from)) {}

    /// @param arrival of a datagram [s of the session]
    /// @return whether it counts; one that does not is counted as a stranger's
    bool admits(const Endpoint& sender, Seconds arrival);
    /// That what the sender who counts has sent at that time makes sense, or does not.
    void heard(Seconds arrival);
    void made_no_sense(Seconds arrival);

    /// `, 12 from others (127.0.0.1:4000)`, empty where there were none.
    std::string strangers() const;

  private:
    struct Current {
        Endpoint sender;
        Seconds arrival;     ///< of the last that made sense
        bool proven = false; ///< by one that did
    };
    std::optional<Endpoint> from_;
    std::optional<Current> current_;
    std::vector<Endpoint> noisy_; ///< not to be chosen for a second
    Seconds noisy_since_{0};
    std::uint64_t strangers_ = 0;
    Endpoint last_stranger_;
};

} // namespace isochron::interaction
