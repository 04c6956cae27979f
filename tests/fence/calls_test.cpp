// Every call of the system from inside the fence: a table of what each may do.
#include "tests/fence/inside.h"
#include "tests/support/test_folder.h"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <seccomp.h>

#include <fcntl.h>
#include <poll.h>
#include <sched.h>
#include <signal.h>
#include <sys/file.h>
#include <sys/ioctl.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <sys/uio.h>
#include <sys/utsname.h>
#include <time.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <map>
#include <memory>
#include <set>
#include <vector>

// A sanitizer makes calls of its own that the fence refuses: there readers go without it.
#ifndef ISOCHRON_SANITIZED

namespace isochron {
namespace {

namespace fs = std::filesystem;
using test_support::surprises_inside;
using test_support::TestFolder;

/// The calls that do something inside the fence, with any arguments or with some.
const std::set<std::string_view> kUsable{
    "read", "pread64", "readv", "preadv", "lseek", "close", "dup", "getdents64", "write", "writev",
    "stat", "fstat", "lstat", "newfstatat", "statx", "statfs", "fstatfs", "access", "faccessat",
    "faccessat2", "readlink", "readlinkat", "getcwd", "recvmsg", "poll", "ppoll", "brk", "munmap",
    "mremap", "mprotect", "futex", "set_robust_list", "rseq", "sched_yield", "sched_getaffinity",
    "gettid", "getpid", "getppid", "arch_prctl", "exit", "exit_group", "rt_sigaction",
    "rt_sigprocmask", "rt_sigreturn", "sigaltstack", "restart_syscall", "clock_gettime",
    "clock_getres", "clock_nanosleep", "nanosleep", "gettimeofday", "time", "times", "getrlimit",
    "getrusage", "uname", "sysinfo", "getrandom", "getuid", "geteuid", "getgid", "getegid",
    // With some arguments only; the tests below have those.
    "open", "openat", "sendto", "fcntl", "madvise", "mmap", "prlimit64", "tgkill", "clone"};

/// The calls that are answered without being made.
const std::map<std::string_view, int> kAnswered{{"flock", 0}, {"clone3", ENOSYS}};

/// Later kernels let these past every filter. They are the ways back from probes that a debugger has
/// set in this process (uretprobe, uprobe); without such a probe they end the process or fail.
const std::set<int> kPastEveryFilter{335, 336};

std::string name_of(int call) {
    const std::unique_ptr<char, decltype(&std::free)> name(
        ::seccomp_syscall_resolve_num_arch(SCMP_ARCH_NATIVE, call), std::free);
    return name ? name.get() : "";
}

// The numbers beyond the table are those of calls that later kernels have.
TEST(FencedCalls, AreRefusedUnlessTheTableHasThem) {
    constexpr int kBeyondAll = 600;
    std::set<std::string_view> usable = kUsable;
    std::string lines;
    for (int call = 0; call < kBeyondAll; ++call) {
        const std::string name = name_of(call);
        if (usable.erase(name) > 0 || kPastEveryFilter.contains(call))
            continue;
        const auto answered = kAnswered.find(name);
        const int expected = answered == kAnswered.end() ? EPERM : answered->second;
        lines += surprises_inside({}, [&]() -> std::string {
            // Arguments that no call takes, should it be made after all.
            const long result = ::syscall(call, -1L, -1L, -1L, -1L, -1L, -1L);
            const int error = result < 0 ? errno : 0;
            return error == expected ? ""
                                     : fmt::format("{} ({}): {}, expected {}\n", call, name,
                                                   std::strerror(error), std::strerror(expected));
        });
    }
    EXPECT_EQ(lines, "");
    EXPECT_TRUE(usable.empty()) << *usable.begin() << " is no call of this machine";
}

/// Whether a call was refused by the fence.
bool refused(long result) {
    return result == -1 && errno == EPERM;
}

/// Lines of the claims that do not hold.
std::string false_of(std::initializer_list<std::pair<const char*, bool>> claims) {
    std::string lines;
    for (const auto& [claim, holds] : claims)
        if (!holds)
            lines += fmt::format("not so: {}\n", claim);
    return lines;
}

class FencedArguments : public testing::Test {
  protected:
    fs::path file_ = folder_().write("file", "content");
    fs::path place_[1]{folder_().path()};
    int open_ = ::open(file_.c_str(), O_RDONLY | O_CLOEXEC);

