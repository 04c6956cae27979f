// Memory that two processes share.
#pragma once

#include "index/system/descriptor.h"

#include <cstddef>
#include <span>

namespace isochron::index {

/// It has no name, and is freed when the last process that maps it ends. The other process can
/// change its contents at any time, but cannot change its size.
class SharedMemory {
  public:
    /// Allocates new memory. @throws Error when there is not enough
    explicit SharedMemory(std::size_t bytes);
    /// Maps the memory of another process. @throws Error when it is shorter than `bytes`, or is not
    /// shared memory of fixed size
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
