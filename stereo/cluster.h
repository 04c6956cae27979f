// The processes that show one room together: each waits for the others, but not for ever.
//
//     Cluster cluster(*team, {});
//     if (cluster.rank() == 0)
//         cluster.tell(order);
//     else
//         order = cluster.hear();
//     const auto answers = cluster.gather(mine);           // also a barrier
#pragma once

#include "index/system/team.h"

#include <chrono>
#include <condition_variable>
#include <deque>
#include <functional>
#include <mutex>
#include <stdexcept>
#include <string>
#include <thread>
#include <utility>
#include <vector>

namespace isochron::stereo {

/// How long a process is waited for.
struct ClusterLimits {
    using Duration = std::chrono::duration<double>;
    Duration silence{5}; ///< [s] without any sign of life: it is lost
    Duration stall{120}; ///< [s] that it may take for one thing while it lives
    bool operator==(const ClusterLimits&) const = default;
};

/// A process was waited for in vain: `process 3 on wall-left: no sign of life for 5 s`.
class ProcessLost : public std::runtime_error {
  public:
    using std::runtime_error::runtime_error;
};

/// A team whose members give each other signs of life, from threads of their own, so that work that
/// takes long is told from a process that was killed, stopped or cut off. Rank 0 watches the
/// others, and they watch rank 0, a little longer, so that one of them all says who is lost.
///
/// Everything goes through rank 0: an exchange takes two messages each, however many there are.
/// Whatever waits throws ProcessLost.
class Cluster final : public index::Team {
  public:
    /// Called by all members. @param team outlives this, and is not used beside it
    explicit Cluster(index::Team& team, const ClusterLimits& limits = {});
    ~Cluster() override;

    unsigned rank() const override { return team_.rank(); }
    unsigned size() const override { return team_.size(); }
    std::vector<std::vector<std::byte>> gather(std::span<const std::byte> mine) override;
    void post(unsigned to, std::span<const std::byte> message) override;
    std::optional<Message> poll() override;
    [[noreturn]] void abandon(int status) override;

    void set_limits(const ClusterLimits& limits);
    /// Called again and again while this member waits for another; what it throws ends the wait.
    void while_waiting(std::function<void()> check) { check_ = std::move(check); }

    /// From rank 0 to all others. Waits for nothing.
    void tell(std::span<const std::byte> message);
    /// What rank 0 tells, by all others.
    std::vector<std::byte> hear() { return await(0); }

    /// The name of the machine that a process runs on.
    const std::string& host_of(unsigned rank) const { return hosts_[rank]; }
    /// `process 3 on wall-left`.
    std::string name_of(unsigned rank) const;

  private:
    using Clock = std::chrono::steady_clock;
    class Watch;

    std::vector<std::byte> await(unsigned from);
    void send(unsigned to, std::span<const std::byte> message, std::byte kind);
    void beat(const std::stop_token& stop);
    ClusterLimits::Duration beat_interval() const;

    index::Team& team_;
    std::function<void()> check_ = [] {};
    std::vector<std::string> hosts_;
    std::vector<std::deque<std::vector<std::byte>>> inbox_; ///< by rank
    std::vector<Clock::time_point> heard_;                  ///< by rank: the last sign of life
    mutable std::mutex mutex_;                              ///< of limits_
    std::condition_variable_any changed_;
    ClusterLimits limits_;
    std::jthread beating_; ///< last: it uses the rest
};

} // namespace isochron::stereo
