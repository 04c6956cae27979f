// Receives UDP datagrams without ever waiting for one.
#pragma once

#include "interaction/pose.h"

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace isochron::interaction {

/// A numeric IPv4 or IPv6 address and a UDP port. To listen, the address is one of this machine's.
struct Endpoint {
    std::string address = "127.0.0.1";
    int port = 0; ///< to listen, 0 is any free port
    bool operator==(const Endpoint&) const = default;
};
/// `127.0.0.1:5000`, `[::1]:5000`.
std::string to_string(const Endpoint& endpoint);
bool is_address(const std::string& text);
/// Reads `192.168.0.10`, `192.168.0.10:5000`, `::1` or `[::1]:5000`; without a port it is 0.
std::optional<Endpoint> endpoint_from(const std::string& text);

struct Datagram {
    std::string bytes;
    Seconds age{0}; ///< how long it had been waiting in the kernel when it was taken
    Endpoint sender;
};
/// Decides whether to keep a datagram of this sender, which has waited for `age`.
using Admission = std::function<bool(const Endpoint& sender, Seconds age)>;

/// Whether the ages of datagrams are measured, by the kernel and the real clock, or are all 0, for
/// callers with a clock of their own, such as tests.
enum class DatagramAges : std::uint8_t { measured, none };

/// A socket that is bound to one address and receives the datagrams that are sent there.
class UdpSocket {
  public:
    static constexpr std::size_t kMostTaken = 1024; ///< per call of `take`
    /// @throws Error `udp 127.0.0.1:5000: Address already in use`
    explicit UdpSocket(const Endpoint& endpoint, DatagramAges ages = DatagramAges::measured);
    ~UdpSocket();
    UdpSocket(const UdpSocket&) = delete;
    UdpSocket& operator=(const UdpSocket&) = delete;

    /// Takes the waiting datagrams, at most `kMostTaken`, and returns the newest `kept` of them,
    /// oldest first. Datagrams longer than `kLongest` bytes are counted and thrown away. Those that
    /// `admits` refuses are dropped uncounted, so that they take no place among the newest.
    std::vector<Datagram>
    take(std::size_t kept, const Admission& admits = [](const Endpoint&, Seconds) { return true; });
    /// Waits until a datagram is waiting, or `wake` is called. May be called beside any other
    /// function of another thread.
    void wait() const;
    /// Whether the kernel's queue is filling: an eighth of it is taken.
    bool is_filling() const;
    /// Ends a wait, also the next one if there is none.
    void wake() const;
    /// From now on the kernel drops datagrams of all other senders; none: of no sender. What waits
    /// already stays. @return whether the kernel does
    bool hear_only(const std::optional<Endpoint>& sender);
    /// Throws away all waiting datagrams, uncounted.
    void drain();
    /// Number of datagrams that were taken but not kept, or were too long.
    std::uint64_t thrown_away() const { return thrown_away_; }
    /// The address it is bound to, with the actual port if 0 was asked for.
    const Endpoint& endpoint() const { return endpoint_; }

  private:
    static constexpr std::size_t kLongest = 65536; ///< [byte]
    Endpoint endpoint_;
    int socket_ = -1, wake_ = -1;
    std::string buffer_;
    std::uint64_t thrown_away_ = 0;
};

} // namespace isochron::interaction
