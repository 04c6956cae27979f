// The processes that show one room together: each waits for the others, but not forever.
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

/// How long to wait for a process before it counts as lost. In configuration files `silence` is
/// `timeout`, and `stall` is `frame_timeout`.
struct ClusterLimits {
    using Duration = std::chrono::duration<double>;
    Duration silence{5}; ///< [s] without a sign of life
    Duration stall{120}; ///< [s] for one answer, while it gives signs of life
    bool operator==(const ClusterLimits&) const = default;
};

/// A process did not answer in time: `process 3 on wall-left: no sign of life for 5 s`.
class ProcessLost : public std::runtime_error {
  public:
    using std::runtime_error::runtime_error;
};

/// A team whose members send each other signs of life from background threads. So long work can be
/// told from a process that was killed, stopped or disconnected. Rank 0 watches the others, and
/// they watch rank 0 with longer limits, so that only one process reports which one is lost.
///
/// Everything goes through rank 0: an exchange takes two messages per process, however many there
/// are. Everything that waits may throw ProcessLost.
class Cluster final : public index::Team {
  public:
    using Clock = std::chrono::steady_clock;

    /// All members must call it.
    /// @param team outlives this; use it only through this from now on
    /// @param now the clock of the limits, asked from the thread that waits
    explicit Cluster(index::Team& team, const ClusterLimits& limits = {},
                     std::function<Clock::time_point()> now = Clock::now);
    ~Cluster() override;

    unsigned rank() const override { return team_.rank(); }
    unsigned size() const override { return team_.size(); }
    std::vector<std::vector<std::byte>> gather(std::span<const std::byte> mine) override;
    void post(unsigned to, std::span<const std::byte> message) override;
    std::optional<Message> poll() override;
    [[noreturn]] void abandon(int status) override;

    void set_limits(const ClusterLimits& limits);
    /// Sets a function that is called repeatedly while this member waits for another one; an
    /// exception from it ends the wait.
    void while_waiting(std::function<void()> check) { check_ = std::move(check); }

    /// Sends a message from rank 0 to all others. Does not wait.
    void tell(std::span<const std::byte> message);
    /// Waits for the next message from rank 0; for all other ranks.
    std::vector<std::byte> hear() { return await(0); }

    /// The name of the machine that a process runs on.
    const std::string& host_of(unsigned rank) const { return hosts_[rank]; }
    /// `process 3 on wall-left`.
    std::string name_of(unsigned rank) const;

  private:
    class Watch;

    std::vector<std::byte> await(unsigned from);
    void send(unsigned to, std::span<const std::byte> message, std::byte kind);
    void beat(const std::stop_token& stop);
    ClusterLimits::Duration beat_interval() const;

    index::Team& team_;
    const std::function<Clock::time_point()> now_;
    std::function<void()> check_ = [] {};
    std::vector<std::string> hosts_;
    std::vector<std::deque<std::vector<std::byte>>> inbox_; ///< by rank
    std::vector<Clock::time_point> heard_;                  ///< by rank: the last sign of life
    mutable std::mutex mutex_;                              ///< protects limits_
    std::condition_variable_any changed_;
    ClusterLimits limits_;
    std::jthread beating_; ///< last member, as it uses the others
};

} // namespace isochron::stereo
