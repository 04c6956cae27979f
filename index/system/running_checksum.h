// XXH3 of bytes that arrive piece by piece.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

struct XXH3_state_s;

namespace isochron::index {

class RunningChecksum {
  public:
    RunningChecksum();
    ~RunningChecksum();
    RunningChecksum(const RunningChecksum&) = delete;
    RunningChecksum& operator=(const RunningChecksum&) = delete;

    void add(std::span<const std::byte> bytes);
    /// XXH3, 64 bits, of all bytes that were added since the last call.
    std::uint64_t take();

  private:
    XXH3_state_s* state_;
};

} // namespace isochron::index
