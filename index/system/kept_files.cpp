// Removes kept files that were not used for long.
#include "index/system/kept_files.h"

#include <algorithm>
#include <system_error>
#include <vector>

namespace isochron::index {

namespace fs = std::filesystem;

void make_room(const fs::path& folder, std::string_view extension, const fs::path& stays,
               const KeptMost& most) {
    struct Kept {
        fs::file_time_type used;
        std::uint64_t bytes;
        fs::path path;
    };
    std::error_code error;
    std::vector<Kept> kept;
    std::uint64_t bytes = 0;
    for (const auto& entry : fs::directory_iterator(folder, error)) {
        if (entry.path().extension() != extension || !entry.is_regular_file(error))
            continue;
        kept.push_back({entry.last_write_time(error), entry.file_size(error), entry.path()});
        bytes += kept.back().bytes;
    }
    std::ranges::sort(kept, {}, &Kept::used);
    std::size_t files = kept.size();
    for (const Kept& each : kept) {
        if (files <= most.files && bytes <= most.bytes)
            return;
        if (each.path != stays && fs::remove(each.path, error)) {
            bytes -= each.bytes;
            --files;
        }
    }
}

} // namespace isochron::index
