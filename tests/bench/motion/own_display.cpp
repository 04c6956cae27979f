// Starts Xvfb.
#include "tests/bench/motion/own_display.h"

#include "index/error.h"

#include <cstdlib>
#include <string>

#include <csignal>
#include <fcntl.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

namespace isochron::bench {

OwnDisplay::OwnDisplay() {
    int ends[2];
    if (::pipe2(ends, O_CLOEXEC) != 0)
        throw index::Error("no pipe to Xvfb");
    server_ = ::fork();
    if (server_ == 0) {
        ::prctl(PR_SET_PDEATHSIG, SIGTERM); // it ends with the benchmark in any case
        ::dup2(::open("/dev/null", O_WRONLY), STDERR_FILENO);
        ::dup2(ends[1], STDOUT_FILENO);
        ::execlp("Xvfb", "Xvfb", "-displayfd", "1", "-screen", "0", "1920x1200x24", "-nolisten",
                 "tcp", "-noreset", static_cast<char*>(nullptr));
        ::_exit(127);
    }
    ::close(ends[1]);
    std::string number;
    for (char c = 0; ::read(ends[0], &c, 1) == 1 && c != '\n';)
        number += c;
    ::close(ends[0]);
    if (server_ < 0 || number.empty()) {
        if (server_ > 0)
            ::waitpid(server_, nullptr, 0);
        throw index::Error("windows are measured on a display of their own: Xvfb did not start");
    }
    ::setenv("DISPLAY", (":" + number).c_str(), 1);
}

OwnDisplay::~OwnDisplay() {
    ::unsetenv("DISPLAY");
    ::kill(server_, SIGTERM);
    ::waitpid(server_, nullptr, 0);
}

} // namespace isochron::bench
