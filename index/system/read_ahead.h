// Announces reads to the disk ahead of the threads that read.
#pragma once

#include <condition_variable>
#include <cstdint>
#include <functional>
#include <mutex>
#include <thread>
#include <vector>

namespace isochron::index {

/// Keeps many requests in the disk's queue while parts are worked on in ascending order.
/// Thread-safe.
class ReadAhead {
  public:
    /// Announces the reads that a part needs. @return their bytes. It is called for one part after
    /// the other on a separate thread, since a busy disk blocks such calls. If it throws, nothing
    /// more is announced, and the threads that read get the error themselves.
    using Ask = std::function<std::uint64_t(std::uint32_t part)>;

    ReadAhead(std::uint32_t parts, Ask ask);
    ~ReadAhead();
    ReadAhead(const ReadAhead&) = delete;
    ReadAhead& operator=(const ReadAhead&) = delete;

    /// Notes that work on a part begins. Never waits.
    void reach(std::uint32_t part);

  private:
    void run(const std::stop_token& stop);

    const Ask ask_;
    std::mutex mutex_; ///< for the members below
    std::condition_variable_any reached_more_;
    std::vector<std::uint64_t> asked_; ///< bytes, by part
    std::uint32_t next_ = 0;           ///< the first part that has not been announced
    std::uint32_t reached_ = 0;        ///< work on the parts before it has begun
    std::uint64_t ahead_ = 0;          ///< announced bytes of parts from `reached_` on
    std::jthread asking_;              ///< last: starts after and ends before all that it uses
};

} // namespace isochron::index
