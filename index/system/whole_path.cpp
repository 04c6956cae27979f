// Paths as they are on the disk.
#include "index/system/whole_path.h"

#include <algorithm>
#include <system_error>

namespace isochron::index {

namespace fs = std::filesystem;

fs::path whole_path(const fs::path& path) {
    std::error_code error;
    const fs::path full = fs::absolute(path, error);
    fs::path whole = fs::weakly_canonical(full, error);
    return error || whole.empty() ? full.lexically_normal() : whole;
}

bool lies_within(const fs::path& file, const fs::path& folder) {
    return std::ranges::mismatch(folder, file).in1 == folder.end();
}

} // namespace isochron::index
