// A folder in which files of this process alone lie until they have their names.
#include "index/system/temporary/temporary_folder.h"

#include "index/error.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

namespace isochron::index {
namespace fs = std::filesystem;

TemporaryFolder::TemporaryFolder(const fs::path& beside, std::string contents)
    : contents_(std::move(contents)) {
    remove_remains_in(beside.has_parent_path() ? beside.parent_path() : fs::path("."));
    constexpr int kMostTries = 1000;
    for (int tries = 0; path_.empty(); ++tries) {
        fs::path path = temporary_name_of(beside);
        if (::mkdir(path.c_str(), 0700) == 0)
            path_ = std::move(path);
        else if (errno != EEXIST || tries == kMostTries)
            throw Error("{}: cannot be written: {}", beside.string(), std::strerror(errno));
    }
    lock_ = Descriptor(::open(path_.c_str(), O_RDONLY | O_DIRECTORY | O_NOFOLLOW | O_CLOEXEC));
    if (!lock_) {
        const int error = errno;
        ::rmdir(path_.c_str());
        throw Error("{}: cannot be written: {}", beside.string(), std::strerror(error));
    }
    ::flock(lock_.number(), LOCK_EX | LOCK_NB);
    entry_ = LedgerEntry(path_, lock_.number(), contents_);
}

TemporaryFolder::~TemporaryFolder() {
    remove_temporary(path_.c_str(), lock_.number(), contents_);
}

std::error_code TemporaryFolder::take_name(const fs::path& name) {
    // What rights a new folder has only a new folder tells: masks of the process, lists of the folder.
    const fs::path sample = path_ / contents_;
    struct stat status{};
    std::error_code error;
    if (::mkdir(sample.c_str(), 0777) != 0 || ::stat(sample.c_str(), &status) != 0 ||
        ::rmdir(sample.c_str()) != 0 || ::fchmod(lock_.number(), status.st_mode & 07777) != 0)
        return {errno, std::system_category()};
    fs::rename(path_, name, error);
    if (error)
        ::fchmod(lock_.number(), 0700);
    else
        entry_ = LedgerEntry();
    return error;
}

} // namespace isochron::index
