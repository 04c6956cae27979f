// A file mapped read-only into memory.
#include "index/system/mapped_file.h"

#include "index/error.h"
#include "index/system/input_file.h"

#include <fmt/format.h>

#include <sys/mman.h>
#include <unistd.h>

#include <cassert>
#include <cerrno>
#include <cstdint>
#include <cstring>

namespace isochron::index {
namespace {

/// Advises the system on whole pages; it may ignore the advice.
void advise(std::span<const std::byte> part, int advice) {
    const auto page = static_cast<std::uintptr_t>(::sysconf(_SC_PAGESIZE));
    const auto begin = reinterpret_cast<std::uintptr_t>(part.data()) / page * page;
    const auto end = reinterpret_cast<std::uintptr_t>(part.data() + part.size());
    ::madvise(reinterpret_cast<void*>(begin), end - begin, advice);
}

} // namespace

MappedFile::MappedFile(const std::filesystem::path& path) {
    const InputFile file(path);
    const std::size_t size = file.size();
    void* address = nullptr;
    if (size > 0) {
        address = ::mmap(nullptr, size, PROT_READ, MAP_SHARED, file.descriptor(), 0);
        if (address == MAP_FAILED)
            throw Error(
                fmt::format("{}: cannot be mapped: {}", path.string(), std::strerror(errno)));
    }
    bytes_ = {static_cast<const std::byte*>(address), size};
}

MappedFile::~MappedFile() {
    if (!bytes_.empty())
        ::munmap(const_cast<std::byte*>(bytes_.data()), bytes_.size());
}

void MappedFile::let_go(std::span<const std::byte> part) const {
    assert(part.data() >= bytes_.data() &&
           part.data() + part.size() <= bytes_.data() + bytes_.size());
    advise(part, MADV_DONTNEED); // the mapping is shared, so file and page cache stay
}

} // namespace isochron::index
