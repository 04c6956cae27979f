// A temporary file without a name.
#include "index/system/scratch_file.h"

#include "index/error.h"
#include "index/system/new_file.h"

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <string>

namespace isochron::index {

ScratchFile::ScratchFile(std::filesystem::path beside) : beside_(std::move(beside)) {
    const std::filesystem::path folder =
        beside_.has_parent_path() ? beside_.parent_path() : std::filesystem::path(".");
    file_ = ::open(folder.c_str(), O_RDWR | O_TMPFILE | O_CLOEXEC, 0600);
    if (file_ < 0 && (errno == EOPNOTSUPP || errno == EISDIR)) { // not every file system can
        std::string name = (folder / ".isochron.XXXXXX").string();
        file_ = ::mkostemp(name.data(), O_CLOEXEC);
        if (file_ >= 0)
            ::unlink(name.c_str());
    }
    if (file_ < 0)
        fail(errno);
}

ScratchFile::~ScratchFile() {
    ::close(file_);
}

void ScratchFile::fail(int error) const {
    throw Error("{}: cannot be written: {}", beside_.string(), std::strerror(error));
}

void ScratchFile::write_at(std::uint64_t offset, std::span<const std::byte> bytes) {
    if (const int error = write_all(file_, offset, bytes))
        fail(error);
}

void ScratchFile::read(std::uint64_t offset, std::span<std::byte> out) const {
    while (!out.empty()) {
        const ssize_t got = ::pread(file_, out.data(), out.size(), static_cast<off_t>(offset));
        if (got < 0 && errno == EINTR)
            continue;
        if (got < 0)
            fail(errno);
        if (got == 0) {
            std::ranges::fill(out, std::byte{0});
            return;
        }
        offset += static_cast<std::uint64_t>(got);
        out = out.subspan(static_cast<std::size_t>(got));
    }
}

} // namespace isochron::index