    static TestFolder& folder_() {
        static TestFolder folder;
        return folder;
    }
    void TearDown() override {
        ::close(open_);
        EXPECT_EQ(folder_().read("file"), "content");
    }
};

TEST_F(FencedArguments, OfOpenAreForReadingOnly) {
    const char* const file = file_.c_str();
    EXPECT_EQ(
        surprises_inside(
            place_,
            [&] {
                const std::string other = file_.string() + "2";
                return false_of({
                    {"open", ::syscall(SYS_open, file, O_RDONLY) >= 0},
                    {"openat", ::openat(AT_FDCWD, file, O_RDONLY) >= 0},
                    {"no writing", refused(::open(file, O_WRONLY))},
                    {"neither both", refused(::open(file, O_RDWR))},
                    {"nor appending", refused(::open(file, O_WRONLY | O_APPEND))},
                    {"no making", refused(::open(other.c_str(), O_CREAT, 0600))},
                    {"no cutting", refused(::open(file, O_TRUNC))},
                    {"no unnamed file", refused(::open("/tmp", O_TMPFILE | O_RDWR, 0600))},
                    {"openat2 is not known", refused(::syscall(437, AT_FDCWD, file, nullptr, 0))},
                });
            }),
        "");
}

TEST_F(FencedArguments, OfSocketsLeadNowhereElse) {
    std::array<int, 2> pair{};
    ASSERT_EQ(::socketpair(AF_UNIX, SOCK_STREAM, 0, pair.data()), 0);
    const int datagrams = ::socket(AF_INET, SOCK_DGRAM, 0);
    ASSERT_GE(datagrams, 0);
    EXPECT_EQ(
        surprises_inside(
            {},
            [&] {
                char byte = 'x';
                iovec part{&byte, 1};
                msghdr message{};
                message.msg_iov = &part;
                message.msg_iovlen = 1;
                sockaddr address{};
                pollfd ready{pair[1], POLLIN, 0};
                return false_of({
                    {"no new one", refused(::socket(AF_UNIX, SOCK_STREAM, 0))},
                    {"no new pair", refused(::socketpair(AF_UNIX, SOCK_STREAM, 0, pair.data()))},
                    {"no connection", refused(::connect(datagrams, &address, sizeof address))},
                    {"no address",
                     refused(::sendto(datagrams, &byte, 1, 0, &address, sizeof address))},
                    {"no descriptors", refused(::sendmsg(pair[0], &message, 0))},
                    {"an answer", ::send(pair[0], &byte, 1, MSG_NOSIGNAL) == 1},
                    {"waiting", ::poll(&ready, 1, -1) == 1},
                    {"a question", ::recvmsg(pair[1], &message, 0) == 1},
                });
            }),
        "");
    for (const int each : {pair[0], pair[1], datagrams})
        ::close(each);
}

TEST_F(FencedArguments, OfDescriptorsReachNobodyElse) {
    EXPECT_EQ(surprises_inside(
                  {},
                  [&] {
                      const f_owner_ex owner{F_OWNER_PID, ::getppid()};
                      struct flock lock {};
                      lock.l_type = F_RDLCK;
                      int on = 1;
                      return false_of({
                          {"F_GETFD", ::fcntl(open_, F_GETFD) == FD_CLOEXEC},
                          {"F_SETFD", ::fcntl(open_, F_SETFD, FD_CLOEXEC) == 0},
                          {"F_SETFL", ::fcntl(open_, F_SETFL, ::fcntl(open_, F_GETFL)) == 0},
                          {"F_DUPFD", ::fcntl(open_, F_DUPFD, 0) >= 0},
                          {"F_DUPFD_CLOEXEC", ::fcntl(open_, F_DUPFD_CLOEXEC, 0) >= 0},
                          {"no F_SETOWN", refused(::fcntl(open_, F_SETOWN, ::getppid()))},
                          {"no F_SETOWN_EX", refused(::fcntl(open_, F_SETOWN_EX, &owner))},
                          {"no F_SETSIG", refused(::fcntl(open_, F_SETSIG, SIGKILL))},
                          {"no O_ASYNC", refused(::fcntl(open_, F_SETFL, O_ASYNC))},
                          {"no F_SETLEASE", refused(::fcntl(open_, F_SETLEASE, F_RDLCK))},
                          {"no F_SETLK", refused(::fcntl(open_, F_SETLK, &lock))},
                          {"no F_SETLKW", refused(::fcntl(open_, F_SETLKW, &lock))},
                          {"no F_OFD_SETLK", refused(::fcntl(open_, F_OFD_SETLK, &lock))},
                          {"no F_NOTIFY", refused(::fcntl(open_, F_NOTIFY, DN_MODIFY))},
                          {"no F_SETPIPE_SZ", refused(::fcntl(open_, F_SETPIPE_SZ, 1 << 20))},
                          {"no FIOASYNC", refused(::ioctl(open_, FIOASYNC, &on))},
                      });
                  }),
              "");
}

// The answer is that it is locked, and yet another can lock it.
TEST_F(FencedArguments, OfLocksHoldNobodyUp) {
    EXPECT_EQ(surprises_inside({},
                               [&] {
                                   return false_of({{"flock", ::flock(open_, LOCK_EX) == 0}});
                               }),
              "");
    // A lock of the child would be one of the same open file: this is another.
    const int again = ::open(file_.c_str(), O_RDONLY | O_CLOEXEC);
    EXPECT_EQ(surprises_inside({}, [&] { return ::flock(open_, LOCK_EX) == 0 ? "" : "no"; }), "");
    EXPECT_EQ(::flock(again, LOCK_EX | LOCK_NB), 0);
    ::close(again);
}

TEST_F(FencedArguments, OfLimitsAndSignalsAreForThisProcess) {
    EXPECT_EQ(
        surprises_inside(
            {},
            [&] {
                struct rlimit limit {};
                std::string lines = false_of({
                    {"read", ::prlimit(0, RLIMIT_NOFILE, nullptr, &limit) == 0},
                    {"no other process's",
                     refused(::prlimit(::getppid(), RLIMIT_CPU, nullptr, &limit))},
                    {"no growing files", refused(::prlimit(0, RLIMIT_FSIZE, &limit, nullptr))},
                    {"no growing files by the older call",
                     refused(::syscall(SYS_setrlimit, RLIMIT_FSIZE, &limit))},
                    {"no signal to others", refused(::kill(::getppid(), 0))},
                    {"no signal to a thread of others",
                     refused(::syscall(SYS_tgkill, ::getppid(), ::getppid(), 0))},
                    {"none to all", refused(::kill(-1, 0))},
                    {"none queued",
                     refused(::syscall(SYS_rt_sigqueueinfo, ::getppid(), SIGUSR1, nullptr))},
                    {"to itself", ::syscall(SYS_tgkill, ::getpid(), ::gettid(), 0) == 0},
                });
                for (const auto resource : {RLIMIT_DATA, RLIMIT_CPU, RLIMIT_AS}) {
                    ::getrlimit(resource, &limit);
                    lines += false_of(
                        {{"no limit of its own", refused(::prlimit(0, resource, &limit, nullptr))},
                         {"none by the older call",
                          refused(::syscall(SYS_setrlimit, resource, &limit))}});
                }
                return lines;
            }),
        "");
}

// Private memory counts against the limit that the program has set; shared memory would not.
TEST_F(FencedArguments, OfMemoryShareNoneThatBelongsToNoFile) {
    EXPECT_EQ(surprises_inside(
                  {},
                  [&] {
                      const auto mapped = [&](int flags, int file) {
                          void* const at = ::mmap(nullptr, 4096, PROT_READ, flags, file, 0);
                          return at == MAP_FAILED ? -1L : 0L;
                      };
                      return false_of({
                          {"memory", mapped(MAP_PRIVATE | MAP_ANONYMOUS, -1) == 0},
                          {"a file", mapped(MAP_PRIVATE, open_) == 0},
                          {"a shared file", mapped(MAP_SHARED, open_) == 0},
                          {"no shared memory", refused(mapped(MAP_SHARED | MAP_ANONYMOUS, -1))},
                          {"nor checked", refused(mapped(MAP_SHARED_VALIDATE | MAP_ANONYMOUS, -1))},
                          {"no file of memory", refused(::syscall(SYS_memfd_create, "m", 0))},
                      });
                  }),
              "");
}

TEST_F(FencedArguments, OfCloneMakeThreadsOnly) {
    EXPECT_EQ(surprises_inside(
                  {},
                  [&] {
                      char name[] = "true";
                      char* const words[]{name, nullptr};
                      constexpr long kThread = CLONE_THREAD | CLONE_SIGHAND | CLONE_VM;
                      return false_of({
                          {"no process", refused(::syscall(SYS_clone, SIGCHLD, 0, 0, 0, 0))},
                          {"no fork", refused(::syscall(SYS_fork))},
                          {"no vfork", refused(::syscall(SYS_vfork))},
                          {"no program", refused(::execv("/bin/true", words))},
                          {"no thread in a user's space of its own",
                           refused(::syscall(SYS_clone, kThread | CLONE_NEWUSER, 0, 0, 0, 0))},
                          {"no thread in a network of its own",
                           refused(::syscall(SYS_clone, kThread | CLONE_NEWNET, 0, 0, 0, 0))},
                          {"no traced thread",
                           refused(::syscall(SYS_clone, kThread | CLONE_PTRACE, 0, 0, 0, 0))},
                      });
                  }),
              "");
}

TEST_F(FencedArguments, OfMemoryAreForThisProcess) {
    constexpr std::size_t kSize = 1 << 16;
    constexpr int kSoftOffline = 101; // MADV_SOFT_OFFLINE
    EXPECT_EQ(surprises_inside(
                  {},
                  [&] {
                      void* const at = ::mmap(nullptr, kSize, PROT_READ | PROT_WRITE,
                                              MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
                      return false_of({
                          {"memory", at != MAP_FAILED},
                          {"advice", ::madvise(at, kSize, MADV_DONTNEED) == 0},
                          {"no holes", refused(::madvise(at, kSize, MADV_REMOVE))},
                          {"no poison", refused(::madvise(at, kSize, MADV_HWPOISON))},
                          {"no pages taken away", refused(::madvise(at, kSize, kSoftOffline))},
                          {"no writing to files", ::mmap(nullptr, 1, PROT_READ | PROT_WRITE,
                                                         MAP_SHARED, open_, 0) == MAP_FAILED &&
                                                      errno == EACCES},
                      });
                  }),
              "");
}

// What each of the others is for; each does that, and nothing that outlasts the process.
TEST_F(FencedArguments, OfReadingTimeAndThreadsDoWhatTheyAreFor) {
    const char* const file = file_.c_str();
    EXPECT_EQ(surprises_inside(
                  place_,
                  [&] {
                      std::array<char, 256> bytes{};
                      iovec part{bytes.data(), 4};
                      struct stat status {};
                      timespec time{0, 1};
                      struct utsname machine {};
                      struct rusage usage {};
                      cpu_set_t processors{};
                      const int folder = ::open(folder_().path().c_str(), O_RDONLY | O_DIRECTORY);
                      const int null = ::open("/dev/null", O_RDONLY);
                      return false_of({
                          {"read", ::read(open_, bytes.data(), 1) == 1},
                          {"pread64", ::pread(open_, bytes.data(), 1, 0) == 1},
                          {"readv", ::readv(open_, &part, 1) == 4},
                          {"preadv", ::preadv(open_, &part, 1, 0) == 4},
                          {"lseek", ::lseek(open_, 0, SEEK_SET) == 0},
                          {"dup and close", ::close(::dup(open_)) == 0},
                          {"getdents64",
                           ::syscall(SYS_getdents64, folder, bytes.data(), bytes.size()) > 0},
                          {"write, not there", ::write(open_, "x", 1) == -1 && errno == EBADF},
                          {"null device", ::read(null, bytes.data(), 1) == 0},
                          {"stat", ::stat(file, &status) == 0 && ::lstat(file, &status) == 0},
                          {"access", ::access(file, R_OK) == 0},
                          {"readlink", ::readlink(file, bytes.data(), 1) == -1 && errno == EINVAL},
                          {"getcwd", ::getcwd(bytes.data(), bytes.size()) || errno == ERANGE},
                          {"sched_getaffinity",
                           ::sched_getaffinity(0, sizeof processors, &processors) == 0},
                          {"sched_yield", ::sched_yield() == 0},
                          {"clock_gettime", ::clock_gettime(CLOCK_MONOTONIC, &time) == 0},
                          {"uname", ::uname(&machine) == 0},
                          {"getrusage", ::getrusage(RUSAGE_SELF, &usage) == 0},
                          {"getrandom", ::syscall(SYS_getrandom, bytes.data(), 4, 0) == 4},
                          {"getpid", ::getpid() > 0 && ::getppid() > 0 && ::gettid() > 0},
                      });
                  }),
              "");
}

} // namespace
} // namespace isochron

#endif
