// A library to be preloaded (LD_PRELOAD) that makes the n-th call of a kind fail: a full disk, a disk that fails, an
// interrupted or short transfer, no memory. Only files below the program's working directory at its start count, so that
// libraries, the driver's cache of shaders and the system's own files stay as they are.
//
//     ISOCHRON_FAULT=write:3:ENOSPC    from the third write on the disk is full
//     ISOCHRON_FAULT=read:2:SIGINT     the second read never ends, and meanwhile the signal comes; or SIGTERM
//     ISOCHRON_FAULT_MARK=FILE         appears once the fault has been met
//     ISOCHRON_CALL_LOG=FILE           gets a line for each call on a file that is written: open, write, size, sync (with
//                                      the file's number), rename
//     ISOCHRON_KILL_AT=7               kills the program at the seventh line of the log
//
// Kinds: open, read, write, sync, rename, size, new. Faults: ENOSPC and EIO (from then on), EINTR and short (once).
#include <dlfcn.h>
#include <fcntl.h>
#include <sys/syscall.h>
#include <sys/types.h>
#include <sys/uio.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <cerrno>
#include <csignal>
#include <cstdarg>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <new>
#include <string>

namespace {

enum class How { none, no_space, failed, interrupted, part, hangs };

struct Plan {
    std::array<char, 8> kind{};
    long at = 0;
    How how = How::none;
    int signal = 0; ///< that comes while a call hangs

