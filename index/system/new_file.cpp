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
#include <functional>
#include <memory>
#include <mutex>
#include <random>
#include <set>
#include <string>
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

/// Where this process can open a file that it has open.
std::string path_of_open(int file) {
    return fmt::format("/proc/self/fd/{}", file);
}

/// Whether nobody writes a file or a folder, which no longer grows. One that was just made may not
/// be locked yet.
bool is_abandoned(int file) {
    struct stat status{};
    constexpr time_t kOld = 60; // [s]
    return ::fstat(file, &status) == 0 && (S_ISREG(status.st_mode) || S_ISDIR(status.st_mode)) &&
           status.st_uid == ::geteuid() && status.st_mtime + kOld < std::time(nullptr) &&
           ::flock(file, LOCK_EX | LOCK_NB) == 0;
}

/// Removes files and folders with such a name that nobody writes.
void remove_abandoned(const fs::path& folder,
                      const std::function<bool(std::string_view)>& is_of_us) {
    // Not std::filesystem's iterator, which ends the program when memory runs out.
    const std::unique_ptr<DIR, int (*)(DIR*)> entries(::opendir(folder.c_str()), ::closedir);
    while (const dirent* entry = entries ? ::readdir(entries.get()) : nullptr) {
        if (entry->d_name[0] != '.' || !is_of_us(entry->d_name))
            continue;
        // Anything may have such a name, even a pipe or a link.
        const fs::path path = folder / entry->d_name;
        const int file = ::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK | O_NOFOLLOW);
        if (file < 0)
            continue;
        std::error_code ignored;
        if (is_abandoned(file))
            fs::remove_all(path, ignored);
        ::close(file);
    }
}

constexpr std::string_view kMark = ".isochron-", kTemporary = ".tmp";

} // namespace

fs::path temporary_name_of(const fs::path& file) {
    constexpr std::size_t kLongest = 200; // of 255 bytes that a name may have
    static std::random_device random;
    return folder_of(file) / fmt::format(".{}{}{:08x}{}",
                                         file.filename().string().substr(0, kLongest), kMark,
                                         random(), kTemporary);
}

void remove_remains_in(const fs::path& folder) {
    static std::mutex mutex;
    static std::set<std::string> done; // as they were named, and as they are at the end of links
    {
        std::error_code ignored;
        const fs::path named = fs::absolute(folder, ignored);
        const std::lock_guard lock(mutex);
        if (!done.insert(named.native()).second)
            return;
        const fs::path whole = fs::weakly_canonical(named, ignored);
        if (whole != named && !done.insert(whole.native()).second)
            return;
    }
    remove_abandoned(folder, [](std::string_view name) {
        return name.ends_with(kTemporary) && name.rfind(kMark) != name.npos;
    });
}

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

NewFile::NewFile(fs::path target, Writers writers) : target_(std::move(target)) {
    std::error_code ignored;
    const fs::file_status status = fs::status(target_, ignored);
    if (!target_.has_filename() || (fs::exists(status) && !fs::is_regular_file(status)))
        throw Error(fmt::format("{}: cannot be written: not a regular file", target_.string()));
    target_ = end_of_links(target_);
    const fs::path folder = folder_of(target_);
    if (!fs::is_directory(folder, ignored))
        throw Error(fmt::format("{}: cannot be written: there is no folder {}", target_.string(),
                                folder.string()));
    remove_remains_in(folder);
    temporary_ = temporary_name_of(target_);
    if (writers == Writers::one && !fs::exists(status))
        open_unnamed(folder);
    if (file_ < 0)
        open_named();
}

void NewFile::open_unnamed(const fs::path& folder) {
    file_ = ::open(folder.c_str(), O_RDWR | O_TMPFILE | O_CLOEXEC, 0666);
    std::error_code ignored;
    // Not every file system knows such files, nor can a name be given where there is no /proc.
    if (file_ >= 0 && !fs::exists(path_of_open(file_), ignored)) {
        ::close(file_);
        file_ = -1;
    }
    named_ = file_ < 0;
}

void NewFile::open_named() {
    constexpr int kMostTries = 1000; // a folder that holds as many of 2^32 names is no accident
    for (int tries = 0; file_ < 0; ++tries) {
        file_ = ::open(temporary_.c_str(), O_RDWR | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
        if (file_ < 0 && (errno != EEXIST || tries == kMostTries))
            fail(errno);
        if (file_ < 0)
            temporary_ = temporary_name_of(target_);
    }
    ::flock(file_, LOCK_EX | LOCK_NB); // shows others that its writer is alive
}

fs::path NewFile::path_to_open() const {
    return named_ ? temporary_ : fs::path(path_of_open(file_));
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
    if (owner_ && named_)
        ::unlink(temporary_.c_str());
}

void NewFile::remove_remains() const {
    const std::string start = fmt::format(".{}.", target_.filename().string());
    const auto is_old_name = [&](std::string_view name) { // of versions up to 0.2
        return name.size() == start.size() + 8 && name.starts_with(start) && name.ends_with(".tmp");
    };
    remove_abandoned(folder_of(target_), is_old_name);
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

void NewFile::take_name() {
    const auto link_to = [&](const fs::path& name) {
        return ::linkat(AT_FDCWD, path_of_open(file_).c_str(), AT_FDCWD, name.c_str(),
                        AT_SYMLINK_FOLLOW) == 0;
    };
    if (!named_) {
        if (link_to(target_))
            return;
        if (errno != EEXIST || !link_to(temporary_))
            fail(errno);
        named_ = true; // another file has taken the name meanwhile
    }
    if (::rename(temporary_.c_str(), target_.c_str()) != 0)
        fail(errno);
}

void NewFile::commit_unflushed() {
    take_name();
    ::close(file_);
    file_ = -1;
}

void NewFile::commit() {
    if (::fsync(file_) != 0)
        fail(errno);
    if (!owner_)
        return;
    commit_unflushed();
    // Flushes the folder, so that the new name survives a power failure; not every file system
    // needs or allows that.
    const int folder = ::open(folder_of(target_).c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    if (folder >= 0) {
        ::fsync(folder);
        ::close(folder);
    }
}

} // namespace isochron::index
