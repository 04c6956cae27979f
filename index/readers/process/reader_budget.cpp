// Limits by prlimit(2).
#include "index/readers/process/reader_budget.h"

#include "index/error.h"
#include "index/readers/process/process_signs.h"
#include "index/readers/process/process_text.h"
#include "index/readers/process/reader_start.h"

#include <fmt/format.h>

#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <limits>
#include <sstream>
#include <string>

namespace isochron::index {
namespace {

/// Sets the limit that holds; the highest one that could be set stays, as only root may raise it
/// again for the next file. A reader that has ended needs none.
void limit(pid_t reader, decltype(RLIMIT_DATA) resource, std::uint64_t most) {
    struct rlimit limits {};
    bool good = ::prlimit(reader, resource, nullptr, &limits) == 0;
    limits.rlim_cur = std::min<rlim_t>(most, limits.rlim_max);
    good = good && ::prlimit(reader, resource, &limits, nullptr) == 0;
    if (!good && errno != ESRCH)
        throw Error("its reader cannot be limited: {}", std::strerror(errno));
}

/// [bytes] of private writable memory of a process, which RLIMIT_DATA counts.
std::uint64_t taken_memory(pid_t process) {
    // size, resident, shared, text, 0, data: in pages
    std::istringstream statm(process_text(fmt::format("/proc/{}/statm", process)));
    std::uint64_t pages = 0;
    for (int field = 0; field < 6; ++field)
        statm >> pages;
    return pages * static_cast<std::uint64_t>(::sysconf(_SC_PAGESIZE));
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

} // namespace

std::uint64_t free_memory() {
    std::istringstream info(process_text("/proc/meminfo"));
    std::uint64_t kilobytes = 0;
    for (std::string key, line; info >> key && std::getline(info, line);)
        if (key == "MemAvailable:")
            kilobytes = std::stoull(line);
    return kilobytes > 0 ? kilobytes * 1024 : std::numeric_limits<std::int64_t>::max();
}

ReaderBudget::ReaderBudget(pid_t reader, const std::filesystem::path& file, std::uint64_t most)
    : reader_(reader), file_bytes_(bytes_behind(file)), before_(taken_memory(reader)), most_(most) {
    expect(0);
    renew_time();
}

void ReaderBudget::expect(std::uint64_t decoded_bytes) {
    // Memory of the libraries themselves; text that becomes numbers of eight bytes; some copies.
    constexpr std::uint64_t kAny = std::uint64_t{1} << 30, kOfFile = 8, kOfValues = 4;
    constexpr std::uint64_t kMost = std::uint64_t{1} << 56;
    if (!kReaderIsWatched)
        limit(reader_, RLIMIT_DATA,
              before_ + std::min(most_, kAny + kOfFile * std::min(file_bytes_, kMost) +
                                            kOfValues * std::min(decoded_bytes, kMost)));
}

void ReaderBudget::renew_time() const {
    constexpr std::chrono::seconds kAny{61}; // more than any library needs for a small file
    if (!kReaderIsWatched)
        limit(reader_, RLIMIT_CPU,
              static_cast<std::uint64_t>((processor_time_of(reader_) + kAny + time_of_bytes()) /
                                         std::chrono::seconds(1)));
}

} // namespace isochron::index
