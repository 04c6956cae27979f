// The fence: files by Landlock, and a list of allowed system calls, enforced by seccomp(2).
#include "index/readers/decoders/fence.h"

#include "index/readers/process/file_fence.h"

#ifdef ISOCHRON_WITH_SECCOMP
#include <seccomp.h>
#endif

#include <dirent.h>
#include <fcntl.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdint>
#include <cstdlib>
#include <string>

namespace isochron::index {
namespace {

// What follows is of linux/landlock.h, which systems have in versions that know less than the
// kernel that runs.

enum FileRight : std::uint64_t { kReadFile = 1 << 2, kReadFolder = 1 << 3 };

/// The rights on files that a version of Landlock knows: all of them are taken away.
constexpr std::uint64_t rights_in(int version) {
    constexpr int kInTheFirst = 13, kLater[]{2, 3, 5}; // each of these versions added one
    int count = kInTheFirst;
    for (const int added : kLater)
        count += version >= added ? 1 : 0;
    return (std::uint64_t{1} << count) - 1;
}

struct Ruleset {
    std::uint64_t files, ports, scopes;
};

constexpr std::size_t ruleset_size(int version) {
    const std::size_t fields = version >= 6 ? 3 : version >= 4 ? 2 : 1;
    return fields * sizeof(std::uint64_t);
}

struct [[gnu::packed]] PathRule {
    std::uint64_t rights;
    std::int32_t parent;
};

class FileFence {
  public:
    /// @param version of Landlock
    explicit FileFence(int version) {
        const Ruleset all{.files = rights_in(version), .ports = 3, .scopes = 3};
        ruleset_ = static_cast<int>(::syscall(kCreate, &all, ruleset_size(version), 0u));
    }
    ~FileFence() {
        if (ruleset_ >= 0)
            ::close(ruleset_);
    }
    FileFence(const FileFence&) = delete;
    FileFence& operator=(const FileFence&) = delete;

    /// @return false when the kernel refuses; true also where there is nothing at the path
    bool let_read(const char* path) const {
        const int place = ::open(path, O_PATH | O_CLOEXEC);
        if (place < 0)
            return true;
        struct stat status {};
        const bool there = ::fstat(place, &status) == 0;
        const PathRule rule{there && S_ISDIR(status.st_mode) ? kReadFile | kReadFolder
                                                             : std::uint64_t{kReadFile},
                            place};
        constexpr unsigned kBeneath = 1; // LANDLOCK_RULE_PATH_BENEATH
        const bool good = there && ::syscall(kAddRule, ruleset_, kBeneath, &rule, 0u) == 0;
        ::close(place);
        return good;
    }
    bool close_gate() const { return ruleset_ >= 0 && ::syscall(kRestrictSelf, ruleset_, 0u) == 0; }

