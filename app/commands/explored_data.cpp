// Data to explore that no index was made of yet.
#include "app/commands/explored_data.h"

#include "app/commands/kept_index.h"
#include "app/config/user_folders.h"
#include "index/file/index_series.h"

#include <fmt/format.h>

#include <filesystem>

namespace isochron::app {
namespace {

/// Whether that is to be shown as it is. What is no index may still be a damaged one.
bool is_shown_as_it_is(const std::string& file) {
    std::error_code ignored;
    return std::filesystem::path(file).extension() == ".isochron" ||
           !std::filesystem::exists(file, ignored) || index::is_index(file);
}

} // namespace

ExploreOptions with_index(ExploreOptions options, ClusterJob& job) {
    options.sources = with_path_within(std::move(options.sources));
    const std::vector<std::string>& files = options.sources.files;
    if (files.empty() || options.test_pattern)
        return options;
    options.data_name = files.front();
    if (files.size() == 1 && is_shown_as_it_is(files.front()) &&
        files.front().find_first_of("*?[") == std::string::npos) {
        options.data = files.front();
        return options;
    }
    job.together([&] {
        if (job.size() > 1)
            throw UsageError(fmt::format("{}: no index, which a job of several processes needs: "
                                         "isochron build makes one",
                                         files.front()));
        const auto folder = user_cache_folder();
        if (!folder)
            throw UsageError("no folder for indexes: neither HOME nor XDG_CACHE_HOME is set; "
                             "isochron build makes an index anywhere");
        options.data = kept_index(options.sources, *folder).string();
    });
    return options;
}

} // namespace isochron::app
