// Claims a session file by a lock beside it, which the system lifts however the program ends.
#include "app/kept/session_claim.h"

#include <fmt/format.h>

#include <cerrno>
#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>
#include <utility>

namespace isochron::app {
namespace {

namespace fs = std::filesystem;

/// Whether the file is still the one under this name, and not one that its owner has just removed.
bool is_under(const fs::path& path, int file) {
    struct stat ours, there;
    return fstat(file, &ours) == 0 && stat(path.c_str(), &there) == 0 &&
           ours.st_ino == there.st_ino && ours.st_dev == there.st_dev;
}

} // namespace

fs::path claim_of(const fs::path& session) {
    return session.string() + ".lock";
}

/// @return false: another program has it
bool SessionClaim::take(const fs::path& path) {
    lock_ = claim_of(path);
    for (;;) {
        file_ = open(lock_.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0600);
        if (file_ < 0)
            return true; // nothing can be written here
        if (flock(file_, LOCK_EX | LOCK_NB) != 0) {
            const bool is_taken = errno == EWOULDBLOCK;
            close(std::exchange(file_, -1));
            return !is_taken;
        }
        if (is_under(lock_, file_))
            return true;
        close(std::exchange(file_, -1));
    }
}

SessionClaim::SessionClaim(const fs::path& wanted) : path_(wanted) {
    std::error_code error; // who saves the session reports it
    fs::create_directories(wanted.parent_path(), error);
    for (int number = 1; number <= kMostWindows; ++number) {
        path_ = wanted;
        if (number > 1)
            path_.replace_filename(fmt::format("{}-{}{}", wanted.stem().string(), number,
                                               wanted.extension().string()));
        if (take(path_))
            return;
    }
    path_ = wanted;
}

SessionClaim::~SessionClaim() {
    if (file_ < 0)
        return;
    unlink(lock_.c_str()); // while it is still locked
    close(file_);
}

} // namespace isochron::app
