// Receives a tracker's datagrams, however many others come in on the same port.
//
//     DatagramReceiver receiver({.endpoint = endpoint, .from = from, .kept = 32, .worth = worth_of});
//     for (const Datagram& datagram : receiver.take(now))   // every frame
//         read(datagram.bytes);
#pragma once

#include "interaction/trackers/sender_choice.h"
#include "interaction/trackers/udp_socket.h"

#include <array>
#include <deque>
#include <functional>
#include <mutex>
#include <string_view>
#include <thread>

namespace isochron::interaction {

/// What a datagram is good for.
enum class Worth : std::uint8_t {
    nonsense,
    sensible, ///< it can be read, but tells nothing about the devices that are asked for
    useful
};

struct ReceiverOptions {
    Endpoint endpoint;
    std::optional<Endpoint> from; ///< the only allowed sender, see SenderChoice
    bool one_sender = true;       ///< one counts at a time; else all do
    DatagramAges ages = DatagramAges::measured;
    std::size_t kept = 32;                        ///< newest datagrams of each worth
    std::function<Worth(std::string_view)> worth; ///< called on any thread, one call at a time
};

/// Where ages are measured, a thread takes datagrams from the kernel as they come, so that its
/// queue is never full of those of others, and the kernel itself drops what does not come from the
/// chosen sender, once that has proven to make sense. Datagrams of little worth never take the
/// place of others. With a clock of the caller there is no thread, and `take` does it all.
class DatagramReceiver {
  public:
    /// @throws Error as UdpSocket
    explicit DatagramReceiver(ReceiverOptions options);
    ~DatagramReceiver();
    DatagramReceiver(const DatagramReceiver&) = delete;
    DatagramReceiver& operator=(const DatagramReceiver&) = delete;

    /// The newest datagrams of the chosen sender since the last call, oldest first.
    std::vector<Datagram> take(Seconds now);
    /// Throws away all that is waiting, uncounted.
    void drain();

    /// Number of datagrams of the chosen sender that were not kept, or were too long.
    std::uint64_t thrown_away() const;
    /// See SenderChoice. The kernel drops most strangers uncounted while the sender is heard.
    std::string strangers() const;
    const Endpoint& endpoint() const { return socket_.endpoint(); }

  private:
    struct Received {
        Datagram datagram;
        Seconds arrival;      ///< by the clock of `now`, or of the thread
        std::uint64_t number; ///< in the order of reception
    };

    void receive(Seconds now);
    void keep(Datagram datagram, Seconds now);
    void narrow_to_sender(Seconds now);
    void run(const std::stop_token& stop);

    const ReceiverOptions options_;
    mutable std::mutex mutex_; ///< protects all but the endpoint
    UdpSocket socket_;
    SenderChoice senders_;
    std::array<std::deque<Received>, 3> kept_; ///< by worth
    std::uint64_t received_ = 0, thrown_away_ = 0;
    bool narrowed_ = false; ///< to the chosen sender, by the kernel
    std::jthread thread_;   ///< last member, as it uses the others
};

} // namespace isochron::interaction
