// `isochron query`: the active cells of one isovalue at one step, and the time to find them.
#include "app/command_line/subcommands.h"
#include "app/commands/id_file.h"
#include "app/commands/process_usage.h"
#include "app/indexing/open_index.h"
#include "app/output/guarded_outputs.h"
#include "app/telling.h"
#include "app/text.h"
#include "index/error.h"
#include "index/extraction/extractor.h"
#include "index/search/layer_search.h"
#include "index/volume/instant_text.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <memory>
#include <optional>

namespace isochron::app {
namespace {

struct QueryArguments {
    std::filesystem::path file, ids;
    double isovalue = 0;
    std::int64_t step = 0;
    std::uint32_t fraction = 0;
    std::uint32_t repeats = 5;
    std::uint32_t level = 0;
    std::string method;
    std::optional<std::string> array;
    bool force = false;
};

using Milliseconds = std::chrono::duration<double, std::milli>;

struct Times {
    Milliseconds search{}, shading{};
};

struct Measured {
    index::CellSetPtr set;
    Times cold, warm; ///< warm: medians; zero without repetitions
    index::SearchMethod repeated_by = index::SearchMethod::scan;
    ProcessUsage usage; ///< what the process used after the first search
};

/// Every repetition starts a new search: otherwise it would find its own last result.
Measured measure(const std::shared_ptr<const index::IndexFile>& file, const index::Query& query,
                 std::optional<index::SearchMethod> method, std::uint32_t level,
                 std::uint32_t repeats) {
    const auto run = [&]() -> index::CellSetPtr {
        if (level > 0) // without positions and normals
            return std::make_shared<index::CellSet>(index::search_level(file, level, query));
        return index::search_in(file, method)(query, {});
    };
    Measured result;
    result.set = run();
    result.cold = {result.set->search_time, result.set->shading_time};
    result.usage = process_usage();
    std::vector<std::chrono::nanoseconds> search, shading;
    for (std::uint32_t i = 0; i < repeats; ++i) {
        const index::CellSetPtr again = run();
        result.repeated_by = again->method;
        search.push_back(again->search_time);
        shading.push_back(again->shading_time);
    }
    const auto median = [](std::vector<std::chrono::nanoseconds> times) -> Milliseconds {
        const auto middle = times.begin() + static_cast<std::ptrdiff_t>(times.size() / 2);
        std::nth_element(times.begin(), middle, times.end());
        return *middle;
    };
    if (repeats > 0)
        result.warm = {median(search), median(shading)};
    return result;
}

std::string_view name_of(index::SearchMethod method) {
    return index::kSearchMethodNames[static_cast<std::size_t>(method)];
}

/// The method that is asked for, if any.
std::optional<index::SearchMethod> method_of(const QueryArguments& arguments,
                                             const index::IndexFile& file) {
    if (index::is_former_tier(arguments.method)) {
        print_note("--method {}: no longer there; searched by {}", arguments.method,
                   name_of(index::cheapest_method(file)));
        return std::nullopt;
    }
    for (std::size_t i = 0; i < index::kSearchMethodNames.size(); ++i) {
        const auto method = static_cast<index::SearchMethod>(i);
        if (index::kSearchMethodNames[i] != arguments.method)
            continue;
        if (!index::can_search(file, method))
            throw index::Error("{}: has no search structure {}; isochron info lists those it has",
                               arguments.file.string(), arguments.method);
        return method;
    }
    return std::nullopt;
}

nlohmann::ordered_json as_json(const QueryArguments& arguments, const index::IndexFile& file,
                               const Measured& result) {
    const index::SeriesInfo& info = file.info();
    const std::uint64_t active = result.set->ids.size();
    const std::uint64_t false_positives = result.set->candidates - active;
    const index::ReadUse reading = file.reading();
    nlohmann::ordered_json j{
        {"file", arguments.file.string()},
        {"array", info.array},
        {"step", arguments.step},
        {"fraction", arguments.fraction},
        {"time", index::time_at(info.times, result.set->query.instant)},
        {"time_unit", info.time_unit},
        {"isovalue", arguments.isovalue},
        {"value_unit", info.value_unit},
        {"level", arguments.level},
        {"method", name_of(result.set->method)},
        {"active_cells", active},
        {"id_bits", index::has_wide_ids(file.chunks(arguments.level).info().grid) ? 64 : 32},
        {"candidates", result.set->candidates},
        {"reused", result.set->reused},
        {"false_positives", false_positives},
        {"false_positive_rate",
         active ? nlohmann::ordered_json(double(false_positives) / double(active)) : nullptr},
        {"cold_search_ms", result.cold.search.count()},
        {"cold_shading_ms", result.cold.shading.count()},
        {"resident_bytes", result.usage.resident_bytes},
        {"read_bytes", result.usage.read_bytes},
        {"reading",
         {{"bytes", reading.bytes},
          {"hits", reading.hits},
          {"misses", reading.misses},
          {"held", reading.held},
          {"budget", reading.budget}}},
        {"repetitions", arguments.repeats}};
    if (arguments.repeats > 0) {
        j["search_ms"] = result.warm.search.count();
        j["shading_ms"] = result.warm.shading.count();
        j["repeated_method"] = name_of(result.repeated_by);
    }
    if (!arguments.ids.empty())
        j["ids"] = arguments.ids.string();
    return j;
}

SafeText as_text(const QueryArguments& arguments, const index::IndexFile& file,
                 const Measured& result) {
    const index::SeriesInfo& info = file.info();
    const std::uint64_t active = result.set->ids.size();
    SafeText text("isovalue {}{} at step {} (time {}){}\n"
                  "active cells     {}\n",
                  arguments.isovalue, with_space(info.value_unit),
                  index::number_text(result.set->query.instant),
                  index::instant_text(info.times, result.set->query.instant, info.time_unit),
                  arguments.level > 0 ? fmt::format(", level of detail {}", arguments.level) : "",
                  grouped(active));
    text += SafeText("found by         {}: {} cells tested, {} of them not active\n",
                     name_of(result.set->method), grouped(result.set->candidates),
                     grouped(result.set->candidates - active));
    const auto times = [](const Times& t) {
        return fmt::format("search {:.3f} ms, shading {:.3f} ms", t.search.count(),
                           t.shading.count());
    };
    text += SafeText("first, cold      {}\n", times(result.cold));
    text += SafeText("memory           {} resident, {} read from disk\n",
                     human_bytes(static_cast<double>(result.usage.resident_bytes)),
                     human_bytes(static_cast<double>(result.usage.read_bytes)));
    if (arguments.repeats > 0)
        text += SafeText("repeated, warm   {} (medians of {} full searches by {})\n",
                         times(result.warm), arguments.repeats, name_of(result.repeated_by));
    if (!arguments.ids.empty())
        text += SafeText("ids              {}\n", arguments.ids.string());
    return text;
}

void run_query(const QueryArguments& arguments) {
    const auto file = open_array(arguments.file, arguments.array);
    const index::Instant at = index::instant_named(*file, arguments.step, arguments.fraction);
    warn_beyond(arguments.isovalue, *file);
    if (arguments.level >= file->detail_levels())
        throw index::Error("{}: level {}, expected 0 to {}", arguments.file.string(),
                           arguments.level, file->detail_levels() - 1);
    if (arguments.level > 0 && !arguments.method.empty())
        throw UsageError("--method is for level 0 only");
    if (!arguments.ids.empty())
        guard_outputs({{arguments.ids, OutputKind::ids, file->info().grid.cell_count()}},
                      {{arguments.file}, file.get()}, arguments.force);
    const Measured result = measure(file, {at, arguments.isovalue}, method_of(arguments, *file),
                                    arguments.level, arguments.repeats);
    if (!arguments.ids.empty())
        write_ids(arguments.ids, *result.set, file->chunks(arguments.level).info().grid);
    tell_result(as_json(arguments, *file, result));
    print_answer(as_text(arguments, *file, result));
}

} // namespace

void add_query(Command& program) {
    auto arguments = std::make_shared<QueryArguments>();
    Command command = program.subcommand(
        "query", "Find the active cells of an isovalue at a step: those in which the values at the "
                 "corners have min < isovalue <= max.");
    command.examples({"isochron query run42.isochron --isovalue 100 --step 0",
                      "isochron query run42.isochron --isovalue 100 --step 0 -o cells.bin --json"});
    command.option("file INDEX", arguments->file, "Index to search").required();
    command.option("--array NAME", arguments->array,
                   "Array to search, where the index has several (default: its first)");
    command
        .option("--isovalue VALUE", arguments->isovalue,
                "Isovalue, in the unit of the values (after scaling)")
        .required();
    command.option("--step STEP", arguments->step, "Step to search, from 0").required();
    command
        .option("--fraction FRACTION", arguments->fraction,
                "Search between this step and the next, where values are blended linearly and "
                "compared exactly: 0 is this step, 32768 is halfway, 65536 would be the next step")
        .between(0u, 65535u)
        .shows_default();
    command.option("-o,--output,--ids FILE", arguments->ids,
                   "Write the numbers of the active cells, ascending, to this file: u32 (u64 where "
                   "there are 2^32 cells or more), little-endian; cell x y z has the number "
                   "(z * (ny - 1) + y) * (nx - 1) + x");
    command.flag("--force", arguments->force,
                 "Let --output replace any file but one that is read; without this option it "
                 "replaces only numbers of cells");
    command
        .option("--repeat COUNT", arguments->repeats,
                "Number of times that the search is repeated; the median of the times is printed")
        .between(0u, 1000u)
        .shows_default();
    command
        .option("--level LEVEL", arguments->level,
                "Level of detail to search; 0 is the finest, and `isochron info` lists them. Cells "
                "are numbered in the grid of the level")
        .shows_default();
    command
        .option("--method METHOD", arguments->method,
                "Search structure to use (default: the fastest one of the index)")
        .one_of(std::vector<std::string>(index::kSearchMethodNames.begin(),
                                         index::kSearchMethodNames.end()),
                {"cells"});
    command.footer("The time of a search includes the exact test of each cell. Shading is the "
                   "computation of positions and normals. The first search reads the file; the "
                   "repeated ones find it in memory.");
    command.on_run([arguments] { run_query(*arguments); });
}

} // namespace isochron::app
