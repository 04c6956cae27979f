// The whole program in a window, and a user who presses its keys.
#pragma once

#include "tests/support/session_fixture.h"

#include "tests/support/as_words.h"
#include "tests/support/eventually.h"
#include "tests/support/paths.h"
#include "tests/support/virtual_display.h"

#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <system_error>
#include <vector>

#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

namespace isochron::app {

/// The built program, run with arguments and awaited.
class Program {
  public:
    explicit Program(std::vector<std::string> arguments) {
        arguments.insert(arguments.begin(), test_support::binary_root() + "/isochron");
        std::vector<char*> argv;
        for (std::string& argument : arguments)
            argv.push_back(argument.data());
        argv.push_back(nullptr);
        EXPECT_EQ(posix_spawn(&pid_, argv[0], nullptr, nullptr, argv.data(), environ), 0);
    }
    pid_t pid() const { return pid_; }
    /// Whether it has not ended yet.
    bool runs() const {
        siginfo_t ended{};
        return waitid(P_PID, static_cast<id_t>(pid_), &ended, WEXITED | WNOHANG | WNOWAIT) == 0 &&
               ended.si_pid == 0;
    }
    void signal(int number) const { kill(pid_, number); }
    int exit_status() const {
        int status = 0;
        waitpid(pid_, &status, 0);
        return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
    }

  private:
    pid_t pid_ = 0;
};

class ExploreTest : public testing::Test {
  protected:
    ExploreTest() {
        build_sphere(folder_.path());
        setenv("XDG_STATE_HOME", state_.path().c_str(), 1);
        setenv("XDG_CACHE_HOME", state_.path().c_str(), 1);
    }

    std::string file(const std::string& name) const { return (folder_.path() / name).string(); }

    /// Starts the explorer, waits until its session goes on in its window, and puts the mouse into it.
    std::unique_ptr<Program> explore(std::vector<std::string> more) {
        more.insert(more.begin(), {"--size", "640", "480"});
        return explore_sized(std::move(more));
    }
    /// Explores with the size that is among `more`, or else the one that the window had last.
    std::unique_ptr<Program> explore_sized(std::vector<std::string> more) {
        std::vector<std::string> arguments{"explore", file("sphere.isochron")};
        arguments.insert(arguments.end(), more.begin(), more.end());
        const auto before = remembered();
        auto program = std::make_unique<Program>(std::move(arguments));
        screen_.xdotool(as_words("search --sync --onlyvisible --name Isochron"));
        // Before there is a session, Escape and the end of the window give it up.
        test_support::eventually([&] { return remembered() != before || !program->runs(); });
        screen_.xdotool(
            as_words("search --name Isochron windowfocus mousemove --window %1 200 200"));
        return program;
    }

    /// When the data of the newest session were put among those that were open lately.
    std::optional<std::filesystem::file_time_type> remembered() const {
        std::error_code error;
        const auto at = std::filesystem::last_write_time(state_.path() / "isochron/recent", error);
        return error ? std::nullopt : std::optional(at);
    }

    /// Escape leaves what is open, Ctrl + Q asks, Enter says yes; each has a frame of its own,
    /// however slow.
    void leave() {
        screen_.xdotool({"key", "Escape"});
        await_frame();
        screen_.xdotool({"key", "ctrl+q"});
        await_frame();
        screen_.xdotool({"key", "Return"});
    }
    /// Waits for a frame in which the explorer has seen all input up to now.
    void await_frame() const { screen_.await_frame("Isochron"); }

    /// Waits until a file has this text. @return false if it never does
    bool comes(const std::string& name, const std::string& text) const {
        return test_support::eventually(
            [&] { return folder_.read(name).find(text) != std::string::npos; });
    }

    TestFolder folder_, state_; ///< the data's, and the user's for what programs remember
    test_support::VirtualDisplay screen_;
};

} // namespace isochron::app
