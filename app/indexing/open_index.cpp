// Opens the index that a command is given.
#include "app/indexing/open_index.h"

#include "app/telling.h"
#include "app/text.h"
#include "index/error.h"
#include "index/extraction/volume_blocks.h"
#include "index/file/color_source.h"
#include "index/file/index_states.h"
#include "index/shell_word.h"

#include <fmt/format.h>

#include <algorithm>

namespace isochron::app {
namespace {

/// An index that has nothing but tiers of an earlier program is scanned.
bool is_only_scanned(const index::IndexFile& file) {
    return file.stats().unused_bytes > 0 && file.plan().tiers == index::TierSet();
}

} // namespace

std::shared_ptr<const index::IndexFile> open_index(const std::filesystem::path& path,
                                                   std::uint64_t cache_bytes, LostState lost,
                                                   const std::vector<std::string>& arrays) {
    auto file = index::open_named_index(path, cache_bytes, arrays);
    const auto line = lost == LostState::is_said ? index::lost_state(*file) : std::nullopt;
    if (line)
        print_note("{}", *line);
    if (lost == LostState::is_said && is_only_scanned(*file))
        print_note("{}: the search structures that it holds are no longer used, so each search "
                   "scans a whole step; isochron build {} -o NEW.isochron gives it bricks",
                   path.string(), index::shell_word(path.string()));
    print_detail("opened {}: {} of {} array{}, {} steps", path.string(),
                 human_bytes(static_cast<double>(file->stats().file_bytes)), file->arrays(),
                 file->arrays() == 1 ? "" : "s", file->info().steps());
    return file;
}

std::shared_ptr<const index::IndexFile> open_index_to_show(const std::filesystem::path& path,
                                                           std::uint64_t cache_bytes) {
    auto file = open_index(path, cache_bytes);
    check_can_be_shown(file->info().grid, path.string());
    return file;
}

void check_can_be_shown(const index::Grid& grid, const std::string& name) {
    constexpr std::size_t kMostBlocks = std::size_t{1} << 26;
    if (index::BlockTiling(grid).count() > kMostBlocks)
        throw index::Error("{}: {} vertices, expected at most 2^35 to show; isochron query finds "
                           "the active cells of an isovalue",
                           name, grid.vertex_count());
}

std::shared_ptr<const index::IndexFile> open_array(const std::filesystem::path& path,
                                                   const std::optional<std::string>& name,
                                                   std::uint64_t cache_bytes,
                                                   const std::optional<std::string>& color_by) {
    std::vector<std::string> named;
    for (const auto& one : {name, color_by})
        if (one)
            named.push_back(*one);
    const auto file = open_index(path, cache_bytes, LostState::is_said, named);
    return name ? index::array_of(file, array_number(*file, *name)) : file;
}

std::size_t array_on_surface(const index::IndexFile& file, const std::string& name,
                             std::string_view what_for) {
    if (const auto number = index::color_source_named(file, name))
        return *number;
    const std::vector<std::string> names = index::color_source_names(file);
    throw index::Error("{}: no array {} {}, expected {}", file.name(), name, what_for,
                       names.empty()
                           ? "an index with several arrays: isochron build --array A --array B ..."
                           : fmt::format("{}", fmt::join(names, ", ")));
}

void warn_beyond(double isovalue, const index::IndexFile& file) {
    const index::IndexStats& stats = file.stats();
    const bool has_values =
        std::ranges::any_of(stats.histogram, [](auto count) { return count > 0; });
    if (has_values && stats.low == stats.high && isovalue != stats.low)
        print_note(
            "isovalue {} has no surface: {} is {} everywhere; `isochron info` lists all arrays",
            human_number(isovalue), file.info().array,
            with_unit(stats.low, file.info().value_unit));
    else if (isovalue < stats.low || isovalue > stats.high)
        print_note("isovalue {} lies beyond the data, {} to {}{}", human_number(isovalue),
                   human_number(stats.low), human_number(stats.high),
                   with_space(file.info().value_unit));
}

} // namespace isochron::app
