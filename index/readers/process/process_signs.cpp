// Reads /proc/PID/io and /proc/PID/stat, see proc(5).
#include "index/readers/process/process_signs.h"

#include "index/readers/process/process_text.h"

#include <fmt/format.h>

#include <time.h>

#include <sstream>
#include <string>

namespace isochron::index {
namespace {

std::string contents(pid_t process, const char* name) {
    return process_text(fmt::format("/proc/{}/{}", process, name));
}

} // namespace

std::chrono::nanoseconds processor_time_of(pid_t process) {
    clockid_t clock{};
    timespec time{};
    if (::clock_getcpuclockid(process, &clock) != 0 || ::clock_gettime(clock, &time) != 0)
        return std::chrono::nanoseconds{0};
    return std::chrono::seconds(time.tv_sec) + std::chrono::nanoseconds(time.tv_nsec);
}

std::optional<ProcessSigns> signs_of(pid_t process) {
    ProcessSigns signs;
    std::istringstream io(contents(process, "io"));
    std::string word;
    if (!(io >> word >> signs.read) || word != "rchar:")
        return std::nullopt;
    const std::string stat = contents(process, "stat");
    const std::size_t name_end = stat.rfind(')'); // the name may hold any character
    if (name_end == std::string::npos)
        return std::nullopt;
    std::istringstream fields(stat.substr(name_end + 1));
    char state = 0;
    std::int64_t skipped = 0;
    std::uint64_t minor = 0, major = 0;
    fields >> state;
    for (int field = 4; field < 10; ++field)
        fields >> skipped;
    fields >> minor >> skipped >> major;
    if (!fields)
        return std::nullopt;
    signs.touched = minor + major;
    signs.worked = processor_time_of(process);
    signs.waits_for_disk = state == 'D';
    signs.runs = state == 'R';
    return signs;
}

} // namespace isochron::index
