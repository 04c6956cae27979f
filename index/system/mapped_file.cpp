// A file mapped read-only into memory.
#include "index/system/mapped_file.h"

#include "index/error.h"

#include <fmt/format.h>

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cassert>
#include <cerrno>
#include <cstdint>
#include <cstring>

namespace isochron::index {
namespace {

/// Whole pages; nothing depends on whether the system follows the advice.
void advise(std::span<const std::byte> part, int advice) {
    const auto page = static_cast<std::uintptr_t>(::sysconf(_SC_PAGESIZE));
    const auto begin = reinterpret_cast<std::uintptr_t>(part.data()) / page * page;
    const auto end = reinterpret_cast<std::uintptr_t>(part.data() + part.size());
    ::madvise(reinterpret_cast<void*>(begin), end - begin, advice);
}

} // namespace

MappedFile::MappedFile(const std::filesystem::path& path) {
    // Non-blocking, so that a pipe without a writer is refused below instead of waited for.
    const int file = ::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK);
    if (file < 0)
        throw Error(fmt::format("{}: cannot be opened: {}", path.string(), std::strerror(errno)));
    struct stat status {};
    void* address = nullptr;
    int error = 0;
    bool regular = false;
    if (::fstat(file, &status) != 0) {
        error = errno;
    } else {
        regular = S_ISREG(status.st_mode);
        if (regular && status.st_size > 0) {
            address = ::mmap(nullptr, static_cast<std::size_t>(status.st_size), PROT_READ,
                             MAP_SHARED, file, 0);
            if (address == MAP_FAILED)
                error = errno;
        }
    }
    ::close(file);
    if (error)
        throw Error(fmt::format("{}: cannot be mapped: {}", path.string(), std::strerror(error)));
    if (!regular)
        throw Error(fmt::format("{}: not a regular file", path.string()));
    bytes_ = {static_cast<const std::byte*>(address), static_cast<std::size_t>(status.st_size)};
}

MappedFile::~MappedFile() {
    if (!bytes_.empty())
        ::munmap(const_cast<std::byte*>(bytes_.data()), bytes_.size());
}

void MappedFile::expect_scattered_reads(std::span<const std::byte> part) const {
    advise(part, MADV_RANDOM); // without it reads are larger
}

void MappedFile::let_go(std::span<const std::byte> part) const {
    assert(part.data() >= bytes_.data() &&
           part.data() + part.size() <= bytes_.data() + bytes_.size());
    advise(part, MADV_DONTNEED); // of a shared mapping: the file and its cache stay as they are
}

} // namespace isochron::index
