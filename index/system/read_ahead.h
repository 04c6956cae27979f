// Asking for what will be read, ahead of the threads that read it.
#pragma once

#include <condition_variable>
#include <cstdint>
#include <functional>
#include <mutex>
#include <thread>
#include <vector>

namespace isochron::index {

/// Keeps many requests at a disk while parts are worked on in ascending order. Thread-safe.
class ReadAhead {
  public:
    /// Asks for what a part needs. @return bytes. Called for one part after the other, on a thread
    /// of its own, since a disk that is busy holds up who asks; when it throws, nothing more is
    /// asked for, and whoever reads will find out why.
    using Ask = std::function<std::uint64_t(std::uint32_t part)>;

    ReadAhead(std::uint32_t parts, Ask ask);
    ~ReadAhead();
    ReadAhead(const ReadAhead&) = delete;
    ReadAhead& operator=(const ReadAhead&) = delete;

    /// Says that work on a part begins. Never waits.
    void reach(std::uint32_t part);

  private:
    void run(const std::stop_token& stop);

    const Ask ask_;
    std::mutex mutex_; ///< of those below
    std::condition_variable_any reached_more_;
    std::vector<std::uint64_t> asked_; ///< bytes, by part
    std::uint32_t next_ = 0;           ///< the first part that has not been asked for
    std::uint32_t reached_ = 0;        ///< work on those before it has begun
    std::uint64_t ahead_ = 0;          ///< bytes asked for of the others
    std::jthread asking_;              ///< last: starts after and ends before all that it uses
};

} // namespace isochron::index
