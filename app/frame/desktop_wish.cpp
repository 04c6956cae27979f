// Gives a folder to the desktop.
#include "app/frame/desktop_wish.h"

#include <algorithm>
#include <cstdlib>
#include <sstream>
#include <thread>

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

namespace isochron::app {
namespace {

constexpr const char* kOpener = "xdg-open";

} // namespace

std::optional<std::filesystem::path> path_in(std::string_view message) {
    const std::size_t space = message.find(" /");
    if (space == message.npos)
        return std::nullopt;
    std::string_view path = message.substr(space + 1);
    for (const std::string_view end : {": ", " and "})
        path = path.substr(0, path.find(end));
    return std::filesystem::path(path);
}

bool can_open_folders() {
    static const bool can = [] {
        const char* const path = std::getenv("PATH");
        std::istringstream folders(path ? path : "");
        for (std::string folder; std::getline(folders, folder, ':');)
            if (access((folder + "/" + kOpener).c_str(), X_OK) == 0)
                return true;
        return false;
    }();
    return can;
}

void open_folder(const std::filesystem::path& folder) {
    if (!can_open_folders())
        return;
    std::string program = kOpener, named = folder.string();
    char* const arguments[]{program.data(), named.data(), nullptr};
    posix_spawn_file_actions_t files;
    posix_spawn_file_actions_init(&files);
    posix_spawn_file_actions_addopen(&files, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
    posix_spawn_file_actions_addopen(&files, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
    posix_spawn_file_actions_addopen(&files, STDERR_FILENO, "/dev/null", O_WRONLY, 0);
    posix_spawnattr_t attributes; // an end of this program does not end the desktop's
    posix_spawnattr_init(&attributes);
    posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETSID);
    pid_t process = -1;
    const int error = posix_spawnp(&process, kOpener, &files, &attributes, arguments, environ);
    posix_spawnattr_destroy(&attributes);
    posix_spawn_file_actions_destroy(&files);
    if (error == 0) // it may stay as long as its window; somebody has to take its end
        std::thread([process] { waitpid(process, nullptr, 0); }).detach();
}

} // namespace isochron::app
