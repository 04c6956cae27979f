// What readers may read: the folders of the files that the user has named.
#include "index/readers/process/readable_places.h"

#include <fmt/format.h>

#include <fcntl.h>
#include <sys/stat.h>

#include <system_error>

namespace isochron::index {
namespace fs = std::filesystem;

ReadablePlaces::Which ReadablePlaces::which(const fs::path& place) {
    struct statx status{};
    if (::statx(AT_FDCWD, place.c_str(), 0, STATX_INO | STATX_BTIME, &status) != 0)
        return {};
    return {.device = std::uint64_t{status.stx_dev_major} << 32 | status.stx_dev_minor,
            .number = status.stx_ino,
            .born = status.stx_btime.tv_sec * 1'000'000'000 + status.stx_btime.tv_nsec};
}

bool ReadablePlaces::contain_real(const fs::path& real) const {
    for (fs::path place = real;; place = place.parent_path()) {
        const auto known = places_.find(place);
        if (known != places_.end() && known->second == which(place))
            return true;
        if (place == place.parent_path())
            return false;
    }
}

void ReadablePlaces::add_real(const fs::path& real) {
    if (contain_real(real))
        return;
    places_[real] = which(real);
    ++age_;
}

void ReadablePlaces::add(const fs::path& file) {
    std::error_code error;
    const fs::path real = fs::canonical(file, error);
    if (error)
        return;
    if (fs::is_directory(real, error))
        return add_real(real);
    const fs::path folder = fs::canonical(fs::absolute(file, error).parent_path(), error);
    if (!error)
        add_real(folder);
    add_real(real); // beyond a symbolic link; else it is in its folder
}

bool ReadablePlaces::contain(const fs::path& file) const {
    std::error_code error;
    const fs::path real = fs::weakly_canonical(fs::absolute(file, error), error);
    return !error && contain_real(real);
}

std::string leads_out(const fs::path& file, const fs::path& to) {
    std::error_code error;
    const fs::path real = fs::weakly_canonical(fs::absolute(to, error), error);
    return fmt::format("{}: names {}, outside of the folders that you gave: --allow {} reads it",
                       file.string(), to.string(), (error ? to : real).parent_path().string());
}

std::vector<fs::path> ReadablePlaces::all() const {
    std::vector<fs::path> paths;
    paths.reserve(places_.size());
    for (const auto& [path, which_one] : places_)
        paths.push_back(path);
    return paths;
}

} // namespace isochron::index
