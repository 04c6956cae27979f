// Writes after the end of a file that others read.
#include "index/system/growing_file.h"

#include "index/error.h"
#include "index/system/new_file.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

namespace isochron::index {

GrowingFile::GrowingFile(std::filesystem::path path, bool alone) : path_(std::move(path)) {
    file_ = ::open(path_.c_str(), O_RDWR | O_CLOEXEC | O_NONBLOCK | O_NOCTTY);
    if (file_ < 0)
        fail(errno);
    struct stat status{};
    const char* refused = nullptr;
    if (::fstat(file_, &status) != 0 || !S_ISREG(status.st_mode))
        refused = "not a regular file";
    else if (alone && ::flock(file_, LOCK_EX | LOCK_NB) != 0)
        refused = "another process appends to it";
    if (!refused)
        return;
    ::close(file_);
    throw Error("{}: cannot be written: {}", path_.string(), refused);
}

GrowingFile::~GrowingFile() {
    ::close(file_);
}

void GrowingFile::fail(int error) const {
    throw Error("{}: cannot be written: {}", path_.string(), std::strerror(error));
}

void GrowingFile::write_at(std::uint64_t offset, std::span<const std::byte> bytes) {
    if (const int error = write_all(file_, offset, bytes))
        fail(error);
}

void GrowingFile::begin_flush() {
    begin_flush_of(file_);
}

void GrowingFile::flush() {
    if (::fsync(file_) != 0)
        fail(errno);
}

void GrowingFile::cut(std::uint64_t bytes) {
    struct stat status{};
    if (::fstat(file_, &status) != 0)
        fail(errno);
    if (static_cast<std::uint64_t>(status.st_size) > bytes &&
        ::ftruncate(file_, static_cast<off_t>(bytes)) != 0)
        fail(errno);
}

} // namespace isochron::index
