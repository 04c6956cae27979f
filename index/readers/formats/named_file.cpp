// Resolves paths that stand in files.
#include "index/readers/formats/named_file.h"

#include <algorithm>
#include <system_error>

namespace isochron::index {
namespace fs = std::filesystem;

std::string path_named_in(const fs::path& file, std::string path) {
    std::error_code ignored;
    if (path.find('\\') != path.npos && !fs::exists(file.parent_path() / path, ignored))
        std::ranges::replace(path, '\\', '/');
    return path;
}

fs::path file_named_in(const fs::path& file, const std::string& path) {
    return file.parent_path() / path_named_in(file, path);
}

} // namespace isochron::index