  private:
    static constexpr long kCreate = 444, kAddRule = 445, kRestrictSelf = 446; // on all machines
    int ruleset_ = -1;
};

/// Landlock restricts one thread and those that it starts.
bool is_the_only_thread() {
    DIR* const threads = ::opendir("/proc/self/task");
    if (!threads)
        return true; // without /proc; readers call this before they start any
    int count = 0;
    while (const dirent* entry = ::readdir(threads))
        count += entry->d_name[0] != '.' ? 1 : 0;
    ::closedir(threads);
    return count <= 1;
}

/// What libraries load later: other libraries, character sets, filters of HDF5; and what tells
/// them how many processors there are.
constexpr const char* kOfLibraries[]{"/usr/lib",
                                     "/usr/lib32",
                                     "/usr/lib64",
                                     "/usr/local/lib",
                                     "/usr/local/hdf5/lib/plugin",
                                     "/lib",
                                     "/lib64",
                                     "/usr/share/locale",
                                     "/usr/share/zoneinfo",
                                     "/etc/ld.so.cache",
                                     "/etc/localtime",
                                     "/sys/devices/system/cpu",
                                     "/dev/null",
                                     "/dev/urandom"};

bool hide_files(std::span<const std::filesystem::path> readable) {
    const int version = file_fence_version();
    if (version < 1)
        return true; // this kernel has none, as `isochron --version` says
    const FileFence fence(version);
    bool good = is_the_only_thread();
    for (const char* const path : kOfLibraries)
        good &= fence.let_read(path);
    if (const char* const plugins = std::getenv("HDF5_PLUGIN_PATH"))
        for (std::string_view rest = plugins; !rest.empty();) {
            const std::string path(rest.substr(0, rest.find(':')));
            rest.remove_prefix(std::min(path.size() + 1, rest.size()));
            good &= fence.let_read(path.c_str());
        }
    for (const std::filesystem::path& path : readable)
        good &= fence.let_read(path.c_str());
    return good && fence.close_gate();
}

#ifdef ISOCHRON_WITH_SECCOMP

/// The calls that reading, computing and answering need, with any arguments.
constexpr int kAllowed[]{
    // Reads of what is open. Nothing outside changes but the place of a descriptor, and all
    // descriptors of a reader are its own.
    SCMP_SYS(read), SCMP_SYS(pread64), SCMP_SYS(readv), SCMP_SYS(preadv), SCMP_SYS(lseek),
    SCMP_SYS(close), SCMP_SYS(dup), SCMP_SYS(getdents64),
    // Writes to what is open: /dev/null, the socket and shared memory, as nothing else can be
    // opened for writing, and no file may grow (RLIMIT_FSIZE).
    SCMP_SYS(write), SCMP_SYS(writev),
    // The state of files, by which libraries choose how to read. Nothing changes.
    SCMP_SYS(stat), SCMP_SYS(fstat), SCMP_SYS(lstat), SCMP_SYS(newfstatat), SCMP_SYS(statx),
    SCMP_SYS(statfs), SCMP_SYS(fstatfs), SCMP_SYS(access), SCMP_SYS(faccessat),
    SCMP_SYS(faccessat2), SCMP_SYS(readlink), SCMP_SYS(readlinkat), SCMP_SYS(getcwd),
    // Messages of the program, which bring descriptors, and waiting for them.
    SCMP_SYS(recvmsg), SCMP_SYS(poll), SCMP_SYS(ppoll),
    // Memory of this process. What it shares with the program is meant to be written.
    SCMP_SYS(brk), SCMP_SYS(munmap), SCMP_SYS(mremap), SCMP_SYS(mprotect),
    // Threads of this process wait for each other and start.
    SCMP_SYS(futex), SCMP_SYS(set_robust_list), SCMP_SYS(rseq), SCMP_SYS(sched_yield),
    SCMP_SYS(sched_getaffinity), SCMP_SYS(gettid), SCMP_SYS(getpid), SCMP_SYS(getppid),
    SCMP_SYS(arch_prctl), SCMP_SYS(exit), SCMP_SYS(exit_group),
    // Handlers of signals, which reach this process alone.
    SCMP_SYS(rt_sigaction), SCMP_SYS(rt_sigprocmask), SCMP_SYS(rt_sigreturn), SCMP_SYS(sigaltstack),
    SCMP_SYS(restart_syscall),
    // Time, read and passed.
    SCMP_SYS(clock_gettime), SCMP_SYS(clock_getres), SCMP_SYS(clock_nanosleep), SCMP_SYS(nanosleep),
    SCMP_SYS(gettimeofday), SCMP_SYS(time), SCMP_SYS(times),
    // What the process and the machine are. Nothing changes.
    SCMP_SYS(getrlimit), SCMP_SYS(getrusage), SCMP_SYS(uname), SCMP_SYS(sysinfo),
    SCMP_SYS(getrandom), SCMP_SYS(getuid), SCMP_SYS(geteuid), SCMP_SYS(getgid), SCMP_SYS(getegid)};

/// The commands of fcntl(2) that libraries and the C library need. All others are refused: some of
/// them name a process that gets a signal of the reader's choice, which ends any process of the
/// user (F_SETOWN, F_SETOWN_EX, F_SETSIG), others make other programs wait (F_SETLEASE, F_SETLKW).
constexpr int kAllowedOnDescriptors[]{F_GETFD, F_SETFD, F_GETFL, F_DUPFD, F_DUPFD_CLOEXEC};

/// What allocators tell about memory. Others poison pages of the machine (MADV_HWPOISON, for root)
/// or cut holes into files (MADV_REMOVE).
constexpr int kAllowedAdvice[]{MADV_NORMAL,   MADV_RANDOM, MADV_SEQUENTIAL, MADV_WILLNEED,
                               MADV_DONTNEED, MADV_FREE,   MADV_HUGEPAGE,   MADV_NOHUGEPAGE};

/// A list of calls in the making.
class CallList {
  public:
    CallList() : filter_(::seccomp_init(SCMP_ACT_ERRNO(EPERM))), good_(filter_ != nullptr) {}
    ~CallList() {
        if (filter_)
            ::seccomp_release(filter_);
    }
    CallList(const CallList&) = delete;
    CallList& operator=(const CallList&) = delete;

