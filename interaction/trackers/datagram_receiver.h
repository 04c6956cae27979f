// Receives a tracker's datagrams, however many others come in on the same port.
#pragma once

#include "interaction/trackers/udp_socket.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <functional>
#include <mutex>
#include <string_view>
#include <thread>
#include <vector>

namespace isochron::interaction {

/// What a datagram is good for.
enum class Worth : std::uint8_t {
    nonsense,
    sensible, ///< it can be read, but tells nothing about the devices that are asked for
    useful
};

struct ReceiverOptions {
    Endpoint endpoint;
    DatagramAges ages = DatagramAges::measured;
    std::function<Worth(std::string_view)> worth; ///< called on any thread, one call at a time
};

/// Where ages are measured, a thread takes datagrams from the kernel whenever its queue fills, so
/// that it is never full when a good one comes. Datagrams of little worth never take the place of
/// others. With a clock of the caller there is no thread, and `take` does it all.
class DatagramReceiver {
  public:
    /// @throws Error as UdpSocket
    explicit DatagramReceiver(ReceiverOptions options);
    ~DatagramReceiver();
    DatagramReceiver(const DatagramReceiver&) = delete;
    DatagramReceiver& operator=(const DatagramReceiver&) = delete;

    /// Takes the newest `kept` of each worth among the datagrams since the last call that `admits`
    /// accepts, all in the order of their arrival.
    std::vector<Datagram>
    take(std::size_t kept, const Admission& admits = [](const Endpoint&, Seconds) { return true; });
    /// Throws away all that is waiting, uncounted.
    void drain();
    /// As UdpSocket::hear_only.
    void hear_only(const std::optional<Endpoint>& sender);
    /// Prefers a sender: few datagrams of all others wait from now on, so that a flood of them
    /// costs the next `take` little. None: no sender is preferred.
    void prefer(const std::optional<Endpoint>& sender);
    /// Number of datagrams of others that did not wait.
    std::uint64_t others() const;

    /// Number of admitted datagrams that were not kept, and of those that were too long.
    std::uint64_t thrown_away() const;
    const Endpoint& endpoint() const { return socket_.endpoint(); }

  private:
    struct Received {
        Datagram datagram;
        Seconds arrival;          ///< by the steady clock; where ages are not measured 0
        std::uint64_t number = 0; ///< in the order of reception
        Worth worth = Worth::nonsense;
    };
    static constexpr std::size_t kMostWaiting = UdpSocket::kMostTaken; ///< datagrams of each worth
    static constexpr std::size_t kMostOfOthers = 64;

    void receive();
    void run(const std::stop_token& stop);

    const ReceiverOptions options_;
    mutable std::mutex mutex_; ///< protects all but the endpoint
    UdpSocket socket_;
    std::optional<Endpoint> preferred_;
    std::array<std::deque<Received>, 4> waiting_; ///< by worth; the last one of others
    std::uint64_t received_ = 0, thrown_away_ = 0, others_ = 0;
    std::jthread thread_; ///< last member, as it uses the others
};

} // namespace isochron::interaction
