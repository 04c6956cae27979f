// What an index holds, as text and as JSON.
#include "app/index_report.h"

#include "app/placement.h"
#include "app/text.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <glm/matrix.hpp>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>

namespace isochron::app {
namespace {

using index::Grid;
using index::SeriesInfo;

constexpr std::array kAnatomies{"none", "ras", "lps"};

std::array<double, 3> numbers(const glm::dvec3& v) {
    return {v.x, v.y, v.z};
}

bool right_handed(const Grid& grid) {
    return glm::determinant(grid.direction) > 0;
}

/// Equal steps, as far as the rounding of decimal times lets them be.
bool uniform(const std::vector<double>& times) {
    if (times.size() < 3)
        return true;
    const double mean = (times.back() - times.front()) / static_cast<double>(times.size() - 1);
    const double tolerance =
        1e-6 * mean + 1e-12 * std::max(std::abs(times.front()), std::abs(times.back()));
    for (std::size_t t = 1; t < times.size(); ++t)
        if (std::abs(times[t] - times[t - 1] - mean) > tolerance)
            return false;
    return true;
}

double raw_bytes(const SeriesInfo& info) {
    return static_cast<double>(info.steps()) * static_cast<double>(info.grid.cell_count()) * 24;
}

double percent_of_raw(const index::IndexFile& file) {
    const index::IndexStats& stats = file.stats();
    return 100 * static_cast<double>(stats.file_bytes - stats.volume_bytes) /
           raw_bytes(file.info());
}

/// Entries per cell-step.
double coherence(const index::IndexFile& file) {
    return static_cast<double>(file.tree()->entries()) /
           (static_cast<double>(file.info().grid.cell_count()) *
            static_cast<double>(file.info().steps()));
}

std::string times_text(const SeriesInfo& info) {
    if (info.steps() == 1)
        return fmt::format("1 at time {}{}", human_number(info.times.front()),
                           with_space(info.time_unit));
    return fmt::format("{}, times {} to {}{}, {}", info.steps(), human_number(info.times.front()),
                       human_number(info.times.back()), with_space(info.time_unit),
                       uniform(info.times) ? "uniform" : "not uniform");
}

std::string sources_text(const std::vector<std::string>& sources) {
    constexpr std::size_t kListed = 8;
    std::string text;
    for (std::size_t i = 0; i < std::min(kListed, sources.size()); ++i)
        text += fmt::format("source        {}\n", sources[i]);
    if (sources.size() > kListed)
        text += fmt::format("source        ... {} more, the last {}\n", sources.size() - kListed,
                            sources.back());
    return text;
}

std::string tree_text(const index::IndexFile& file) {
    if (!file.tree())
        return "tree          none\n";
    std::string text;
    for (const auto& node : file.tree()->nodes())
        text += fmt::format("{:{}}[{},{}] {} cells\n", "", 2 * node.depth, node.first_step,
                            node.last_step, grouped(node.cells));
    return text;
}

} // namespace

std::string as_text(const IndexReport& report) {
    const index::IndexFile& file = report.file;
    const SeriesInfo& info = file.info();
    const index::IndexStats& stats = file.stats();
    const Grid& grid = info.grid;
    const std::string length = with_space(info.length_unit);
    const auto bytes = [](std::uint64_t n) { return human_bytes(static_cast<double>(n)); };

    std::string text = fmt::format("{}\n", report.name);
    const auto line = [&](std::string_view label, const std::string& value) {
        text += fmt::format("{:<13} {}\n", label, value);
    };
    line("array", info.array.empty() ? "unnamed" : info.array);
    line("vertices", fmt::format("{}", fmt::join(grid.vertices, " x ")));
    line("cells",
         fmt::format("{} = {}", fmt::join(grid.cells(), " x "), grouped(grid.cell_count())));
    line("spacing", fmt::format("{:.10g}{}", fmt::join(numbers(grid.spacing), " x "), length));
    line("size", fmt::format("{:.10g}{}", fmt::join(numbers(physical_size(grid)), " x "), length));
    line("origin", fmt::format("{:.10g}{}", fmt::join(numbers(grid.origin), " "), length));
    for (int axis = 0; axis < 3; ++axis)
        line(
            axis == 0 ? "direction" : "",
            fmt::format("{}: {:.10g}", "xyz"[axis], fmt::join(numbers(grid.direction[axis]), " ")));
    line("handedness", right_handed(grid) ? "right" : "left");
    if (info.anatomy != index::Anatomy::none)
        line("anatomy", info.anatomy == index::Anatomy::ras ? "RAS" : "LPS");
    line("steps", times_text(info));
    line("type", std::string(index::name_of(info.type)));
    if (info.scaling != index::Scaling{})
        line("scaling",
             fmt::format("{} * stored + {}", info.scaling.slope, info.scaling.intercept));
    line("values", fmt::format("{} to {}{}", stats.low, stats.high, with_space(info.value_unit)));
    line("NaN", fmt::format("{} values", grouped(stats.nan_values)));
    line("file",
         fmt::format("{}: volume {}, tree {}; {:.1f} % of raw without the volume",
                     bytes(stats.file_bytes), bytes(stats.volume_bytes),
                     stats.tree_bytes ? bytes(stats.tree_bytes) : "none", percent_of_raw(file)));
    if (const index::ThiTree* tree = file.tree())
        line("coherence",
             fmt::format("{:.4f} entries per cell-step ({} entries; lattice {}, max variation {})",
                         coherence(file), grouped(tree->entries()), tree->options().lattice,
                         tree->options().max_variation));
    line("content hash", fmt::format("{:016x}", file.content_hash()));
    text += sources_text(info.sources);
    for (const std::string& note : info.notes)
        line("note", note);
    if (report.verified)
        line("verified", "every section matches its checksum");
    if (report.tree)
        text += tree_text(file);
    return text;
}

std::string as_json(const IndexReport& report) {
    const index::IndexFile& file = report.file;
    const SeriesInfo& info = file.info();
    const index::IndexStats& stats = file.stats();
    const Grid& grid = info.grid;
    nlohmann::ordered_json j{
        {"file", report.name},
        {"array", info.array},
        {"vertices", grid.vertices},
        {"cells", grid.cells()},
        {"spacing", numbers(grid.spacing)},
        {"origin", numbers(grid.origin)},
        {"direction",
         {numbers(grid.direction[0]), numbers(grid.direction[1]), numbers(grid.direction[2])}},
        {"handedness", right_handed(grid) ? "right" : "left"},
        {"physical_size", numbers(physical_size(grid))},
        {"length_unit", info.length_unit},
        {"anatomy", kAnatomies[static_cast<std::size_t>(info.anatomy)]},
        {"steps", info.steps()},
        {"times", info.times},
        {"time_unit", info.time_unit},
        {"uniform_time", uniform(info.times)},
        {"type", index::name_of(info.type)},
        {"slope", info.scaling.slope},
        {"intercept", info.scaling.intercept},
        {"low", stats.low},
        {"high", stats.high},
        {"value_unit", info.value_unit},
        {"nan_values", stats.nan_values},
        {"histogram", stats.histogram},
        {"file_bytes", stats.file_bytes},
        {"volume_bytes", stats.volume_bytes},
        {"tree_bytes", stats.tree_bytes},
        {"raw_bytes", raw_bytes(info)},
        {"percent_of_raw", percent_of_raw(file)},
        {"lattice", file.options().tree.lattice},
        {"max_variation", file.options().tree.max_variation},
    };
    if (const index::ThiTree* tree = file.tree()) {
        j["tree_entries"] = tree->entries();
        j["coherence"] = coherence(file);
    }
    j["content_hash"] = fmt::format("{:016x}", file.content_hash());
    j["sources"] = info.sources;
    j["notes"] = info.notes;
    if (report.tree) {
        j["tree"] = nlohmann::ordered_json::array();
        if (file.tree())
            for (const auto& node : file.tree()->nodes())
                j["tree"].push_back({{"first_step", node.first_step},
                                     {"last_step", node.last_step},
                                     {"depth", node.depth},
                                     {"cells", node.cells}});
    }
    if (report.verified)
        j["verified"] = true;
    return j.dump(2, ' ', false, nlohmann::json::error_handler_t::replace) + "\n";
}

} // namespace isochron::app
