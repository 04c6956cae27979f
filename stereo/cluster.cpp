// The processes that show one room together.
#include "stereo/cluster.h"

#include "index/error.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <exception>

#include <unistd.h>

namespace isochron::stereo {
namespace {

using Bytes = std::vector<std::byte>;
using Duration = ClusterLimits::Duration;

/// The kind of a message, in its first byte.
constexpr std::byte kBeat{0}, kWords{1};

std::string host_name() {
    std::array<char, 256> name{};
    ::gethostname(name.data(), name.size() - 1);
    return name.data();
}

/// Packs all members' bytes into one message, each after its size.
Bytes packed(const std::vector<Bytes>& parts) {
    Bytes all;
    for (const Bytes& part : parts) {
        const std::uint64_t size = part.size();
        const auto head = std::as_bytes(std::span(&size, 1));
        all.insert(all.end(), head.begin(), head.end());
        all.insert(all.end(), part.begin(), part.end());
    }
    return all;
}

std::vector<Bytes> unpacked(std::span<const std::byte> all, std::size_t count) {
    std::vector<Bytes> parts;
    for (std::uint64_t size = 0; parts.size() < count; all = all.subspan(size)) {
        if (all.size() < sizeof size)
            throw index::Error("cluster: a message is cut short");
        std::memcpy(&size, all.data(), sizeof size);
        all = all.subspan(sizeof size);
        if (size > all.size())
            throw index::Error("cluster: a message is cut short");
        parts.emplace_back(all.begin(), all.begin() + static_cast<std::ptrdiff_t>(size));
    }
    return parts;
}

/// Yields the processor at first; sleeps for a moment after many passes.
void pause(unsigned passes) {
    constexpr unsigned kBrief = 200;
    if (passes < kBrief)
        std::this_thread::yield();
    else
        std::this_thread::sleep_for(std::chrono::microseconds(50));
}

} // namespace

/// The limits of one wait for one member.
class Cluster::Watch {
  public:
    Watch(const Cluster& cluster, unsigned from) : cluster_(cluster), from_(from) {
        const std::scoped_lock lock(cluster.mutex_);
        limits_ = cluster.limits_;
        // Rank n waits n seconds longer for rank 0, so that rank 0, or a lower rank, is the one
        // that reports which process is lost.
        if (from == 0)
            limits_.silence += Duration(cluster.rank()), limits_.stall += Duration(cluster.rank());
    }

    /// @throws ProcessLost
    void check() {
        const Clock::time_point now = cluster_.now_();
        // If this process itself was stopped, it has missed the others' signs of life.
        if (now - last_ > kStoodStill)
            alive_ = now;
        last_ = now;
        const auto silent = now - std::max(alive_, cluster_.heard_[from_]);
        if (silent > limits_.silence)
            throw ProcessLost(fmt::format("{}: no sign of life for {:.3g} s: the job ends",
                                          cluster_.name_of(from_), Duration(silent).count()));
        if (now - start_ > limits_.stall)
            throw ProcessLost(fmt::format("{}: alive, but at one thing for {:.3g} s: the job ends",
                                          cluster_.name_of(from_), Duration(now - start_).count()));
    }

  private:
    static constexpr Duration kStoodStill{0.25};

    const Cluster& cluster_;
    const unsigned from_;
    ClusterLimits limits_;
    const Clock::time_point start_ = cluster_.now_();
    Clock::time_point alive_ = start_, last_ = start_;
};

Cluster::Cluster(index::Team& team, const ClusterLimits& limits,
                 std::function<Clock::time_point()> now)
    : team_(team), now_(std::move(now)), inbox_(team.size()), heard_(team.size()), limits_(limits) {
    if (size() > 1)
        beating_ = std::jthread([this](const std::stop_token& stop) { beat(stop); });
    const std::string mine = host_name();
    for (const Bytes& host : gather(std::as_bytes(std::span(mine))))
        hosts_.emplace_back(reinterpret_cast<const char*>(host.data()), host.size());
}

Cluster::~Cluster() = default;

void Cluster::abandon(int status) {
    team_.abandon(status);
    std::terminate(); // never reached, but the compiler does not know that
}

void Cluster::set_limits(const ClusterLimits& limits) {
    {
        const std::scoped_lock lock(mutex_);
        limits_ = limits;
    }
    changed_.notify_all();
}

std::string Cluster::name_of(unsigned rank) const {
    return rank < hosts_.size() ? fmt::format("process {} on {}", rank, hosts_[rank])
                                : fmt::format("process {}", rank);
}

/// The time between signs of life: a fraction of the longest allowed silence.
Duration Cluster::beat_interval() const {
    return std::min(Duration(0.5), limits_.silence / 8);
}

void Cluster::beat(const std::stop_token& stop) {
    std::unique_lock lock(mutex_);
    while (!stop.stop_requested()) {
        lock.unlock();
        if (rank() > 0)
            send(0, {}, kBeat);
        for (unsigned to = 1; rank() == 0 && to < size(); ++to)
            send(to, {}, kBeat);
        lock.lock();
        changed_.wait_for(lock, stop, beat_interval(), [] { return false; });
    }
}

void Cluster::send(unsigned to, std::span<const std::byte> message, std::byte kind) {
    Bytes whole{kind};
    whole.insert(whole.end(), message.begin(), message.end());
    team_.post(to, whole);
}

void Cluster::post(unsigned to, std::span<const std::byte> message) {
    send(to, message, kWords);
}

std::optional<index::Team::Message> Cluster::poll() {
    while (auto message = team_.poll()) {
        heard_[message->from] = now_();
        if (message->bytes.empty() || message->bytes.front() == kBeat)
            continue;
        message->bytes.erase(message->bytes.begin());
        return message;
    }
    return std::nullopt;
}

std::vector<std::byte> Cluster::await(unsigned from) {
    Watch watch(*this, from);
    for (unsigned passes = 0; inbox_[from].empty(); ++passes) {
        if (auto message = poll()) {
            inbox_[message->from].push_back(std::move(message->bytes));
            continue;
        }
        watch.check();
        check_();
        pause(passes);
    }
    Bytes words = std::move(inbox_[from].front());
    inbox_[from].pop_front();
    return words;
}

void Cluster::tell(std::span<const std::byte> message) {
    for (unsigned to = 1; to < size(); ++to)
        post(to, message);
}

std::vector<std::vector<std::byte>> Cluster::gather(std::span<const std::byte> mine) {
    if (rank() > 0) {
        post(0, mine);
        return unpacked(hear(), size());
    }
    std::vector<Bytes> all{{mine.begin(), mine.end()}};
    for (unsigned from = 1; from < size(); ++from)
        all.push_back(await(from));
    tell(packed(all));
    return all;
}

} // namespace isochron::stereo
