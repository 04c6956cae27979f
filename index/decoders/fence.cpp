// The fence: a list of allowed system calls, enforced by seccomp(2).
#include "index/decoders/fence.h"

#ifdef ISOCHRON_WITH_SECCOMP
#include <seccomp.h>
#endif

#include <fcntl.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <unistd.h>

#include <cerrno>
#include <initializer_list>

namespace isochron::index {
namespace {

#ifdef ISOCHRON_WITH_SECCOMP

/// The calls that reading, computing and answering need.
constexpr int kAllowed[]{
    // reading open files, and the state of other files
    SCMP_SYS(read), SCMP_SYS(pread64), SCMP_SYS(readv), SCMP_SYS(preadv), SCMP_SYS(lseek),
    SCMP_SYS(write), SCMP_SYS(writev), SCMP_SYS(close), SCMP_SYS(stat), SCMP_SYS(fstat),
    SCMP_SYS(lstat), SCMP_SYS(newfstatat), SCMP_SYS(statx), SCMP_SYS(statfs), SCMP_SYS(fstatfs),
    SCMP_SYS(access), SCMP_SYS(faccessat), SCMP_SYS(faccessat2), SCMP_SYS(readlink),
    SCMP_SYS(readlinkat), SCMP_SYS(getcwd), SCMP_SYS(getdents64), SCMP_SYS(flock),
    SCMP_SYS(fadvise64), SCMP_SYS(readahead), SCMP_SYS(dup),
    // the socket
    SCMP_SYS(sendmsg), SCMP_SYS(recvmsg), SCMP_SYS(poll), SCMP_SYS(ppoll),
    // memory
    SCMP_SYS(brk), SCMP_SYS(mmap), SCMP_SYS(munmap), SCMP_SYS(mremap), SCMP_SYS(mprotect),
    SCMP_SYS(madvise), SCMP_SYS(mincore),
    // threads, signals and time
    SCMP_SYS(futex), SCMP_SYS(set_robust_list), SCMP_SYS(rseq), SCMP_SYS(sched_yield),
    SCMP_SYS(sched_getaffinity), SCMP_SYS(gettid), SCMP_SYS(getpid), SCMP_SYS(getppid),
    SCMP_SYS(rt_sigaction), SCMP_SYS(rt_sigprocmask), SCMP_SYS(rt_sigreturn), SCMP_SYS(sigaltstack),
    SCMP_SYS(restart_syscall), SCMP_SYS(clock_gettime), SCMP_SYS(clock_getres),
    SCMP_SYS(clock_nanosleep), SCMP_SYS(nanosleep), SCMP_SYS(gettimeofday), SCMP_SYS(time),
    SCMP_SYS(exit), SCMP_SYS(exit_group),
    // information on the process and the machine
    SCMP_SYS(getrlimit), SCMP_SYS(setrlimit), SCMP_SYS(getrusage), SCMP_SYS(times), SCMP_SYS(uname),
    SCMP_SYS(sysinfo), SCMP_SYS(getrandom), SCMP_SYS(getuid), SCMP_SYS(geteuid), SCMP_SYS(getgid),
    SCMP_SYS(getegid), SCMP_SYS(arch_prctl)};

/// The commands of fcntl(2) that libraries and the C library need. All others are refused: some of
/// them name a process that gets a signal of the reader's choice, which ends any process of the
/// user (F_SETOWN, F_SETOWN_EX, F_SETSIG), others make other programs wait (F_SETLEASE, F_SETLKW).
constexpr int kAllowedOnDescriptors[]{F_GETFD, F_SETFD, F_GETFL, F_DUPFD, F_DUPFD_CLOEXEC};

bool allow_fcntl(scmp_filter_ctx filter) {
    bool good = true;
    for (const int command : kAllowedOnDescriptors)
        good &= ::seccomp_rule_add(filter, SCMP_ACT_ALLOW, SCMP_SYS(fcntl), 1,
                                   SCMP_A1(SCMP_CMP_EQ, static_cast<scmp_datum_t>(command))) == 0;
    // A descriptor with O_ASYNC sends signals.
    return good && ::seccomp_rule_add(filter, SCMP_ACT_ALLOW, SCMP_SYS(fcntl), 2,
                                      SCMP_A1(SCMP_CMP_EQ, F_SETFL),
                                      SCMP_A2(SCMP_CMP_MASKED_EQ, O_ASYNC, 0)) == 0;
}

bool refuse_all_other_calls() {
    const scmp_filter_ctx filter = ::seccomp_init(SCMP_ACT_ERRNO(EPERM));
    if (!filter)
        return false;
    bool good = true;
    for (const int call : kAllowed)
        good &= ::seccomp_rule_add(filter, SCMP_ACT_ALLOW, call, 0) == 0;
    constexpr int kToWrite = O_WRONLY | O_RDWR | O_CREAT | O_TRUNC;
    good &= ::seccomp_rule_add(filter, SCMP_ACT_ALLOW, SCMP_SYS(open), 1,
                               SCMP_A1(SCMP_CMP_MASKED_EQ, kToWrite, 0)) == 0;
    good &= ::seccomp_rule_add(filter, SCMP_ACT_ALLOW, SCMP_SYS(openat), 1,
                               SCMP_A2(SCMP_CMP_MASKED_EQ, kToWrite, 0)) == 0;
    good &= allow_fcntl(filter);
    // Limits only of this process: a limit of time ends any other process of the user.
    good &= ::seccomp_rule_add(filter, SCMP_ACT_ALLOW, SCMP_SYS(prlimit64), 1,
                               SCMP_A0(SCMP_CMP_EQ, 0)) == 0;
    // Signals only to this process, as abort() sends.
    good &= ::seccomp_rule_add(filter, SCMP_ACT_ALLOW, SCMP_SYS(tgkill), 1,
                               SCMP_A0(SCMP_CMP_EQ, static_cast<scmp_datum_t>(::getpid()))) == 0;
    // Threads only by the older call, whose flags a filter can check; clone3 fails as unknown.
    constexpr scmp_datum_t kThread = 0x00010000; // CLONE_THREAD
    good &= ::seccomp_rule_add(filter, SCMP_ACT_ALLOW, SCMP_SYS(clone), 1,
                               SCMP_A0(SCMP_CMP_MASKED_EQ, kThread, kThread)) == 0;
    good &= ::seccomp_rule_add(filter, SCMP_ACT_ERRNO(ENOSYS), SCMP_SYS(clone3), 0) == 0;
    good &= ::seccomp_attr_set(filter, SCMP_FLTATR_CTL_TSYNC, 1) == 0;
    good = good && ::seccomp_load(filter) == 0;
    ::seccomp_release(filter);
    return good;
}

#else

bool refuse_all_other_calls() {
    return true; // this build has no libseccomp, as `isochron --version` says
}

#endif

} // namespace

bool fence_in() {
    bool good = ::prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0) == 0;
    const struct rlimit none {};
    for (const auto resource : {RLIMIT_CORE, RLIMIT_FSIZE})
        good &= ::setrlimit(resource, &none) == 0;
    return refuse_all_other_calls() && good;
}

} // namespace isochron::index
