// A file that appears under its name only when it is complete.
#include "index/system/new_file.h"

#include "index/error.h"

#include <fmt/format.h>

#include <dirent.h>
#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <ctime>
#include <memory>
#include <random>
#include <string_view>

namespace isochron::index {
namespace fs = std::filesystem;

namespace {

fs::path folder_of(const fs::path& file) {
    return file.has_parent_path() ? file.parent_path() : fs::path(".");
}

/// The system's message. If a folder exists but accepts no new files, as below /proc, the system
/// says that something is missing, so that case gets another message.
std::string refusal(int error) {
    return error == ENOENT ? "its folder takes nothing new" : std::strerror(error);
}

} // namespace

void make_folder(const fs::path& folder) {
    std::error_code error;
    fs::create_directories(folder, error);
    if (error)
        throw Error(fmt::format("{}: cannot be made: {}", folder.string(), refusal(error.value())));
}

fs::path end_of_links(fs::path path) {
    constexpr int kMost = 40; // as the kernel has it
    std::error_code error;
    const fs::path given = path;
    for (int links = 0; fs::is_symlink(path, error); ++links) {
        const fs::path to = fs::read_symlink(path, error);
        if (error || links == kMost)
            throw Error(fmt::format("{}: cannot be written: its symbolic links lead nowhere",
                                    given.string()));
        path = to.is_absolute() ? to : path.parent_path() / to;
    }
    return path;
}

NewFile::NewFile(fs::path target) : target_(std::move(target)) {
    std::error_code ignored;
    const fs::file_status status = fs::status(target_, ignored);
    if (!target_.has_filename() || (fs::exists(status) && !fs::is_regular_file(status)))
        throw Error(fmt::format("{}: cannot be written: not a regular file", target_.string()));
    target_ = end_of_links(target_);
    const fs::path folder = folder_of(target_);
    if (!fs::is_directory(folder, ignored))
        throw Error(fmt::format("{}: cannot be written: there is no folder {}", target_.string(),
                                folder.string()));
    std::random_device random;
    constexpr int kMostTries =
        1000; // of 65,536 names: a folder that holds most of them is no accident
    for (int tries = 0; file_ < 0; ++tries) {
        temporary_ =
            folder / fmt::format(".{}.{:04x}.tmp", target_.filename().string(), random() & 0xffff);
        file_ = ::open(temporary_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
        if (file_ < 0 && (errno != EEXIST || tries == kMostTries))
            fail(errno);
    }
    ::flock(file_, LOCK_EX | LOCK_NB); // shows others that its writer is alive
}

NewFile::NewFile(fs::path target, fs::path temporary)
    : target_(std::move(target)), temporary_(std::move(temporary)), owner_(false) {
    file_ = ::open(temporary_.c_str(), O_WRONLY | O_CLOEXEC);
    if (file_ < 0)
        fail(errno);
}

NewFile::~NewFile() {
    if (file_ < 0)
        return;
    ::close(file_);
    if (owner_)
        ::unlink(temporary_.c_str());
}

void NewFile::remove_remains() const {
    const std::string start = fmt::format(".{}.", target_.filename().string());
    const fs::path folder = folder_of(target_);
    // Not std::filesystem's iterator, which ends the program when memory runs out.
    const std::unique_ptr<DIR, int (*)(DIR*)> entries(::opendir(folder.c_str()), ::closedir);
    while (const dirent* entry = entries ? ::readdir(entries.get()) : nullptr) {
        const std::string_view name = entry->d_name;
        if (name.size() != start.size() + 8 || !name.starts_with(start) ||
            !name.ends_with(".tmp") || name == temporary_.filename().string())
            continue;
        // Anything may have such a name, even a pipe or a link.
        const fs::path path = folder / name;
        const int file = ::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK | O_NOFOLLOW);
        if (file < 0)
            continue;
        // A file that was just made may not be locked yet.
        struct stat status {};
        const bool old = ::fstat(file, &status) == 0 && S_ISREG(status.st_mode) &&
                         status.st_mtime + 60 < std::time(nullptr);
        if (old && ::flock(file, LOCK_EX | LOCK_NB) == 0)
            ::unlink(path.c_str());
        ::close(file);
    }
}

void NewFile::fail(int error) const {
    throw Error(fmt::format("{}: cannot be written: {}", target_.string(), refusal(error)));
}

void NewFile::reserve(std::uint64_t bytes) {
    if (::fallocate(file_, 0, 0, static_cast<off_t>(bytes)) == 0)
        return;
    if (errno != EOPNOTSUPP && errno != ENOSYS) // not every file system can reserve
        fail(errno);
}

int write_all(int file, std::uint64_t offset, std::span<const std::byte> bytes) {
    while (!bytes.empty()) {
        const ssize_t written =
            ::pwrite(file, bytes.data(), bytes.size(), static_cast<off_t>(offset));
        if (written < 0 && errno == EINTR)
            continue;
        if (written <= 0)
            return written < 0 ? errno : ENOSPC;
        offset += static_cast<std::uint64_t>(written);
        bytes = bytes.subspan(static_cast<std::size_t>(written));
    }
    return 0;
}

void NewFile::write_at(std::uint64_t offset, std::span<const std::byte> bytes) {
    if (const int error = write_all(file_, offset, bytes))
        fail(error);
}

void begin_flush_of(int file) {
    ::sync_file_range(file, 0, 0, SYNC_FILE_RANGE_WRITE); // if it fails, nothing is lost
}

void NewFile::begin_flush() {
    begin_flush_of(file_);
}

void NewFile::commit() {
    if (::fsync(file_) != 0)
        fail(errno);
    if (!owner_)
        return;
    if (::rename(temporary_.c_str(), target_.c_str()) != 0)
        fail(errno);
    ::close(file_);
    file_ = -1;
    // Flushes the folder, so that the new name survives a power failure; not every file system
    // needs or allows that.
    const int folder = ::open(folder_of(target_).c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    if (folder >= 0) {
        ::fsync(folder);
        ::close(folder);
    }
}

} // namespace isochron::index
