// Data to explore: an index, or files of values that are indexed while they are shown.
#include "app/explore/explored_data.h"

#include "app/config/series_names.h"
#include "app/config/user_folders.h"
#include "app/explore/loading.h"
#include "app/indexing/file_patterns.h"
#include "app/indexing/kept_index.h"
#include "app/session/data_choice.h"
#include "app/session/kept/user_memory.h"
#include "index/file/index_series.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <utility>
#include <vector>

namespace isochron::app {
namespace {

namespace fs = std::filesystem;

/// Most steps that are waited for: the step to start at, and all steps before it.
std::size_t awaited_steps(const ExploreOptions& options) {
    return std::size_t{options.step.value_or(0)} + 1;
}

std::vector<ListedArray> listed(const std::vector<ArrayOffer>& offers) {
    std::vector<ListedArray> lines;
    for (const ArrayOffer& offer : offers)
        lines.push_back({offer.name, offer.shape, offer.unit,
                         offer.range
                             ? fmt::format("{:.4g} to {:.4g}", (*offer.range)[0], (*offer.range)[1])
                             : std::string(),
                         offer.fault});
    return lines;
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

std::unique_ptr<Indexing> begin_indexing(const ExploreOptions& options, const ClusterJob& job,
                                         bool asks) {
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
    auto indexing = std::make_unique<Indexing>(options.sources, *folder, asks);
    // Nearly all data that cannot be read are refused here, before a window opens for them.
    indexing->wait_for_opening(std::chrono::milliseconds(500));
    indexing->check();
    return indexing;
}

std::optional<std::string> wait_for_index(Indexing& indexing, const stereo::Windows& windows,
                                          const ExploreOptions& options, const Config& config,
                                          bool& canceled) {
    const auto progress = [&] {
        const Indexing::State now = indexing.state();
        const std::size_t wanted = awaited_steps(options);
        return DataProgress{.ready = now.done || (now.index && now.steps >= wanted) ||
                                     (now.of > 0 && now.index && wanted > now.of),
                            .line = now.line(),
                            .fraction = static_cast<float>(now.fraction),
                            .arrays = listed(now.offers)};
    };
    // The array that the user has chosen of the same data before is chosen at the beginning.
    UserMemory memory(user_state_folder());
    const fs::path data(options.data_name);
    const auto offers = [&] { return indexing.state().offers; };
    const ArrayChoice choice{.first =
                                 [&] {
                                     const auto all = offers();
                                     const auto before = std::ranges::find(
                                         all, memory.array_of(data), &ArrayOffer::name);
                                     return before == all.end()
                                                ? std::size_t{0}
                                                : static_cast<std::size_t>(before - all.begin());
                                 },
                             .choose =
                                 [&](std::size_t chosen) {
                                     if (const auto all = offers(); chosen < all.size())
                                         memory.remember_array(data, all[chosen].name);
                                     indexing.choose(chosen);
                                 }};
    const Waited waited = wait_for_data(windows, fs::path(options.data_name).filename().string(),
                                        progress, page_options(config), choice);
    canceled = waited == Waited::canceled;
    if (waited != Waited::ready)
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