    Plan() {
        const char* text = std::getenv("ISOCHRON_FAULT");
        std::array<char, 8> name{};
        if (!text || std::sscanf(text, "%7[a-z]:%ld:%7s", kind.data(), &at, name.data()) != 3)
            return;
        signal = !std::strcmp(name.data(), "SIGINT")    ? SIGINT
                 : !std::strcmp(name.data(), "SIGTERM") ? SIGTERM
                                                        : 0;
        how = !std::strcmp(name.data(), "ENOSPC")  ? How::no_space
              : !std::strcmp(name.data(), "EIO")   ? How::failed
              : !std::strcmp(name.data(), "EINTR") ? How::interrupted
              : signal != 0                        ? How::hangs
                                                   : How::part;
    }
};

const Plan& plan() {
    static const Plan the_plan;
    return the_plan;
}

std::atomic<bool> in_main{false}; // what happens before is not the program's
int (*program_main)(int, char**, char**) = nullptr;
std::array<char, 4096> folder{}; // the working directory at the start, with a slash at its end

int watched_main(int argc, char** argv, char** environment) {
    if (::getcwd(folder.data(), folder.size() - 1))
        std::strcat(folder.data(), "/");
    in_main = true;
    const int status = program_main(argc, argv, environment);
    in_main = false;
    return status;
}

std::atomic<long> calls{0};
std::array<std::atomic<bool>, 4096> watched{};

/// Says that the fault was met, without any call that counts.
void mark() {
    if (const char* file = std::getenv("ISOCHRON_FAULT_MARK"))
        ::syscall(SYS_close,
                  ::syscall(SYS_openat, AT_FDCWD, file, O_WRONLY | O_CREAT | O_CLOEXEC, 0666));
}

/// Notes a call on a file that is written: what changes it after the call, a flush before it.
void note(const char* line) {
    static const char* const name = std::getenv("ISOCHRON_CALL_LOG");
    if (!name || !in_main)
        return;
    static const long log =
        ::syscall(SYS_openat, AT_FDCWD, name, O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC, 0666);
    ::syscall(SYS_write, log, line, std::strlen(line));
    static const char* const at = std::getenv("ISOCHRON_KILL_AT");
    static std::atomic<long> lines{0};
    if (at && ++lines == std::atol(at))
        ::raise(SIGKILL);
}
void note(const char* kind, int file) {
    std::array<char, 32> line{};
    std::snprintf(line.data(), line.size(), "%s %d\n", kind, file);
    note(line.data());
}
void note(const char* kind, const char* path, const char* other) {
    std::array<char, 4096> line{};
    std::snprintf(line.data(), line.size(), "%s %s %s\n", kind, path, other);
    note(line.data());
}

/// What this call shall do: none for most.
How fault_of(const char* kind) {
    if (!in_main || plan().how == How::none || std::strcmp(kind, plan().kind.data()) != 0)
        return How::none;
    const long call = ++calls;
    const bool lasts = plan().how == How::no_space || plan().how == How::failed;
    if (call != plan().at && !(lasts && call > plan().at))
        return How::none;
    mark();
    if (plan().how == How::hangs)
        ::kill(::getpid(), plan().signal);
    while (plan().how == How::hangs)
        ::pause();
    return plan().how;
}

int error_of(How how) {
    return how == How::no_space ? ENOSPC : how == How::interrupted ? EINTR : EIO;
}

bool counts(const char* path) {
    return in_main &&
           (path[0] != '/' || std::strncmp(path, folder.data(), std::strlen(folder.data())) == 0);
}

bool is_watched(int file) {
    return file >= 0 && file < int(watched.size()) && watched[file];
}

int opened(int file, bool watch) {
    if (file >= 0 && file < int(watched.size()))
        watched[file] = watch;
    return file;
}

template <class F>
F* real(const char* name) {
    return reinterpret_cast<F*>(dlsym(RTLD_NEXT, name));
}

int open_with(const char* name, const char* path, int flags, unsigned mode) {
    static const auto call = real<int(const char*, int, ...)>(name);
    const bool watch = counts(path);
    if (const How how = watch ? fault_of("open") : How::none;
        how != How::none && how != How::part) {
        errno = error_of(how);
        return -1;
    }
    const int file = opened(call(path, flags, mode), watch);
    if (watch && file >= 0 && (flags & O_ACCMODE) != O_RDONLY) {
        const std::string number = std::to_string(file);
        const std::string unnamed = "/proc/self/fd/" + number; // by which it gets its name
        note("open", number.c_str(), (flags & O_TMPFILE) == O_TMPFILE ? unnamed.c_str() : path);
    }
    return file;
}

/// Runs a transfer of `bytes`: fails it, or shortens it to a half.
template <class Call>
ssize_t transfer(const char* kind, int file, std::size_t bytes, Call call) {
    const How how = is_watched(file) ? fault_of(kind) : How::none;
    const bool noted = is_watched(file) && std::strcmp(kind, "read") != 0;
    const bool flushes = std::strcmp(kind, "sync") == 0;
    if (how == How::none) {
        if (noted && flushes)
            note(kind, file);
        const ssize_t done = call(bytes);
        if (noted && !flushes)
            note(kind, file);
        return done;
    }
    if (how == How::part)
        return call((bytes + 1) / 2);
    errno = error_of(how);
    return -1;
}

} // namespace

