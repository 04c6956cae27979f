// Finds which file the fence has denied to a library, by standing in for the C library's functions
// that open files: a library that is loaded takes those of the program.
#include "index/readers/decoders/denied_files.h"

#include <dlfcn.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <mutex>
#include <string_view>

namespace isochron::index {
namespace {

constexpr int kHere = -100; // AT_FDCWD; fcntl.h would declare the functions below in its own way

std::mutex mutex;
std::array<char, 4096> denied{}; // not a string: a library may open files where memory has run out

/// What libraries look up on their own, and can do without.
bool is_of_the_system(std::string_view path) {
    for (const std::string_view folder : {"/proc/", "/sys/", "/dev/", "/etc/", "/usr/"})
        if (path.starts_with(folder))
            return true;
    return false;
}

void note(const char* path) {
    const int error = errno;
    struct stat status {};
    // Landlock hides contents, not whether there is a file and who may read it.
    if (error == EACCES && path && !is_of_the_system(path) && ::access(path, R_OK) == 0 &&
        ::stat(path, &status) == 0 && S_ISREG(status.st_mode)) {
        const std::lock_guard lock(mutex);
        if (denied[0] == '\0' && std::strlen(path) < denied.size())
            std::strcpy(denied.data(), path);
    }
    errno = error;
}

int open_and_note(const char* path, int flags, unsigned mode) {
    const auto file = static_cast<int>(::syscall(SYS_openat, kHere, path, flags, mode));
    if (file < 0)
        note(path);
    return file;
}

std::FILE* stream_of(const char* path, const char* mode) {
    using Open = std::FILE* (*)(const char*, const char*);
    static const auto open = reinterpret_cast<Open>(::dlsym(RTLD_NEXT, "fopen64"));
    std::FILE* const stream = open(path, mode);
    if (!stream)
        note(path);
    return stream;
}

} // namespace

std::filesystem::path take_denied_file() {
    const std::lock_guard lock(mutex);
    std::filesystem::path path = denied.data();
    denied[0] = '\0';
    return path;
}

} // namespace isochron::index

#ifndef ISOCHRON_SANITIZED // there is no fence then, and the sanitizer stands in for these itself

// The names with which libraries call them; a mode that is not given is not looked at.
extern "C" {
[[gnu::visibility("default")]] int denied_open(const char* path, int flags,
                                               unsigned mode) asm("open");
[[gnu::visibility("default")]] int denied_open64(const char* path, int flags,
                                                 unsigned mode) asm("open64");
[[gnu::visibility("default")]] int denied_open_2(const char* path, int flags) asm("__open_2");
[[gnu::visibility("default")]] int denied_open64_2(const char* path, int flags) asm("__open64_2");
[[gnu::visibility("default")]] std::FILE* denied_fopen(const char* path,
                                                       const char* mode) asm("fopen");
[[gnu::visibility("default")]] std::FILE* denied_fopen64(const char* path,
                                                         const char* mode) asm("fopen64");

int denied_open(const char* path, int flags, unsigned mode) {
    return isochron::index::open_and_note(path, flags, mode);
}
int denied_open64(const char* path, int flags, unsigned mode) {
    return isochron::index::open_and_note(path, flags, mode);
}
int denied_open_2(const char* path, int flags) {
    return isochron::index::open_and_note(path, flags, 0);
}
int denied_open64_2(const char* path, int flags) {
    return isochron::index::open_and_note(path, flags, 0);
}
std::FILE* denied_fopen(const char* path, const char* mode) {
    return isochron::index::stream_of(path, mode);
}
std::FILE* denied_fopen64(const char* path, const char* mode) {
    return isochron::index::stream_of(path, mode);
}
}

#endif
