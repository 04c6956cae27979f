// Data to explore: an index, or files of values that are indexed while they are shown.
#include "app/explore/explored_data.h"

#include "app/config/series_names.h"
#include "app/explore/loading.h"
#include "app/explore/story_file.h"
#include "app/indexing/file_patterns.h"
#include "app/indexing/kept_index.h"
#include "app/kept/user_memory.h"
#include "app/loop/data_window.h"
#include "app/text.h"
#include "index/file/index_series.h"
#include "index/system/links/link.h"
#include "index/system/user_folders.h"

#include <algorithm>
#include <charconv>
#include <cstdint>
#include <filesystem>
#include <utility>

namespace isochron::app {
namespace {

namespace fs = std::filesystem;

/// Most steps that are waited for: the step to start at, and all steps before it.
std::size_t awaited_steps(const ExploreOptions& options) {
    return std::size_t{options.step.value_or(0)} + 1;
}

/// What was meant for the data before, and does not go on to the next.
ExploreOptions begun_anew(ExploreOptions options) {
    options.data.reset();
    options.array.reset();
    options.isovalue.reset();
    options.step.reset();
    options.session.reset();
    options.story.reset();
    options.told = 0;
    options.report.reset();
    options.resume = false;
    return options;
}

/// The number of an array; empty: it is not among them.
std::optional<std::size_t> number_of(const std::vector<ArrayOffer>& offers,
                                     const std::string& name) {
    const auto at = std::ranges::find(offers, name, &ArrayOffer::name);
    return at == offers.end() ? std::nullopt
                              : std::optional(static_cast<std::size_t>(at - offers.begin()));
}

} // namespace

std::vector<ListedArray> listed(const std::vector<ArrayOffer>& offers) {
    std::vector<ListedArray> lines;
    for (const ArrayOffer& offer : offers)
        lines.push_back(
            {offer.name, offer.shape, offer.unit,
             offer.range ? range_text((*offer.range)[0], (*offer.range)[1]) : std::string(),
             offer.fault});
    return lines;
}

bool is_index_name(const std::vector<std::string>& files) {
    std::error_code ignored;
    if (files.size() != 1)
        return false;
    if (index::is_link(files.front()))
        return true;
    if (!fs::exists(files.front(), ignored))
        return !is_pattern(files.front());
    return fs::path(files.front()).extension() == ".isochron" || index::is_index(files.front());
}

/// The story that a link tells, and the key that it tells.
ExploreOptions with_linked_story(ExploreOptions options) {
    const std::string& link = options.sources.files.front();
    auto view = index::settings_of_link(link);
    const std::string name = view["story"], said = view["told"];
    std::uint32_t told = 0;
    const auto read = std::from_chars(said.data(), said.data() + said.size(), told);
    if (read.ptr != said.data() + said.size() || told == 0 || !index::is_plain_name(name))
        return options;
    options.story = index::beside(link, name);
    options.told = told;
    return options;
}

ExploreOptions with_index(ExploreOptions options) {
    options.sources = with_path_within(std::move(options.sources));
    set_up_readers(options.sources);
    std::vector<std::string>& files = options.sources.files;
    for (std::string& file : files)
        file = index::address_of(file);
    if (files.empty() || options.test_pattern)
        return options;
    if (files.size() == 1 && is_story_name(files.front()) && !options.story) {
        options.story = files.front();
        files.front() = data_of_story(files.front());
    }
    if (files.size() == 1 && index::is_link(files.front()) && !options.story)
        options = with_linked_story(std::move(options));
    if (options.story)
        read_story(*options.story); // refused before a window opens
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
        throw UsageError(
            "{}: no index, which a job of several processes needs: isochron build makes one",
            options.sources.files.front());
    const auto folder = index::user_cache_folder();
    if (!folder)
        throw UsageError("no folder for indexes: neither HOME nor XDG_CACHE_HOME is set; isochron "
                         "build makes an index anywhere");
    auto indexing = std::make_unique<Indexing>(options.sources, *folder, asks);
    // Nearly all data that cannot be read are refused here, before a window opens for them.
    indexing->wait_for_opening(std::chrono::milliseconds(500));
    indexing->check();
    return indexing;
}

std::optional<std::string> wait_for_index(Indexing& indexing, const stereo::Windows& windows,
                                          const ExploreOptions& options, const Config& config,
                                          bool& canceled) {
    UserMemory memory(index::user_state_folder());
    const fs::path data(options.data_name);
    const auto choose = [&](const std::vector<ArrayOffer>& offers, std::size_t chosen) {
        if (chosen < offers.size())
            memory.remember_array(data, offers[chosen].name);
        indexing.choose(chosen);
    };
    const auto progress = [&] {
        Indexing::State now = indexing.state();
        if (const auto chosen = number_of(now.offers, options.array.value_or(""))) {
            choose(now.offers, *chosen);
            now.offers.clear();
        }
        const std::size_t wanted = awaited_steps(options);
        return DataProgress{.ready = now.done || (now.index && now.steps >= wanted) ||
                                     (now.of > 0 && now.index && wanted > now.of),
                            .line = now.line(),
                            .fraction = static_cast<float>(now.fraction),
                            .arrays = listed(now.offers)};
    };
    // The array that the user has chosen of the same data before is chosen at the beginning.
    const auto offers = [&] { return indexing.state().offers; };
    const ArrayChoice choice{
        .first = [&] { return number_of(offers(), memory.array_of(data)).value_or(0); },
        .choose = [&](std::size_t chosen) { choose(offers(), chosen); }};
    const Waited waited = wait_for_data(windows, said_name(options.data_name), progress,
                                        page_options(config), choice);
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
    options = begun_anew(std::move(options));
    options.sources = {};
    options.sources.files = {data};
    return with_index(std::move(options));
}

ExploreOptions with_other_array(ExploreOptions options, const std::string& array) {
    options = begun_anew(std::move(options));
    options.array = array;
    return with_index(std::move(options));
}

} // namespace isochron::app
