// A folder in which files of this process alone lie until they have their names.
#include "index/system/temporary_folder.h"

#include "index/error.h"
#include "index/system/new_file.h"

#include <fmt/format.h>

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>

#include <cerrno>
#include <cstring>

namespace isochron::index {
namespace fs = std::filesystem;

TemporaryFolder::TemporaryFolder(const fs::path& beside) {
    remove_remains_in(beside.has_parent_path() ? beside.parent_path() : fs::path("."));
    constexpr int kMostTries = 1000;
    for (int tries = 0; path_.empty(); ++tries) {
        const fs::path path = temporary_name_of(beside);
        if (::mkdir(path.c_str(), 0700) == 0)
            path_ = path;
        else if (errno != EEXIST || tries == kMostTries)
            throw Error(
                fmt::format("{}: cannot be written: {}", beside.string(), std::strerror(errno)));
    }
    lock_ = Descriptor(::open(path_.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
    ::flock(lock_.number(), LOCK_EX | LOCK_NB);
}

TemporaryFolder::~TemporaryFolder() {
    std::error_code ignored;
    fs::remove_all(path_, ignored);
}

} // namespace isochron::index
