// An index that a command is given.
#include "app/commands/open_index.h"

#include "app/text.h"
#include "index/error.h"

#include <fmt/format.h>

namespace isochron::app {

std::shared_ptr<const index::IndexFile> open_index(const std::filesystem::path& path) {
    try {
        return index::IndexFile::open(path);
    } catch (const index::Error& error) {
        std::error_code ignored;
        if (path.extension() == ".isochron" || !std::filesystem::is_regular_file(path, ignored))
            throw;
        std::filesystem::path made = path;
        made.replace_extension(".isochron");
        throw index::Error(fmt::format("{}; `isochron build {} -o {}` makes an index of data",
                                       error.what(), path.string(), made.string()));
    }
}

void warn_beyond(double isovalue, const index::IndexFile& file) {
    const index::IndexStats& stats = file.stats();
    if (isovalue < stats.low || isovalue > stats.high)
        fmt::print(stderr, "isochron: isovalue {} lies beyond the data, {} to {}{}\n",
                   human_number(isovalue), human_number(stats.low), human_number(stats.high),
                   with_space(file.info().value_unit));
}

} // namespace isochron::app
