// The sender whose datagrams are used, on a port to which anybody can send.
#pragma once

#include "interaction/trackers/udp_socket.h"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace isochron::interaction {

/// One sender is used at a time: the first allowed one that is heard, until it has been silent for
/// a second. A sender whose first datagram makes no sense is ignored for up to a second. Senders
/// are told apart by address and port, so a second program on the tracker's machine is another
/// sender.
class UsedSender {
  public:
    /// @param from the only allowed sender, its port 0 for any port; none: anybody may send
    explicit UsedSender(std::optional<Endpoint> from) : from_(std::move(from)) {}

    /// @param arrival of a datagram [s of the session]
    /// @return whether to use it; if not, it is counted as a stranger's
    bool admits(const Endpoint& sender, Seconds arrival);
    /// Call after `admits`: whether the datagram that it admitted made sense.
    /// @param arrival of that datagram
    void heard(Seconds arrival);
    void made_no_sense(Seconds arrival);

    /// The sender that is used, while its datagrams make sense and it is not silent for a second.
    std::optional<Endpoint> proven(Seconds now) const;

    /// @param more of others, which were not even asked about
    /// `, 12 from others (127.0.0.1:4000)`; empty if there were none.
    std::string strangers(std::uint64_t more) const;

  private:
    struct Current {
        Endpoint sender;
        Seconds arrival;     ///< when its last datagram that made sense arrived, or its first one
        bool proven = false; ///< a datagram of it has made sense
    };
    std::optional<Endpoint> from_;
    std::optional<Current> current_;
    std::vector<Endpoint> noisy_; ///< senders that sent nonsense; forgotten after a second
    Seconds noisy_since_{0};
    std::uint64_t strangers_ = 0;
    Endpoint last_stranger_;
};

} // namespace isochron::interaction
