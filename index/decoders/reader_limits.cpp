// Limits by setrlimit(2).
#include "index/decoders/reader_limits.h"

#include "index/reader/reader_start.h"
#include "index/system/descriptor.h"

#include <fmt/format.h>

#include <fcntl.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <limits>
#include <sstream>
#include <string>

namespace isochron::index {
namespace {

void limit(decltype(RLIMIT_DATA) resource, std::uint64_t most) {
    struct rlimit limits{};
    ::getrlimit(resource, &limits);
    limits.rlim_cur = std::min<rlim_t>(most, limits.rlim_max);
    ::setrlimit(resource, &limits);
}

/// A file of /proc that stays open: each read from its start tells what holds now.
class HeldSource {
  public:
    explicit HeldSource(const char* path) : file_(::open(path, O_RDONLY | O_CLOEXEC)) {}

    std::istringstream now() const {
        constexpr std::size_t kLongest = 8192;
        std::string text(kLongest, '\0');
        const ssize_t size = ::pread(file_.number(), text.data(), text.size(), 0);
        text.resize(static_cast<std::size_t>(std::max<ssize_t>(size, 0)));
        return std::istringstream(std::move(text));
    }

  private:
    Descriptor file_;
};

const HeldSource& memory_of_this_process() {
    static const HeldSource source("/proc/self/statm");
    return source;
}

const HeldSource& memory_of_the_machine() {
    static const HeldSource source("/proc/meminfo");
    return source;
}

/// [bytes] of private writable memory of this process, which RLIMIT_DATA counts.
std::uint64_t taken_memory() {
    // size, resident, shared, text, 0, data: in pages
    std::istringstream statm = memory_of_this_process().now();
    std::uint64_t pages = 0;
    for (int field = 0; field < 6; ++field)
        statm >> pages;
    return pages * static_cast<std::uint64_t>(::sysconf(_SC_PAGESIZE));
}

/// Free memory [bytes] at the first call; read only once, as reading it takes as long as opening a
/// small file.
std::uint64_t free_memory() {
    static std::uint64_t found = 0;
    if (found > 0)
        return found;
    std::istringstream info = memory_of_the_machine().now();
    std::uint64_t kilobytes = 0;
    for (std::string key, line; info >> key && std::getline(info, line);)
        if (key == "MemAvailable:")
            kilobytes = std::stoull(line);
    found = kilobytes > 0 ? kilobytes * 1024 : std::numeric_limits<std::int64_t>::max();
    return found;
}

/// [bytes] of the folder that a file stands for: of an OpenFOAM case, an AMReX plotfile;
/// else of the file. Of very many files, the first ones.
std::uint64_t bytes_behind(const std::filesystem::path& file) {
    namespace fs = std::filesystem;
    constexpr int kMost = 100'000;
    std::error_code error;
    const std::uint64_t own = fs::file_size(file, error);
    std::uint64_t bytes = error ? 0 : own;
    const std::string name = file.filename().string();
    fs::path folder = fs::absolute(file, error).parent_path();
    if (name == "controlDict")
        folder = folder.parent_path();
    else if (name != "Header" && !name.ends_with(".foam"))
        return bytes;
    int seen = 0;
    for (fs::recursive_directory_iterator at(folder, error), end; !error && at != end;
         at.increment(error)) {
        std::error_code gone;
        if (const auto size = at->is_regular_file(gone) ? at->file_size(gone) : 0; !gone)
            bytes += size;
        if (++seen == kMost)
            break;
    }
    return bytes;
}

/// More time than any library needs: a minute, and a second for each megabyte.
std::uint64_t seconds_for(std::uint64_t bytes) {
    return 60 + bytes / 1'000'000;
}

} // namespace

void hold_sources_of_limits() {
    memory_of_this_process();
    memory_of_the_machine();
}

ReaderBudget::ReaderBudget(const std::filesystem::path& file, std::uint64_t most)
    : before_(taken_memory()), most_(most > 0 ? most : free_memory()) {
    file_bytes_ = bytes_behind(file);
    expect(0);
    renew_time();
}

void ReaderBudget::expect(std::uint64_t decoded_bytes) {
    // Memory of the libraries themselves; text that becomes numbers of eight bytes; some copies.
    constexpr std::uint64_t kAny = std::uint64_t{1} << 30, kOfFile = 8, kOfValues = 4;
    constexpr std::uint64_t kMost = std::uint64_t{1} << 56;
    memory_ = std::min(most_, kAny + kOfFile * std::min(file_bytes_, kMost) +
                                  kOfValues * std::min(decoded_bytes, kMost));
    if (!kReaderIsWatched)
        limit(RLIMIT_DATA, before_ + memory_);
}

void ReaderBudget::renew_time() const {
    struct rusage used{};
    ::getrusage(RUSAGE_SELF, &used);
    if (!kReaderIsWatched)
        limit(RLIMIT_CPU, static_cast<std::uint64_t>(used.ru_utime.tv_sec + used.ru_stime.tv_sec) +
                              1 + seconds_for(file_bytes_));
}

std::string ReaderBudget::text() const {
    return fmt::format("at most {:.1f} GB for it", static_cast<double>(memory_) / 1e9);
}

} // namespace isochron::index
