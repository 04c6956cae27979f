// Runs a program as a child process in a given folder.
#include "tests/support/child_process.h"

#include <array>
#include <cerrno>
#include <csignal>
#include <fstream>
#include <stdexcept>

#include <fcntl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

namespace isochron::app {
namespace fs = std::filesystem;

namespace {

std::string file_contents(const fs::path& path) {
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
}

[[noreturn]] void become(const std::string& program, const std::vector<std::string>& arguments,
                         const fs::path& folder, const fs::path& out, int err,
                         const ChildOptions& options) {
    std::vector<char*> argv{const_cast<char*>(program.c_str())};
    for (const std::string& argument : arguments)
        argv.push_back(const_cast<char*>(argument.c_str()));
    argv.push_back(nullptr);
    const int file = ::open(out.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0666);
    if (::chdir(folder.c_str()) == 0 && file >= 0) {
        ::dup2(file, STDOUT_FILENO);
        ::dup2(err, STDERR_FILENO);
        if (options.largest_file > 0) {
            const struct rlimit limit{options.largest_file, options.largest_file};
            ::setrlimit(RLIMIT_FSIZE, &limit);
            ::signal(SIGXFSZ, SIG_IGN); // so that a write fails, without a signal
        }
        ::alarm(static_cast<unsigned>(options.dies_after.count())); // stays active after exec
        for (const std::string& variable : options.environment)
            ::putenv(const_cast<char*>(variable.c_str()));
        for (const int stream : options.closed)
            ::close(stream);
        ::execv(program.c_str(), argv.data());
    }
    ::_exit(127);
}

} // namespace

ChildResult run_child(const std::string& program, const std::vector<std::string>& arguments,
                      const fs::path& folder, const ChildOptions& options) {
    const TestFolder captured; // not the child's folder, whose contents tests check
    const fs::path out = options.out.empty() ? captured.path() / "out" : fs::path(options.out);
    std::array<int, 2> pipe{};
    if (::pipe2(pipe.data(), O_CLOEXEC) != 0)
        throw std::runtime_error("no pipe");
    const pid_t child = ::fork();
    if (child < 0)
        throw std::runtime_error("no child process");
    if (child == 0)
        become(program, arguments, folder, out, pipe[1], options);
    ::close(pipe[1]);

    ChildResult result;
    bool interrupted = options.interrupt_after.empty();
    std::array<char, 4096> buffer;
    for (;;) {
        const ssize_t got = ::read(pipe[0], buffer.data(), buffer.size());
        if (got < 0 && errno == EINTR)
            continue;
        if (got <= 0)
            break;
        result.err.append(buffer.data(), static_cast<std::size_t>(got));
        if (!interrupted && result.err.find(options.interrupt_after) != std::string::npos) {
            ::kill(child, SIGINT);
            interrupted = true;
        }
    }
    ::close(pipe[0]);
    int status = 0;
    while (::waitpid(child, &status, 0) < 0 && errno == EINTR) {
    }
    result.status = WIFEXITED(status) ? WEXITSTATUS(status) : 1000 + WTERMSIG(status);
    if (options.out.empty())
        result.out = file_contents(out);
    return result;
}

std::vector<std::string> of_processes(std::size_t count, const std::vector<std::string>& command) {
    // The MPI library leaks. Looking for graphics cards it connects to all displays of this machine, also
    // to those of other tests, and ends where one of them does.
    std::vector<std::string> arguments{
        "ASAN_OPTIONS=detect_leaks=0", "HWLOC_COMPONENTS=-gl", "mpirun",
        "--allow-run-as-root",         "--oversubscribe",      "-n",
        std::to_string(count)};
    arguments.insert(arguments.end(), command.begin(), command.end());
    return arguments;
}

} // namespace isochron::app
