// Asking for what will be read, ahead of the threads that read it.
#pragma once

#include <cstdint>
#include <functional>
#include <mutex>
#include <vector>

namespace isochron::index {

/// Keeps many requests at a disk while parts are worked on in ascending order. Thread-safe.
class ReadAhead {
  public:
    /// Asks for what a part needs. @return bytes; called once for each part, in order
    using Ask = std::function<std::uint64_t(std::uint32_t part)>;

    ReadAhead(std::uint32_t parts, Ask ask);

    /// Called when work on a part begins: asks for this one and those behind it.
    /// @throws what asking throws
    void reach(std::uint32_t part);

  private:
    const Ask ask_;
    std::mutex mutex_;                 ///< of those below
    std::vector<std::uint64_t> asked_; ///< bytes, by part
    std::uint32_t next_ = 0;           ///< the first part that has not been asked for
    std::uint32_t reached_ = 0;        ///< work on those before has begun
    std::uint64_t ahead_ = 0;          ///< bytes asked for of the others
};

} // namespace isochron::index
