// Memory that two processes see.
#pragma once

#include "index/system/descriptor.h"

#include <cstddef>
#include <span>

namespace isochron::index {

/// Has no name, and goes when the last process that maps it does. Its size stays: whoever else has
/// it can change what is in it at any time, but can not make it shorter.
class SharedMemory {
  public:
    /// New memory. @throws Error when there is not so much
    explicit SharedMemory(std::size_t bytes);
    /// That of another process. @throws Error when it is shorter, or none
    SharedMemory(Descriptor theirs, std::size_t bytes);
    ~SharedMemory();
    SharedMemory(const SharedMemory&) = delete;
    SharedMemory& operator=(const SharedMemory&) = delete;

    std::span<std::byte> bytes() const { return bytes_; }
    int descriptor() const { return descriptor_.number(); }

  private:
    void map(std::size_t bytes);

    Descriptor descriptor_;
    std::span<std::byte> bytes_;
};

} // namespace isochron::index
