// Data to explore: an index, or files of values that are indexed while they are shown.
#include "app/explore/explored_data.h"

#include "app/command_line/cancel.h"
#include "app/config/series_names.h"
#include "app/config/user_folders.h"
#include "app/indexing/file_patterns.h"
#include "app/indexing/kept_index.h"
#include "app/session/data_choice.h"
#include "index/file/index_series.h"

#include <fmt/format.h>

#include <filesystem>
#include <utility>

namespace isochron::app {
namespace {

namespace fs = std::filesystem;

/// Most steps that are waited for: the step to start at, and all steps before it.
std::size_t awaited_steps(const ExploreOptions& options) {
    return std::size_t{options.step.value_or(0)} + 1;
}

} // namespace

bool is_index_name(const std::vector<std::string>& files) {
    std::error_code ignored;
    if (files.size() != 1)
        return false;
    if (!fs::exists(files.front(), ignored))
        return !is_pattern(files.front());
    return fs::path(files.front()).extension() == ".isochron" || index::is_index(files.front());
}

ExploreOptions with_index(ExploreOptions options) {
    options.sources = with_path_within(std::move(options.sources));
    let_read_allowed(options.sources);
    const std::vector<std::string>& files = options.sources.files;
    if (files.empty() || options.test_pattern)
        return options;
    options.data_name = files.front();
    if (is_index_name(files))
        options.data = files.front();
    return options;
}

std::unique_ptr<Indexing> begin_indexing(const ExploreOptions& options, const ClusterJob& job) {
    if (options.data || options.sources.files.empty())
        return nullptr;
    if (job.size() > 1)
        throw UsageError(fmt::format("{}: no index, which a job of several processes needs: "
                                     "isochron build makes one",
                                     options.sources.files.front()));
    const auto folder = user_cache_folder();
    if (!folder)
        throw UsageError("no folder for indexes: neither HOME nor XDG_CACHE_HOME is set; "
                         "isochron build makes an index anywhere");
    auto indexing = std::make_unique<Indexing>(options.sources, *folder);
    // Nearly all data that cannot be read are refused here, before a window opens for them.
    indexing->wait_for_opening(std::chrono::milliseconds(500));
    indexing->check();
    return indexing;
}

std::optional<std::string> wait_for_index(const Indexing& indexing, const stereo::Windows& windows,
                                          const ExploreOptions& options, const Config& config) {
    const auto progress = [&] {
        const Indexing::State now = indexing.state();
        const std::size_t wanted = awaited_steps(options);
        return DataProgress{now.done || (now.index && now.steps >= wanted) ||
                                (now.of > 0 && now.index && wanted > now.of),
                            now.line(), static_cast<float>(now.fraction)};
    };
    if (!wait_for_data(windows, fs::path(options.data_name).filename().string(), progress,
                       {.ended = [] { return CancelOnSignal::received() != 0; },
                        .background = config.rendering.background,
                        .frame_rate_limit = config.rendering.frame_rate_limit,
                        .font_scale = config.panel.font_scale}))
        return std::nullopt;
    const Indexing::State now = indexing.state();
    if (!now.index)
        indexing.check();
    return now.index->string();
}

std::optional<std::string> name_to_remember(const ExploreOptions& options) {
    if (options.data == options.data_name)
        return options.data;
    if (!has_no_options(options.sources))
        return std::nullopt;
    const auto name = one_name_of(expand_patterns(options.sources.files));
    return name ? std::optional(name->string()) : std::nullopt;
}

ExploreOptions with_data(ExploreOptions options, const std::string& data) {
    options.sources = {};
    options.sources.files = {data};
    options.data.reset();
    options.isovalue.reset();
    options.step.reset();
    options.session.reset();
    options.report.reset();
    options.resume = false;
    return with_index(std::move(options));
}

} // namespace isochron::app
