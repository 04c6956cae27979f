// Runs work in a child process, which sends its result through a pipe.
#include "tests/bench/measures/child.h"

#include "index/error.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <string_view>

#include <poll.h>
#include <sys/wait.h>
#include <unistd.h>

namespace isochron::bench {

namespace {

constexpr int kFailed = 1;
constexpr int kLookMs = 200; ///< between two checks whether the user cancels

[[noreturn]] void run(const std::function<std::string()>& work, int out) {
    std::string answer;
    int status = 0;
    try {
        answer = work();
    } catch (const app::Canceled& canceled) {
        status = canceled.status;
    } catch (const std::exception& error) {
        answer = error.what();
        status = kFailed;
    }
    for (std::string_view rest = answer; !rest.empty();) {
        const ssize_t written = write(out, rest.data(), rest.size());
        if (written < 0 && errno != EINTR)
            _exit(kFailed);
        rest.remove_prefix(static_cast<std::size_t>(std::max<ssize_t>(written, 0)));
    }
    std::fflush(stderr);
    _exit(status); // does not run the parent's destructors
}

/// The child process and the reading end of its pipe; both end with this object.
class Child {
  public:
    explicit Child(const std::function<std::string()>& work) {
        std::array<int, 2> ends{};
        if (pipe(ends.data()) != 0)
            throw index::Error("no pipe to a child process: {}", std::strerror(errno));
        std::fflush(nullptr); // else both processes would print what is still buffered
        process_ = fork();
        if (process_ == 0) {
            close(ends[0]);
            run(work, ends[1]);
        }
        close(ends[1]);
        in_ = ends[0];
        if (process_ < 0) {
            close(in_);
            throw index::Error("no child process: {}", std::strerror(errno));
        }
    }
    ~Child() {
        if (process_ > 0) {
            kill(process_, SIGTERM);
            wait();
        }
        close(in_);
    }
    Child(const Child&) = delete;
    Child& operator=(const Child&) = delete;

    /// Reads everything that the child writes, until it closes its end.
    std::string read_all(const app::CancelOnSignal& signals) {
        std::string all;
        std::array<char, 4096> part{};
        for (;;) {
            signals.check();
            pollfd ready{in_, POLLIN, 0};
            if (poll(&ready, 1, kLookMs) <= 0) // a signal ends poll, but would not end read
                continue;
            const ssize_t count = read(in_, part.data(), part.size());
            if (count == 0)
                return all;
            if (count > 0)
                all.append(part.data(), static_cast<std::size_t>(count));
            else if (errno != EINTR)
                throw index::Error("a child process: {}", std::strerror(errno));
        }
    }

    /// The child's status, from waitpid.
    int wait() {
        int status = 0;
        while (waitpid(process_, &status, 0) < 0 && errno == EINTR)
            ;
        process_ = -1;
        return status;
    }

  private:
    pid_t process_ = -1;
    int in_ = -1;
};

} // namespace

std::string in_child(const std::function<std::string()>& work, const app::CancelOnSignal& signals) {
    Child child(work);
    std::string answer = child.read_all(signals);
    const int status = child.wait();
    signals.check();
    if (WIFSIGNALED(status))
        throw index::Error("a child process ended with signal {}", WTERMSIG(status));
    if (WEXITSTATUS(status) != 0)
        throw index::Error(answer);
    return answer;
}

} // namespace isochron::bench
