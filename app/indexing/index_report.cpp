// What an index holds, as text and as JSON.
#include "app/indexing/index_report.h"

#include "app/indexing/series_report.h"
#include "app/text.h"
#include "index/file/blend_advice.h"
#include "index/search/tree_of_file.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <functional>
#include <vector>

namespace isochron::app {
namespace {

using index::SeriesInfo;

double raw_bytes(const SeriesInfo& info) {
    return static_cast<double>(info.steps()) * static_cast<double>(info.grid.cell_count()) * 24;
}

/// Size of all arrays of the file together.
double percent_of_raw(const index::IndexFile& file) {
    std::uint64_t besides = file.stats().file_bytes;
    double raw = 0;
    for (std::size_t number = 0; number < file.arrays(); ++number) {
        const index::IndexStats& stats = file.array(number).stats();
        besides -= stats.volume_bytes + stats.detail_bytes;
        raw += raw_bytes(file.array(number).info());
    }
    return 100 * static_cast<double>(besides) / raw;
}

/// Bytes of the parts of one array.
std::uint64_t own_bytes(const index::IndexFile& file) {
    const index::IndexStats& stats = file.stats();
    std::uint64_t bytes =
        stats.volume_bytes + stats.detail_bytes + stats.color_bytes + stats.unused_bytes;
    for (std::size_t i = 0; i < index::kTierNames.size(); ++i)
        bytes += stats.bytes_of(static_cast<index::Tier>(i));
    return bytes;
}

std::vector<std::string_view> tier_names(const index::IndexFile& file) {
    std::vector<std::string_view> names;
    for (std::size_t i = 0; i < index::kTierNames.size(); ++i)
        if (file.plan().tiers.has(static_cast<index::Tier>(i)))
            names.push_back(index::kTierNames[i]);
    return names;
}

/// Those of the series, and that this program would read the files otherwise.
std::vector<std::string> notes_of(const index::IndexFile& file) {
    std::vector<std::string> notes = file.info().notes;
    if (const std::uint32_t reading = file.metadata().reading_number; reading != index::kReading)
        notes.push_back(fmt::format("its files were read otherwise than this program reads them "
                                    "(reading {}, this program has {}): built again, its places, "
                                    "times or missing values may differ",
                                    reading, index::kReading));
    return notes;
}

std::string array_text(const index::IndexFile& file) {
    const index::IndexStats& stats = file.stats();
    const auto tiers = tier_names(file);
    return fmt::format(
        "{}: {}, {}, {} NaN, {}, {}", file.info().array, index::name_of(file.info().type),
        exact_range_text(stats.low, stats.high, file.info()), grouped(stats.nan_values),
        tiers.empty() ? "no tiers" : fmt::format("{}", fmt::join(tiers, ", ")),
        human_bytes(static_cast<double>(own_bytes(file))));
}

/// The time nodes of the paper's tree; none without it.
std::vector<index::TimeNodeCells> time_nodes(const index::IndexFile& file) {
    const auto tree = index::tree_of(file);
    return tree ? tree->nodes() : std::vector<index::TimeNodeCells>{};
}

/// Number of entries in the same tree; 0 without one.
std::uint64_t entries_of(const index::IndexFile& file) {
    const auto tree = index::tree_of(file);
    return tree ? tree->entries() : 0;
}

/// Mean number of entries per cell and step.
double coherence(const index::IndexFile& file) {
    return static_cast<double>(entries_of(file)) /
           (static_cast<double>(file.info().grid.cell_count()) *
            static_cast<double>(file.info().steps()));
}

/// The level map of the bricks; for wide value types the last step's level map.
index::LevelMapPtr levels_of(const index::IndexFile& file) {
    return file.plan().tiers.has(index::Tier::bricks)
               ? file.chunks().levels(static_cast<std::uint32_t>(file.info().steps() - 1))
               : nullptr;
}

std::string levels_text(const index::IndexFile& file) {
    const auto levels = levels_of(file);
    if (!levels)
        return "none, as the index has no bricks";
    const bool by_step = index::size_of(file.info().type) > 1;
    return fmt::format("{}, {}{}", levels->levels(),
                       levels->lossless() ? "one for each value" : "each for several values",
                       by_step ? " (in the last step; each step has its own classes)" : "");
}

SafeText sources_text(const std::vector<std::string>& sources) {
    constexpr std::size_t kListed = 8;
    SafeText text;
    for (std::size_t i = 0; i < std::min(kListed, sources.size()); ++i)
        text += SafeText("source        {}\n", sources[i]);
    if (sources.size() > kListed)
        text += SafeText("source        ... {} more, the last {}\n", sources.size() - kListed,
                         sources.back());
    return text;
}

SafeText tree_text(const index::IndexFile& file) {
    const auto nodes = time_nodes(file);
    if (nodes.empty())
        return SafeText(
            "time nodes    none; only the tree of the paper has them, which build --lattice "
            "adds\n");
    SafeText text;
    for (const auto& node : nodes)
        text += SafeText("{:{}}[{},{}] {} cells\n", "", 2 * node.depth, node.first_step,
                         node.last_step, grouped(node.cells));
    return text;
}

/// What was kept when the index was built or, if it is asked for, what is measured now.
std::optional<index::BlendQuality> quality_of(const IndexReport& report) {
    const index::IndexFile& file = report.file;
    const auto measured =
        report.blends ? index::measure_blends(file.chunks(), file.stats()) : std::nullopt;
    return measured ? measured : file.metadata().blends;
}

std::string blends_text(const std::optional<index::BlendQuality>& quality) {
    if (!quality)
        return "unknown; the measurement needs three steps, bricks, and the values in the index";
    return fmt::format(
        "{}; a blend of two steps is expected to place 95 % of the surface's cells within {:.2g} "
        "voxels of the true surface{}. It would be {:.2g} voxels if there were only every second "
        "step{}",
        quality->holds() ? "hold" : "blend", quality->expected(),
        quality->lone > 0 ? fmt::format(", but {} parts of more than {} cells appear and vanish",
                                        quality->lone, index::BlendQuality::kSmallPart)
                          : "",
        quality->every_second,
        quality->every_fourth
            ? fmt::format(", and {:.2g} with only every fourth", *quality->every_fourth)
            : "");
}

nlohmann::ordered_json blends_json(const std::optional<index::BlendQuality>& quality) {
    if (!quality)
        return nullptr;
    nlohmann::ordered_json j{{"advice", quality->holds() ? "hold" : "blend"},
                             {"expected_voxels", quality->expected()},
                             {"every_second_voxels", quality->every_second},
                             {"every_fourth_voxels", nullptr},
                             {"lone_parts", quality->lone},
                             {"compared_cells", quality->cells}};
    if (quality->every_fourth)
        j["every_fourth_voxels"] = *quality->every_fourth;
    return j;
}

/// @param bytes of the arrays and of what lies between their parts
std::string sizes_of(const std::vector<const index::IndexFile*>& arrays, std::uint64_t bytes) {
    const auto sum = [&](const auto& bytes_of) {
        std::uint64_t all = 0;
        for (const index::IndexFile* const array : arrays)
            all += std::invoke(bytes_of, array->stats());
        return all;
    };
    const auto words = [](std::uint64_t n) { return human_bytes(static_cast<double>(n)); };
    std::string text = words(bytes);
    text += arrays.front()->referral()
                ? ": volume in its sources"
                : fmt::format(": volume {}", words(sum(&index::IndexStats::volume_bytes)));
    for (std::size_t i = 0; i < index::kTierNames.size(); ++i) {
        const auto tier = static_cast<index::Tier>(i);
        if (std::ranges::any_of(arrays, [&](const auto* a) { return a->plan().tiers.has(tier); }))
            text += fmt::format(
                ", {} {}", index::kTierNames[i],
                words(sum([&](const index::IndexStats& of) { return of.bytes_of(tier); })));
    }
    if (const std::uint64_t unused = sum(&index::IndexStats::unused_bytes))
        text += fmt::format(", no longer used {}", words(unused));
    if (const std::uint64_t detail = sum(&index::IndexStats::detail_bytes))
        text += fmt::format(", levels of detail {}", words(detail));
    if (const std::uint64_t colors = sum(&index::IndexStats::color_bytes))
        text += fmt::format(", colors {}", words(colors));
    return text;
}

} // namespace

nlohmann::ordered_json array_json(const index::IndexFile& array) {
    const index::IndexStats& stats = array.stats();
    return {{"array", array.info().array},
            {"value_unit", array.info().value_unit},
            {"type", index::name_of(array.info().type)},
            {"low", stats.low},
            {"high", stats.high},
            {"nan_values", stats.nan_values},
            {"tiers", tier_names(array)},
            {"content_hash", fmt::format("{:016x}", array.content_hash())}};
}

std::string array_sizes(const index::IndexFile& array) {
    return array.arrays() == 1 ? file_sizes(array) : sizes_of({&array}, own_bytes(array));
}

std::string file_sizes(const index::IndexFile& file) {
    std::vector<const index::IndexFile*> arrays;
    for (std::size_t number = 0; number < file.arrays(); ++number)
        arrays.push_back(&file.array(number));
    return sizes_of(arrays, file.stats().file_bytes);
}

/// Share of chunks that are as in the step before, in all steps but the first.
double staying_percent(const index::IndexFile& file) {
    const auto chunks = static_cast<double>(file.chunks().grid().count());
    const auto later = static_cast<double>(std::max<std::size_t>(file.info().steps(), 2) - 1);
    return 100 * static_cast<double>(file.stats().staying) / (chunks * later);
}

std::string staying_text(const index::IndexFile& file) {
    return fmt::format("{:.1f} % of the blocks of 16 x 16 x 16 values equal the blocks of the step "
                       "before; they are stored once, and cells found in them are used again",
                       staying_percent(file));
}

SafeText as_text(const IndexReport& report) {
    const index::IndexFile& file = report.file;
    const SeriesInfo& info = file.info();
    const index::IndexStats& stats = file.stats();
    SafeText text("{}\n{}", report.name, text_of(info));
    const auto line = [&](std::string_view label, const std::string& value) {
        text += SafeText("{:<13} {}\n", label, value);
    };
    line("values", exact_range_text(stats.low, stats.high, info));
    line("NaN", fmt::format("{} values", grouped(stats.nan_values)));
    for (std::size_t number = 0; file.arrays() > 1 && number < file.arrays(); ++number)
        line(number == 0 ? "arrays" : "", array_text(file.array(number)));
    if (const index::ColorArray* color = file.array(0).color())
        line("colors", fmt::format("{}, {}, {} to {}{}, {} NaN", color->array,
                                   index::name_of(color->type), color->low, color->high,
                                   with_space(color->value_unit), grouped(color->nan_values)));
    line("file", fmt::format("{}; without the volume {:.3g} % of the raw size (24 bytes for each "
                             "cell and step)",
                             file_sizes(file), percent_of_raw(file)));
    if (file.has_since() && info.steps() > 1)
        line("unchanged", staying_text(file));
    for (std::size_t level = 1; level < file.detail_levels(); ++level)
        line(level == 1 ? "coarser grids" : "",
             fmt::format("{} vertices (level of detail {})",
                         fmt::join(file.chunks(level).info().grid.vertices, " x "), level));
    for (const std::string& reason : file.plan().reasons)
        line("plan", reason);
    if (file.plan().steps < info.steps())
        line("plan", fmt::format("chosen when the index held {} of its {} steps", file.plan().steps,
                                 info.steps()));
    line("brick classes", levels_text(file));
    if (entries_of(file) > 0)
        line("coherence",
             fmt::format("{:.4f} entries for each cell and step; fewer entries mean that cells "
                         "change more slowly ({} entries, lattice {}, max variation {})",
                         coherence(file), grouped(entries_of(file)), file.tree_options().lattice,
                         file.tree_options().max_variation));
    if (const auto quality = quality_of(report); quality || report.blends)
        line("between", blends_text(quality));
    line("content hash", fmt::format("{:016x}", file.content_hash()));
    text += sources_text(info.sources);
    for (const std::string& note : notes_of(file))
        line("note", note);
    if (report.tree)
        text += tree_text(file);
    return text;
}

nlohmann::ordered_json as_json(const IndexReport& report) {
    const index::IndexFile& file = report.file;
    const SeriesInfo& info = file.info();
    const index::IndexStats& stats = file.stats();
    nlohmann::ordered_json j{{"file", report.name}};
    j.update(json_of(info));
    j.update(nlohmann::ordered_json{
        {"low", stats.low},
        {"high", stats.high},
        {"value_unit", info.value_unit},
        {"nan_values", stats.nan_values},
        {"histogram", stats.histogram},
        {"file_bytes", stats.file_bytes},
        {"volume_bytes", stats.volume_bytes},
        {"bricks_bytes", stats.bricks_bytes},
        {"tree_bytes", stats.tree_bytes},
        {"unused_bytes", stats.unused_bytes},
        {"detail_bytes", stats.detail_bytes},
        {"staying_chunks", stats.staying},
        {"staying_percent", staying_percent(file)},
        {"detail", nlohmann::ordered_json::array()},
        {"raw_bytes", raw_bytes(info)},
        {"percent_of_raw", percent_of_raw(file)},
        {"tiers", tier_names(file)},
        {"plan", file.plan().reasons},
        {"levels", nullptr},
        {"lossless", nullptr},
        {"refers_to", nullptr},
        {"arrays", nlohmann::ordered_json::array()},
        {"lattice", file.tree_options().lattice},
        {"max_variation", file.tree_options().max_variation},
    });
    for (std::size_t level = 1; level < file.detail_levels(); ++level)
        j["detail"].push_back(
            {{"level", level}, {"vertices", file.chunks(level).info().grid.vertices}});
    if (const auto levels = levels_of(file)) {
        j["levels"] = levels->levels();
        j["lossless"] = levels->lossless();
    }
    for (std::size_t number = 0; number < file.arrays(); ++number)
        j["arrays"].push_back(array_json(file.array(number)));
    if (const index::ColorArray* color = file.array(0).color())
        j["color"] = {{"array", color->array},
                      {"value_unit", color->value_unit},
                      {"type", index::name_of(color->type)},
                      {"low", color->low},
                      {"high", color->high},
                      {"nan_values", color->nan_values},
                      {"bytes", stats.color_bytes}};
    if (file.referral()) {
        j["refers_to"] = nlohmann::ordered_json::array();
        for (const std::filesystem::path& source : file.referral()->files)
            j["refers_to"].push_back(source.string());
    }
    if (entries_of(file) > 0) {
        j["tree_entries"] = entries_of(file);
        j["coherence"] = coherence(file);
    }
    j["content_hash"] = fmt::format("{:016x}", file.content_hash());
    j["sources"] = info.sources;
    j["notes"] = notes_of(file);
    j["between"] = blends_json(quality_of(report));
    if (report.tree) {
        j["tree"] = nlohmann::ordered_json::array();
        for (const auto& node : time_nodes(file))
            j["tree"].push_back({{"first_step", node.first_step},
                                 {"last_step", node.last_step},
                                 {"depth", node.depth},
                                 {"cells", node.cells}});
    }
    return j;
}

} // namespace isochron::app
