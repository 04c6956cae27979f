// Memory that two processes share.
#include "index/system/shared_memory.h"

#include "index/error.h"

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/stat.h>

#include <cerrno>
#include <cstring>

namespace isochron::index {

SharedMemory::SharedMemory(std::size_t bytes)
    : descriptor_(::memfd_create("isochron", MFD_CLOEXEC | MFD_ALLOW_SEALING)) {
    constexpr int kSeals = F_SEAL_SHRINK | F_SEAL_GROW | F_SEAL_SEAL;
    if (!descriptor_ || ::ftruncate(descriptor_.number(), static_cast<off_t>(bytes)) != 0 ||
        ::fcntl(descriptor_.number(), F_ADD_SEALS, kSeals) != 0)
        throw Error("{} bytes of shared memory: {}", bytes, std::strerror(errno));
    map(bytes);
}

SharedMemory::SharedMemory(Descriptor theirs, std::size_t bytes) : descriptor_(std::move(theirs)) {
    struct stat status{};
    if (::fstat(descriptor_.number(), &status) != 0 ||
        static_cast<std::size_t>(status.st_size) < bytes)
        throw Error("shared memory of {} bytes, expected {}", status.st_size, bytes);
    map(bytes);
}

SharedMemory::~SharedMemory() {
    ::munmap(bytes_.data(), bytes_.size());
}

void SharedMemory::map(std::size_t bytes) {
    void* address =
        ::mmap(nullptr, bytes, PROT_READ | PROT_WRITE, MAP_SHARED, descriptor_.number(), 0);
    if (address == MAP_FAILED)
        throw Error("{} bytes of shared memory: {}", bytes, std::strerror(errno));
    bytes_ = {static_cast<std::byte*>(address), bytes};
}

} // namespace isochron::index
