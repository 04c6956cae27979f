// A file mapped read-only into memory.
#include "index/system/mapped_file.h"

#include "index/error.h"
#include "index/system/input_file.h"

#include <sys/mman.h>

#include <cerrno>
#include <cstring>

namespace isochron::index {

MappedFile::MappedFile(const std::filesystem::path& path) {
    const InputFile file(path);
    const std::size_t size = file.size();
    void* address = nullptr;
    if (size > 0) {
        address = ::mmap(nullptr, size, PROT_READ, MAP_SHARED, file.descriptor(), 0);
        if (address == MAP_FAILED)
            throw Error("{}: cannot be mapped: {}", path.string(), std::strerror(errno));
    }
    bytes_ = {static_cast<const std::byte*>(address), size};
}

MappedFile::~MappedFile() {
    if (!bytes_.empty())
        ::munmap(const_cast<std::byte*>(bytes_.data()), bytes_.size());
}

} // namespace isochron::index
