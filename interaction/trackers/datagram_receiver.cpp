// Receives a tracker's datagrams, however many others come in on the same port.
#include "interaction/trackers/datagram_receiver.h"

#include <algorithm>
#include <chrono>
#include <iterator>
#include <utility>

namespace isochron::interaction {

DatagramReceiver::DatagramReceiver(ReceiverOptions options)
    : options_(std::move(options)), socket_(options_.endpoint, options_.ages) {
    if (options_.ages == DatagramAges::measured)
        thread_ = std::jthread([this](const std::stop_token& stop) { run(stop); });
}

DatagramReceiver::~DatagramReceiver() = default;

void DatagramReceiver::run(const std::stop_token& stop) {
    const std::stop_callback wake(stop, [this] { socket_.wake(); });
    while (!stop.stop_requested()) {
        socket_.wait();
        // What comes at a tracker's rate waits in the kernel for the next frame; a flood does not
        // fill the queue in so short a time.
        std::this_thread::sleep_for(std::chrono::milliseconds(2));
        if (!socket_.is_filling())
            continue;
        const std::lock_guard lock(mutex_);
        receive();
    }
}

void DatagramReceiver::receive() {
    const Seconds now = options_.ages == DatagramAges::measured
                            ? Seconds(std::chrono::steady_clock::now().time_since_epoch())
                            : Seconds(0);
    for (Datagram& datagram : socket_.take(UdpSocket::kMostTaken)) {
        const Worth worth = options_.worth(datagram.bytes);
        const Seconds arrival = now - datagram.age;
        const bool of_others = preferred_ && datagram.sender != *preferred_;
        auto& waiting = of_others ? waiting_.back() : waiting_[static_cast<std::size_t>(worth)];
        waiting.push_back({std::move(datagram), arrival, received_++, worth});
        if (waiting.size() > (of_others ? kMostOfOthers : kMostWaiting)) {
            waiting.pop_front();
            ++(of_others ? others_ : thrown_away_);
        }
    }
}

std::vector<Datagram> DatagramReceiver::take(std::size_t kept, const Admission& admits) {
    std::vector<Received> all;
    Seconds now{0};
    {
        const std::lock_guard lock(mutex_);
        receive();
        if (options_.ages == DatagramAges::measured)
            now = std::chrono::steady_clock::now().time_since_epoch();
        for (auto& waiting : waiting_) {
            std::ranges::move(waiting, std::back_inserter(all));
            waiting.clear();
        }
    }
    std::ranges::sort(all, {}, &Received::number);
    for (Received& each : all)
        each.datagram.age = std::max(now - each.arrival, Seconds(0));
    std::erase_if(all, [&](const Received& each) {
        return !admits(each.datagram.sender, each.datagram.age);
    });
    std::array<std::size_t, 3> of_worth{};
    for (const Received& each : all)
        ++of_worth[static_cast<std::size_t>(each.worth)];
    std::vector<Datagram> taken;
    std::uint64_t older = 0;
    for (Received& each : all) {
        std::size_t& left = of_worth[static_cast<std::size_t>(each.worth)];
        if (left-- > kept)
            ++older;
        else
            taken.push_back(std::move(each.datagram));
    }
    const std::lock_guard lock(mutex_);
    thrown_away_ += older;
    return taken;
}

void DatagramReceiver::drain() {
    const std::lock_guard lock(mutex_);
    socket_.drain();
    for (auto& waiting : waiting_)
        waiting.clear();
}

void DatagramReceiver::hear_only(const std::optional<Endpoint>& sender) {
    const std::lock_guard lock(mutex_);
    socket_.hear_only(sender);
}

void DatagramReceiver::prefer(const std::optional<Endpoint>& sender) {
    const std::lock_guard lock(mutex_);
    preferred_ = sender;
}

std::uint64_t DatagramReceiver::others() const {
    const std::lock_guard lock(mutex_);
    return others_;
}

std::uint64_t DatagramReceiver::thrown_away() const {
    const std::lock_guard lock(mutex_);
    return thrown_away_ + socket_.thrown_away();
}

} // namespace isochron::interaction
