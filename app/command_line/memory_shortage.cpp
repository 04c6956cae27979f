// Handles the signals of crashes where the address space is used up.
#include "app/command_line/memory_shortage.h"

#include "index/system/memory_limit.h"

#include <fmt/format.h>

#include <array>
#include <cstdint>
#include <cstring>

#include <csignal>
#include <fcntl.h>
#include <malloc.h>
#include <sys/resource.h>
#include <unistd.h>

namespace isochron::app {
namespace {

constexpr std::array kCrashes{SIGSEGV, SIGBUS, SIGABRT, SIGILL};
constexpr int kArenas = 2; ///< each takes 64 MiB of address space
/// With less address space than this left, a crash is a lack of it: drivers allocate tens of MiB.
constexpr std::uint64_t kLittle = 160 << 20;

// What the handler needs is made before.
std::array<char, 256> line{};
std::size_t line_length = 0;
std::uint64_t address_space = 0, page_size = 0; ///< [bytes]

/// The address space in use [bytes]; only calls that are safe in a handler.
std::uint64_t addresses_used() {
    std::array<char, 32> text{};
    const int file = ::open("/proc/self/statm", O_RDONLY | O_CLOEXEC);
    if (file < 0)
        return 0;
    const ssize_t got = ::read(file, text.data(), text.size() - 1);
    ::close(file);
    std::uint64_t pages = 0;
    for (ssize_t i = 0; i < got && text[static_cast<std::size_t>(i)] >= '0' &&
                        text[static_cast<std::size_t>(i)] <= '9';
         ++i)
        pages = 10 * pages + static_cast<std::uint64_t>(text[static_cast<std::size_t>(i)] - '0');
    return pages * page_size;
}

/// The signal's own action is back when this runs: what does not return from here crashes again.
void end_for_shortage(int) {
    if (addresses_used() + kLittle < address_space)
        return;
    [[maybe_unused]] const ssize_t written = ::write(STDERR_FILENO, line.data(), line_length);
    ::_exit(1);
}

} // namespace

void keep_freed_memory() {
#ifdef __GLIBC__
    constexpr int kAtEnd = 16 << 20, kBlock = 4 << 20; // [byte]
    ::mallopt(M_TRIM_THRESHOLD, kAtEnd); // setting one of them stops glibc from adapting the other
    ::mallopt(M_MMAP_THRESHOLD, kBlock);
#endif
}

void prepare_for_shortage(const char* program) {
    struct rlimit space{};
    if (::getrlimit(RLIMIT_AS, &space) != 0 || space.rlim_cur == RLIM_INFINITY)
        return;
    address_space = space.rlim_cur;
    ::mallopt(M_ARENA_MAX, kArenas);
    page_size = static_cast<std::uint64_t>(::sysconf(_SC_PAGESIZE));
    const std::string text = fmt::format("{}: {}\n", program, index::shortage_of_memory());
    line_length = std::min(text.size(), line.size());
    std::memcpy(line.data(), text.data(), line_length);
    struct sigaction action{};
    action.sa_handler = end_for_shortage;
    action.sa_flags = static_cast<int>(SA_RESETHAND | SA_NODEFER);
    for (const int crash : kCrashes)
        ::sigaction(crash, &action, nullptr);
}

} // namespace isochron::app
