// Opens regular files.
#include "index/system/input_file.h"

#include "index/missing_file.h"

#include <fmt/format.h>

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <tuple>
#include <utility>

namespace isochron::index {
namespace {

[[noreturn]] void refuse(const std::filesystem::path& path, int error) {
    const std::string name = path.string();
    if (error == ENOENT)
        throw MissingFile(fmt::format("{}: there is no such file", name));
    if (error == ENXIO) // a socket, or a device that does not exist
        throw Error(fmt::format("{}: not a regular file", name));
    throw Error(fmt::format("{}: cannot be opened: {}", name, std::strerror(error)));
}

void expect_regular(const std::filesystem::path& path, const struct stat& status) {
    if (S_ISDIR(status.st_mode))
        throw Error(fmt::format("{}: a folder, expected a file", path.string()));
    if (!S_ISREG(status.st_mode))
        throw Error(fmt::format("{}: not a regular file", path.string()));
}

/// Opens a regular file. @return its descriptor and size
std::pair<int, std::uint64_t> opened(const std::filesystem::path& path) {
    const int file = ::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK | O_NOCTTY);
    if (file < 0)
        refuse(path, errno);
    try {
        struct stat status{};
        if (::fstat(file, &status) != 0)
            refuse(path, errno);
        expect_regular(path, status);
        return {file, static_cast<std::uint64_t>(status.st_size)};
    } catch (...) {
        ::close(file);
        throw;
    }
}

} // namespace

FileState state_of(const std::filesystem::path& path) {
    struct stat status{};
    if (::stat(path.c_str(), &status) != 0)
        refuse(path, errno);
    expect_regular(path, status);
    return {.device = status.st_dev,
            .inode = status.st_ino,
            .size = static_cast<std::uint64_t>(status.st_size),
            .written =
                std::int64_t{status.st_mtim.tv_sec} * 1'000'000'000 + status.st_mtim.tv_nsec};
}

int open_regular(const std::filesystem::path& path) {
    return opened(path).first;
}

InputFile::InputFile(std::filesystem::path path) : path_(std::move(path)) {
    std::tie(file_, size_) = opened(path_);
}

InputFile::~InputFile() {
    ::close(file_);
}

std::size_t InputFile::read(std::uint64_t offset, std::span<std::byte> out) const {
    std::size_t done = 0;
    while (done < out.size()) {
        const ssize_t got =
            ::pread(file_, out.data() + done, out.size() - done, static_cast<off_t>(offset + done));
        if (got < 0 && errno == EINTR)
            continue;
        if (got < 0)
            throw Error(
                fmt::format("{}: cannot be read: {}", path_.string(), std::strerror(errno)));
        if (got == 0)
            break;
        done += static_cast<std::size_t>(got);
    }
    return done;
}

std::unique_ptr<InputFile> InputFile::opened_again() const {
    const int again = ::open(fmt::format("/proc/self/fd/{}", file_).c_str(), O_RDONLY | O_CLOEXEC);
    return again < 0 ? nullptr : std::unique_ptr<InputFile>(new InputFile(path_, again, size_));
}

InputStream::InputStream(const std::filesystem::path& path)
    : std::istream(nullptr), buffer_(open_regular(path), std::ios::in | std::ios::binary) {
    rdbuf(&buffer_);
}

std::string read_text(const std::filesystem::path& path, std::uint64_t most) {
    const InputFile file(path);
    if (file.size() > most)
        throw Error(
            fmt::format("{}: {} bytes, expected at most {}", path.string(), file.size(), most));
    std::string text(file.size(), '\0');
    text.resize(file.read(0, std::as_writable_bytes(std::span(text))));
    return text;
}

} // namespace isochron::index