    /// Allows a call whose arguments are so.
    template <class... Conditions>
    void allow(int call, Conditions... conditions) {
        add(SCMP_ACT_ALLOW, call, conditions...);
    }
    /// Answers a call without making it.
    void answer(int call, int error) { add(SCMP_ACT_ERRNO(static_cast<unsigned>(error)), call); }
    bool load() {
        good_ = good_ && ::seccomp_attr_set(filter_, SCMP_FLTATR_CTL_TSYNC, 1) == 0;
        return good_ && ::seccomp_load(filter_) == 0;
    }

  private:
    template <class... Conditions>
    void add(std::uint32_t action, int call, Conditions... conditions) {
        good_ = good_ && ::seccomp_rule_add(filter_, action, call, sizeof...(conditions),
                                            conditions...) == 0;
    }

    scmp_filter_ctx filter_;
    bool good_;
};

constexpr scmp_datum_t datum(int number) {
    return static_cast<scmp_datum_t>(number);
}

bool refuse_all_other_calls() {
    CallList calls;
    for (const int call : kAllowed)
        calls.allow(call);
    constexpr int kToWrite = O_WRONLY | O_RDWR | O_CREAT | O_TRUNC;
    calls.allow(SCMP_SYS(open), SCMP_A1(SCMP_CMP_MASKED_EQ, kToWrite, 0));
    calls.allow(SCMP_SYS(openat), SCMP_A2(SCMP_CMP_MASKED_EQ, kToWrite, 0));
    // Answers go where the socket is connected. Not sendmsg: it sends descriptors, too, and those
    // on their way count for the user, whose other programs could send none then.
    calls.allow(SCMP_SYS(sendto), SCMP_A4(SCMP_CMP_EQ, 0));
    for (const int command : kAllowedOnDescriptors)
        calls.allow(SCMP_SYS(fcntl), SCMP_A1(SCMP_CMP_EQ, datum(command)));
    // A descriptor with O_ASYNC sends signals.
    calls.allow(SCMP_SYS(fcntl), SCMP_A1(SCMP_CMP_EQ, F_SETFL),
                SCMP_A2(SCMP_CMP_MASKED_EQ, O_ASYNC, 0));
    for (const int advice : kAllowedAdvice)
        calls.allow(SCMP_SYS(madvise), SCMP_A2(SCMP_CMP_EQ, datum(advice)));
    // A lock makes other programs wait or fail. Libraries hear that they have it; whether another
    // program writes the file is for the program to find out (see ReaderProcess).
    calls.answer(SCMP_SYS(flock), 0);
    // Memory that processes share counts against no limit: only what the program sends is mapped so.
    constexpr scmp_datum_t kShared = MAP_SHARED, kOfNoFile = MAP_ANONYMOUS;
    for (const scmp_datum_t kind : {scmp_datum_t{0}, kShared, kOfNoFile})
        calls.allow(SCMP_SYS(mmap), SCMP_A3(SCMP_CMP_MASKED_EQ, kShared | kOfNoFile, kind));
    // Limits are read only: the program sets them from outside (see ReaderBudget).
    calls.allow(SCMP_SYS(prlimit64), SCMP_A0(SCMP_CMP_EQ, 0), SCMP_A2(SCMP_CMP_EQ, 0));
    // Signals only to this process, as abort() sends.
    calls.allow(SCMP_SYS(tgkill), SCMP_A0(SCMP_CMP_EQ, datum(::getpid())));
    // Threads only by the older call, whose flags a filter can check; clone3 fails as unknown.
    constexpr scmp_datum_t kThread = 0x00010000, // CLONE_THREAD
        kFlagsOfThreads = 0x003d0f00;            // the flags that the C library gives
    calls.allow(SCMP_SYS(clone), SCMP_A0(SCMP_CMP_MASKED_EQ, ~kFlagsOfThreads | kThread, kThread));
    calls.answer(SCMP_SYS(clone3), ENOSYS);
    return calls.load();
}

#else

bool refuse_all_other_calls() {
    return true; // this build has no libseccomp, as `isochron --version` says
}

#endif

} // namespace

std::string_view fence_in(std::span<const std::filesystem::path> readable) {
    if (::prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0) != 0)
        return "to take its privileges away (PR_SET_NO_NEW_PRIVS)";
    const struct rlimit none {};
    for (const auto resource : {RLIMIT_CORE, RLIMIT_FSIZE})
        if (::setrlimit(resource, &none) != 0)
            return "its limits of files (setrlimit)";
    if (!hide_files(readable))
        return "to hide files from it (Landlock)";
    if (!refuse_all_other_calls())
        return "its list of system calls (seccomp)";
    return {};
}

} // namespace isochron::index
