// Datagrams from the network, without ever waiting for one.
#pragma once

#include "interaction/pose.h"

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace isochron::interaction {

/// Numeric address of one of this machine's interfaces, IPv4 or IPv6, and a UDP port.
struct Endpoint {
    std::string address = "127.0.0.1";
    int port = 0; ///< 0: any free one
    bool operator==(const Endpoint&) const = default;
};
/// `127.0.0.1:5000`, `[::1]:5000`.
std::string to_string(const Endpoint& endpoint);
bool is_address(const std::string& text);
/// Reads `192.168.0.10`, `192.168.0.10:5000`, `::1` or `[::1]:5000`; without a port it is 0.
std::optional<Endpoint> endpoint_from(const std::string& text);

struct Datagram {
    std::string bytes;
    Seconds age{0}; ///< how long it had been waiting here when it was taken
    Endpoint sender;
};
/// Whether a datagram of this sender, which has waited so long, is to be kept.
using Admission = std::function<bool(const Endpoint& sender, Seconds age)>;

/// A socket that is bound to one address and receives what is sent there.
class UdpSocket {
  public:
    static constexpr std::size_t kMostTaken = 1024; ///< per call of `take`
    /// @throws Error `udp 127.0.0.1:5000: Address already in use`
    explicit UdpSocket(const Endpoint& endpoint);
    ~UdpSocket();
    UdpSocket(const UdpSocket&) = delete;
    UdpSocket& operator=(const UdpSocket&) = delete;

    /// Takes what is waiting, at most `kMostTaken` datagrams, and keeps the newest `kept` of them,
    /// oldest first. Datagrams longer than `kLongest` bytes are counted and thrown away; those
    /// that `admits` refuses are passed over, so that they displace nobody's.
    std::vector<Datagram> take(
        std::size_t kept, const Admission& admits = [](const Endpoint&, Seconds) { return true; });
    /// Throws away all that is waiting, uncounted.
    void drain();
    /// Datagrams that were taken but not kept, or too long.
    std::uint64_t thrown_away() const { return thrown_away_; }
    /// With the port that was found, where any was asked for.
    const Endpoint& endpoint() const { return endpoint_; }

  private:
    static constexpr std::size_t kLongest = 65536; ///< [byte]
    Endpoint endpoint_;
    int socket_ = -1;
    std::string buffer_;
    std::uint64_t thrown_away_ = 0;
};

} // namespace isochron::interaction
