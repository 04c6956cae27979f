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
    std::string part = {}; ///< the part of the volume at its time, if the list says so

    auto fields() { return std::tie(path, time, part); }
    auto fields() const { return std::tie(path, time, part); }
};

/// The files of a list, in its order.
using ListedFiles = std::vector<ListedFile>;

} // namespace isochron::index
