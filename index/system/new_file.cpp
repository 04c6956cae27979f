// A file that appears under its name only when it is complete.
#include "index/system/new_file.h"

#include "index/error.h"

#include <fmt/format.h>

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <string>

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

/// So that a new name survives a loss of power; not every file system needs or allows that.
void flush_folder_of(const fs::path& file) {
    const Descriptor folder(::open(folder_of(file).c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
    if (folder)
        ::fsync(folder.number());
}

} // namespace

void make_folder(const fs::path& folder) {
    std::error_code error;
    fs::create_directories(folder, error);
    if (error)
        throw Error("{}: cannot be made: {}", folder.string(), refusal(error.value()));
}

fs::path end_of_links(fs::path path) {
    constexpr int kMost = 40; // as the kernel has it
    std::error_code error;
    const fs::path given = path;
    for (int links = 0; fs::is_symlink(path, error); ++links) {
        const fs::path to = fs::read_symlink(path, error);
        if (error || links == kMost)
            throw Error("{}: cannot be written: its symbolic links lead nowhere", given.string());
        path = to.is_absolute() ? to : path.parent_path() / to;
    }
    return path;
}

NewFile::NewFile(fs::path target, Writers writers) : target_(std::move(target)) {
    std::error_code ignored;
    const fs::file_status status = fs::status(target_, ignored);
    if (!target_.has_filename() || (fs::exists(status) && !fs::is_regular_file(status)))
        throw Error("{}: cannot be written: not a regular file", target_.string());
    target_ = end_of_links(target_);
    const fs::path folder = folder_of(target_);
    if (!fs::is_directory(folder, ignored))
        throw Error("{}: cannot be written: there is no folder {}", target_.string(),
                    folder.string());
    remove_remains_in(folder);
    temporary_ = temporary_name_of(target_);
    open_unnamed(folder);
    if (!file_)
        create_named();
    else if (writers == Writers::several)
        take_temporary_name();
}

void NewFile::open_unnamed(const fs::path& folder) {
    file_ = Descriptor(::open(folder.c_str(), O_RDWR | O_TMPFILE | O_CLOEXEC, 0666));
    std::error_code ignored;
    // Not every file system knows such files, nor can a name be given where there is no /proc.
    if (file_ && !fs::exists(path_of_open(file_.number()), ignored))
        file_.reset();
}

/// Has a name that is new used for the temporary file. @param use returns whether it could be
template <class Use>
void NewFile::with_new_name(const Use& use) {
    constexpr int kMostTries = 1000; // a folder that holds as many of 2^32 names is no accident
    for (int tries = 0; !use(); ++tries) {
        if (errno != EEXIST || tries == kMostTries)
            fail(errno);
        temporary_ = temporary_name_of(target_);
    }
    named_ = true;
}

/// Where no file is without a name: killed before its entry stands, this process leaves an empty one.
void NewFile::create_named() {
    with_new_name([&] {
        file_ = Descriptor(::open(temporary_.c_str(), O_RDWR | O_CREAT | O_EXCL | O_CLOEXEC, 0666));
        return static_cast<bool>(file_);
    });
    ::flock(file_.number(), LOCK_EX | LOCK_NB); // shows others that its writer is alive
    entry_ = LedgerEntry(temporary_, file_.number());
}

void NewFile::take_temporary_name() {
    ::flock(file_.number(), LOCK_EX | LOCK_NB);
    with_new_name([&] {
        entry_ = LedgerEntry(temporary_, file_.number()); // before it can be left behind
        return link_to(temporary_);
    });
}

bool NewFile::link_to(const fs::path& name) const {
    return ::linkat(AT_FDCWD, path_of_open(file_.number()).c_str(), AT_FDCWD, name.c_str(),
                    AT_SYMLINK_FOLLOW) == 0;
}

fs::path NewFile::path_to_open() const {
    return named_ ? temporary_ : fs::path(path_of_open(file_.number()));
}

NewFile::NewFile(fs::path target, fs::path temporary)
    : target_(std::move(target)), temporary_(std::move(temporary)), owner_(false), named_(true) {
    file_ = Descriptor(::open(temporary_.c_str(), O_WRONLY | O_CLOEXEC));
    if (!file_)
        fail(errno);
}

NewFile::~NewFile() {
    if (file_ && owner_ && named_)
        remove_temporary(temporary_.c_str(), file_.number());
}

void NewFile::fail(int error) const {
    throw Error("{}: cannot be written: {}", target_.string(), refusal(error));
}

void NewFile::reserve(std::uint64_t bytes) {
    if (::fallocate(file_.number(), 0, 0, static_cast<off_t>(bytes)) == 0)
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
    if (const int error = write_all(file_.number(), offset, bytes))
        fail(error);
}

void begin_flush_of(int file) {
    ::sync_file_range(file, 0, 0, SYNC_FILE_RANGE_WRITE); // if it fails, nothing is lost
}

void NewFile::begin_flush() {
    begin_flush_of(file_.number());
}

void NewFile::take_name() {
    if (!named_) {
        if (link_to(target_))
            return;
        if (errno != EEXIST)
            fail(errno);
        take_temporary_name(); // to replace the file that has the name
    }
    if (::rename(temporary_.c_str(), target_.c_str()) != 0)
        fail(errno);
    entry_ = LedgerEntry();
}

void NewFile::commit() {
    if (::fsync(file_.number()) != 0)
        fail(errno);
    if (!owner_)
        return;
    take_name();
    file_.reset();
    flush_folder_of(target_);
}

void name_whole_file(const fs::path& written, const fs::path& target) {
    const fs::path name = end_of_links(target);
    const Descriptor file(::open(written.c_str(), O_RDWR | O_CLOEXEC));
    if (!file || ::fsync(file.number()) != 0 || ::rename(written.c_str(), name.c_str()) != 0)
        throw Error("{}: cannot be written: {}", target.string(), refusal(errno));
    flush_folder_of(name);
}

void write_file(const std::filesystem::path& target, std::span<const std::byte> bytes) {
    NewFile file(target);
    file.write_at(0, bytes);
    file.commit();
}

} // namespace isochron::index
