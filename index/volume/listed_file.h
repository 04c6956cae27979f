// A file that a list of files names.
#pragma once

#include <filesystem>
#include <string>
#include <tuple>
#include <vector>

namespace isochron::index {

struct ListedFile {
    std::filesystem::path path; ///< relative to where the program runs
    double time = 0;
    std::string part = {}; ///< which part of the volume of its time it is, if the list says so

    auto fields() { return std::tie(path, time, part); }
    auto fields() const { return std::tie(path, time, part); }
};

/// As the list has them, from its beginning.
using ListedFiles = std::vector<ListedFile>;

} // namespace isochron::index
