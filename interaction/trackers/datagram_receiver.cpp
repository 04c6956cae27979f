// Receives a tracker's datagrams, however many others come in on the same port.
#include "interaction/trackers/datagram_receiver.h"

#include <algorithm>
#include <chrono>
#include <iterator>
#include <utility>

namespace isochron::interaction {
namespace {

/// The clock of the thread.
Seconds steady_now() {
    return std::chrono::steady_clock::now().time_since_epoch();
}

} // namespace

DatagramReceiver::DatagramReceiver(ReceiverOptions options)
    : options_(std::move(options)), socket_(options_.endpoint, options_.ages),
      senders_(options_.from) {
    if (options_.ages == DatagramAges::measured)
        thread_ = std::jthread([this](const std::stop_token& stop) { run(stop); });
}

DatagramReceiver::~DatagramReceiver() = default;

void DatagramReceiver::run(const std::stop_token& stop) {
    const std::stop_callback wake(stop, [this] { socket_.wake(); });
    constexpr std::chrono::milliseconds kLookAtSender{100};
    while (!stop.stop_requested()) {
        socket_.wait(kLookAtSender);
        const std::lock_guard lock(mutex_);
        receive(steady_now());
        narrow_to_sender(steady_now());
    }
}

void DatagramReceiver::receive(Seconds now) {
    for (Datagram& datagram : socket_.take(UdpSocket::kMostTaken))
        keep(std::move(datagram), now);
}

void DatagramReceiver::keep(Datagram datagram, Seconds now) {
    const Seconds arrival = now - datagram.age;
    if (options_.one_sender && !senders_.admits(datagram.sender, arrival))
        return;
    const Worth worth = options_.worth(datagram.bytes);
    if (options_.one_sender)
        worth == Worth::nonsense ? senders_.made_no_sense(arrival) : senders_.heard(arrival);
    auto& kept = kept_[static_cast<std::size_t>(worth)];
    kept.push_back({std::move(datagram), arrival, received_++});
    if (kept.size() > options_.kept) {
        kept.pop_front();
        ++thrown_away_;
    }
}

void DatagramReceiver::narrow_to_sender(Seconds now) {
    const auto sender = options_.one_sender ? senders_.proven(now) : std::nullopt;
    if (sender.has_value() != narrowed_)
        narrowed_ = socket_.hear_only(sender) && sender.has_value();
}

std::vector<Datagram> DatagramReceiver::take(Seconds now) {
    const bool measured = options_.ages == DatagramAges::measured;
    const std::lock_guard lock(mutex_);
    const Seconds clock = measured ? steady_now() : now;
    receive(clock);
    std::vector<Received> all;
    for (auto& kept : kept_) {
        std::ranges::move(kept, std::back_inserter(all));
        kept.clear();
    }
    std::ranges::sort(all, {}, &Received::number);
    std::vector<Datagram> taken;
    for (Received& each : all) {
        each.datagram.age = clock - each.arrival;
        taken.push_back(std::move(each.datagram));
    }
    return taken;
}

void DatagramReceiver::drain() {
    const std::lock_guard lock(mutex_);
    socket_.drain();
    for (auto& kept : kept_)
        kept.clear();
}

std::uint64_t DatagramReceiver::thrown_away() const {
    const std::lock_guard lock(mutex_);
    return thrown_away_ + socket_.thrown_away();
}

std::string DatagramReceiver::strangers() const {
    const std::lock_guard lock(mutex_);
    return senders_.strangers();
}

} // namespace isochron::interaction