extern "C" {

// NOLINTNEXTLINE(bugprone-reserved-identifier,readability-identifier-naming): the C library's
int __libc_start_main(int (*begin)(int, char**, char**), int argc, char** argv, void (*init)(),
                      void (*fini)(), void (*rtld_fini)(), void* stack_end) {
    static const auto call = real<int(int (*)(int, char**, char**), int, char**, void (*)(),
                                      void (*)(), void (*)(), void*)>("__libc_start_main");
    program_main = begin;
    return call(watched_main, argc, argv, init, fini, rtld_fini, stack_end);
}

int open(const char* path, int flags, ...) {
    va_list more;
    va_start(more, flags);
    const unsigned mode = va_arg(more, unsigned);
    va_end(more);
    return open_with("open", path, flags, mode);
}
int open64(const char* path, int flags, ...) {
    va_list more;
    va_start(more, flags);
    const unsigned mode = va_arg(more, unsigned);
    va_end(more);
    return open_with("open64", path, flags, mode);
}
FILE* fopen(const char* path, const char* mode) {
    static const auto call = real<FILE*(const char*, const char*)>("fopen");
    const bool watch = counts(path);
    if (const How how = watch ? fault_of("open") : How::none;
        how != How::none && how != How::part) {
        errno = error_of(how);
        return nullptr;
    }
    FILE* file = call(path, mode);
    if (file)
        opened(fileno(file), watch);
    return file;
}
FILE* fopen64(const char* path, const char* mode) {
    return fopen(path, mode);
}
int close(int file) {
    static const auto call = real<int(int)>("close");
    opened(file, false); // its number may be a socket's next
    return call(file);
}
ssize_t read(int file, void* to, size_t bytes) {
    static const auto call = real<ssize_t(int, void*, size_t)>("read");
    return transfer("read", file, bytes, [&](size_t part) { return call(file, to, part); });
}
ssize_t pread(int file, void* to, size_t bytes, off_t at) {
    static const auto call = real<ssize_t(int, void*, size_t, off_t)>("pread");
    return transfer("read", file, bytes, [&](size_t part) { return call(file, to, part, at); });
}
ssize_t pread64(int file, void* to, size_t bytes, off64_t at) {
    return pread(file, to, bytes, at);
}
ssize_t write(int file, const void* from, size_t bytes) {
    static const auto call = real<ssize_t(int, const void*, size_t)>("write");
    return transfer("write", file, bytes, [&](size_t part) { return call(file, from, part); });
}
ssize_t pwrite(int file, const void* from, size_t bytes, off_t at) {
    static const auto call = real<ssize_t(int, const void*, size_t, off_t)>("pwrite");
    return transfer("write", file, bytes, [&](size_t part) { return call(file, from, part, at); });
}
ssize_t pwrite64(int file, const void* from, size_t bytes, off64_t at) {
    return pwrite(file, from, bytes, at);
}
ssize_t writev(int file, const iovec* parts, int count) {
    static const auto call = real<ssize_t(int, const iovec*, int)>("writev");
    return transfer("write", file, count,
                    [&](size_t part) { return call(file, parts, int(part)); });
}
int fsync(int file) {
    static const auto call = real<int(int)>("fsync");
    return int(transfer("sync", file, 1, [&](size_t) { return call(file); }));
}
int rename(const char* from, const char* to) {
    static const auto call = real<int(const char*, const char*)>("rename");
    if (const How how = counts(to) ? fault_of("rename") : How::none;
        how != How::none && how != How::part) {
        errno = error_of(how);
        return -1;
    }
    if (counts(to))
        note("rename", from, to);
    return call(from, to);
}
int linkat(int from_folder, const char* from, int to_folder, const char* to, int flags) {
    static const auto call = real<int(int, const char*, int, const char*, int)>("linkat");
    if (const How how = counts(to) ? fault_of("rename") : How::none;
        how != How::none && how != How::part) {
        errno = error_of(how);
        return -1;
    }
    if (counts(to))
        note("rename", from, to);
    return call(from_folder, from, to_folder, to, flags);
}
int ftruncate(int file, off_t bytes) {
    static const auto call = real<int(int, off_t)>("ftruncate");
    return int(transfer("size", file, 1, [&](size_t) { return call(file, bytes); }));
}
int ftruncate64(int file, off64_t bytes) {
    return ftruncate(file, bytes);
}
int fallocate(int file, int mode, off_t begin, off_t bytes) {
    static const auto call = real<int(int, int, off_t, off_t)>("fallocate");
    return int(transfer("size", file, 1, [&](size_t) { return call(file, mode, begin, bytes); }));
}
int fallocate64(int file, int mode, off64_t begin, off64_t bytes) {
    return fallocate(file, mode, begin, bytes);
}

} // extern "C"

void* operator new(std::size_t bytes) {
    if (fault_of("new") != How::none)
        throw std::bad_alloc();
    if (void* place = std::malloc(bytes ? bytes : 1))
        return place;
    throw std::bad_alloc();
}
void operator delete(void* place) noexcept {
    std::free(place);
}
void operator delete(void* place, std::size_t) noexcept {
    std::free(place);
}
