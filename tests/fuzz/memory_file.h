// Files in memory, for targets that open them by their names.
#pragma once

#include "tests/fuzz/claims.h"

#include <sys/mman.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <string>

namespace isochron::fuzz {

/// A file in memory, with a name under which it is opened.
class MemoryFile {
  public:
    explicit MemoryFile(Bytes bytes) : file_(::memfd_create("input", MFD_CLOEXEC)) {
        if (file_ < 0 ||
            ::write(file_, bytes.data(), bytes.size()) != static_cast<ssize_t>(bytes.size()))
            throw std::runtime_error("no file in memory");
    }
    ~MemoryFile() { ::close(file_); }
    MemoryFile(const MemoryFile&) = delete;
    MemoryFile& operator=(const MemoryFile&) = delete;

    std::string path() const { return std::string("/proc/self/fd/").append(std::to_string(file_)); }

  private:
    int file_;
};

/// A folder of files of values, for headers beside them; removed at the end.
class ValueFiles {
  public:
    ValueFiles() {
        std::string pattern = std::filesystem::is_directory("/dev/shm")
                                  ? "/dev/shm/isochron_fuzz_XXXXXX"
                                  : "/tmp/isochron_fuzz_XXXXXX";
        if (!::mkdtemp(pattern.data()))
            throw std::runtime_error("no folder in memory");
        folder_ = pattern;
        for (const char* name : {"a", "b", "c", "v01", "v02", "v03", "v04"}) {
            std::ofstream file(folder_ / name, std::ios::binary);
            for (int i = 0; i < 4096; ++i)
                file.put(static_cast<char>(7 * i));
        }
    }
    ~ValueFiles() {
        std::error_code ignored;
        std::filesystem::remove_all(folder_, ignored);
    }
    ValueFiles(const ValueFiles&) = delete;
    ValueFiles& operator=(const ValueFiles&) = delete;

    /// Writes the header. @return its path
    std::string with_header(const char* name, Bytes bytes) const {
        const std::filesystem::path path = folder_ / name;
        std::ofstream(path, std::ios::binary)
            .write(reinterpret_cast<const char*>(bytes.data()),
                   static_cast<std::streamsize>(bytes.size()));
        return path.string();
    }

  private:
    std::filesystem::path folder_;
};

} // namespace isochron::fuzz
