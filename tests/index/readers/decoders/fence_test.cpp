// The sandbox around a reader: what it blocks, and what it allows.
#include "index/readers/decoders/fence.h"

#include "tests/support/test_folder.h"

#include <gtest/gtest.h>

#include <fcntl.h>
#include <signal.h>
#include <sys/ioctl.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <unistd.h>

#include <cerrno>
#include <string>
#include <thread>

// A sanitizer makes calls of its own that the fence refuses: there readers go without it.
#ifndef ISOCHRON_SANITIZED

namespace isochron::index {
namespace {

bool refused(long result) {
    return result < 0 && errno == EPERM;
}

/// The number of the first claim that does not hold; 0 when all do.
int first_that_fails(const std::string& file) {
    const int open = ::open(file.c_str(), O_RDONLY | O_CLOEXEC);
    const std::filesystem::path readable[]{file};
    if (open < 0 || !fence_in(readable).empty())
        return 1;
    struct rlimit limit {};
    ::getrlimit(RLIMIT_CPU, &limit);
    const f_owner_ex owner{F_OWNER_PID, ::getppid()};
    struct flock lock {};
    lock.l_type = F_RDLCK;
    int on = 1;
    char name[] = "true";
    char* const arguments[]{name, nullptr};
    int claim = 2;
    for (const bool holds : {
             refused(::socket(AF_INET, SOCK_STREAM, 0)),
             refused(::socket(AF_UNIX, SOCK_STREAM, 0)),
             refused(::open(file.c_str(), O_WRONLY)),
             refused(::open(file.c_str(), O_RDWR)),
             refused(::open((file + "2").c_str(), O_RDONLY | O_CREAT, 0600)),
             refused(::open(file.c_str(), O_RDONLY | O_TRUNC)),
             refused(::unlink(file.c_str())),
             refused(::rename(file.c_str(), "elsewhere")),
             refused(::truncate(file.c_str(), 0)),
             refused(::chmod(file.c_str(), 0)),
             refused(::execv("/bin/true", arguments)),
             refused(::kill(::getppid(), 0)),
             refused(::prlimit(::getppid(), RLIMIT_CPU, nullptr, &limit)),
             refused(::prlimit(::getppid(), RLIMIT_CPU, &limit, nullptr)),
             refused(::fcntl(open, F_SETOWN, ::getppid())),
             refused(::fcntl(open, F_SETOWN_EX, &owner)),
             refused(::fcntl(open, F_SETSIG, SIGKILL)),
             refused(::fcntl(open, F_SETFL, O_ASYNC)),
             refused(::fcntl(open, F_SETFL, O_ASYNC | O_NONBLOCK)),
             refused(::ioctl(open, FIOASYNC, &on)),
             refused(::ioctl(open, FIOSETOWN, &owner.pid)),
             refused(::fcntl(open, F_SETLEASE, F_RDLCK)),
             refused(::fcntl(open, F_SETLK, &lock)),
             refused(::fcntl(open, F_NOTIFY, DN_MODIFY)),
             refused(::fork()),
             ::open(file.c_str(), O_RDONLY) >= 0,
             ::getrlimit(RLIMIT_CPU, &limit) == 0,
             refused(::setrlimit(RLIMIT_CPU, &limit)),
             refused(::prlimit(0, RLIMIT_CPU, &limit, nullptr)),
             ::fcntl(open, F_GETFD) == FD_CLOEXEC,
             ::fcntl(open, F_SETFD, FD_CLOEXEC) == 0,
             ::fcntl(open, F_SETFL, ::fcntl(open, F_GETFL) | O_NONBLOCK) == 0,
             ::fcntl(open, F_DUPFD_CLOEXEC, 0) >= 0,
             ::mmap(nullptr, 1 << 20, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0) !=
                 MAP_FAILED,
         }) {
        if (!holds)
            return claim;
        ++claim;
    }
    std::thread([] {}).join();
    return 0;
}

TEST(Fence, KeepsOutAllButReading) {
    const test_support::TestFolder folder;
    const std::string file = folder.write("file", "content").string();
    EXPECT_EXIT(::_exit(first_that_fails(file)), testing::ExitedWithCode(0), "");
    EXPECT_EQ(folder.read("file"), "content");
    EXPECT_EQ(folder.names(), std::vector<std::string>{"file"});
}

} // namespace
} // namespace isochron::index

#endif
