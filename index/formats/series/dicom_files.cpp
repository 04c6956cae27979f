// Finds DICOM files.
#include "index/formats/series/dicom_files.h"

#include "index/error.h"
#include "index/formats/series/natural_order.h"
#include "index/formats/text_header.h"
#include "index/lower_case.h"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <string>

namespace isochron::index {
namespace {

namespace fs = std::filesystem;

bool begins_like_dicom(const fs::path& path) {
    constexpr std::streamoff kPreamble = 128;
    std::ifstream file(path, std::ios::binary);
    char letters[4]{};
    return file.seekg(kPreamble) && file.read(letters, sizeof letters) &&
           std::string_view(letters, sizeof letters) == "DICM";
}

/// Disks have a file that lists the others.
bool is_directory_of_dicom(const fs::path& path) {
    return lower_case(path.filename().string()).starts_with("dicomdir");
}

} // namespace

bool is_dicom(const fs::path& path) {
    const std::string extension = lower_case(path.extension().string());
    std::error_code ignored;
    return extension == ".dcm" || extension == ".dicom" || extension == ".ima" ||
           (fs::is_regular_file(path, ignored) && begins_like_dicom(path));
}

std::vector<fs::path> with_dicom_folders(const std::vector<fs::path>& files) {
    constexpr std::size_t kMost = 1'000'000;
    std::vector<fs::path> all;
    std::error_code ignored;
    for (const fs::path& path : files) {
        std::vector<fs::path> within;
        std::size_t seen = 0;
        if (fs::is_directory(path, ignored))
            for (fs::recursive_directory_iterator at(path, ignored), end; at != end;
                 at.increment(ignored)) {
                if (++seen > kMost)
                    throw Error(fmt::format("{}: more than {} files in it", path.string(), kMost));
                if (at->is_regular_file(ignored) && !is_directory_of_dicom(at->path()) &&
                    begins_like_dicom(at->path()))
                    within.push_back(at->path());
            }
        std::ranges::sort(within, [](const fs::path& a, const fs::path& b) {
            return natural_less(a.string(), b.string());
        });
        if (within.empty())
            all.push_back(path);
        else
            all.insert(all.end(), within.begin(), within.end());
    }
    return all;
}

} // namespace isochron::index
