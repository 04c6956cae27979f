// `isochron change`: cells that become active, and cells that become inactive, from one query to
// another.
#include "app/command_line/subcommands.h"
#include "app/commands/id_file.h"
#include "app/indexing/open_index.h"
#include "app/output/guarded_outputs.h"
#include "app/telling.h"
#include "app/text.h"
#include "index/extraction/extractor.h"
#include "index/search/cell_change.h"
#include "index/volume/instant_text.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <chrono>
#include <memory>

namespace isochron::app {
namespace {

struct ChangeArguments {
    std::filesystem::path file, added, removed;
    double isovalue = 0;
    std::optional<double> to_isovalue;
    std::int64_t step = 0;
    std::optional<std::int64_t> to_step;
    std::uint32_t fraction = 0;
    std::optional<std::uint32_t> to_fraction;
    std::uint32_t repeats = 5;
    std::optional<std::string> array;
    bool force = false;
};

/// The cells that only one of two sets has, ascending.
struct Difference {
    std::vector<index::CellId> added, removed;
};

Difference difference(const index::Search& search, const index::Query& from,
                      const index::Query& to) {
    const auto before = search(from, {}), after = search(to, {});
    Difference found;
    std::ranges::set_difference(after->ids, before->ids, std::back_inserter(found.added));
    std::ranges::set_difference(before->ids, after->ids, std::back_inserter(found.removed));
    return found;
}

Difference sorted(const index::CellChange& change) {
    Difference found{{change.added.begin(), change.added.end()},
                     {change.removed.begin(), change.removed.end()}};
    std::ranges::sort(found.added);
    std::ranges::sort(found.removed);
    return found;
}

void run_change(const ChangeArguments& arguments) {
    if (!arguments.to_step && !arguments.to_isovalue && !arguments.to_fraction)
        throw UsageError("--to-step or --to-isovalue is missing");
    const auto file = open_array(arguments.file, arguments.array);
    index::expect_narrow_ids(*file);
    std::vector<Output> outputs;
    for (const auto& out : {arguments.added, arguments.removed})
        if (!out.empty())
            outputs.push_back({out, OutputKind::ids, file->info().grid.cell_count()});
    guard_outputs(outputs, {{arguments.file}, file.get()}, arguments.force);
    const index::Query from{index::instant_named(*file, arguments.step, arguments.fraction),
                            arguments.isovalue};
    const std::uint32_t same_fraction = arguments.to_step ? 0 : arguments.fraction;
    const index::Query to{index::instant_named(*file, arguments.to_step.value_or(arguments.step),
                                               arguments.to_fraction.value_or(same_fraction)),
                          arguments.to_isovalue.value_or(arguments.isovalue)};
    warn_beyond(from.isovalue, *file);
    if (to.isovalue != from.isovalue)
        warn_beyond(to.isovalue, *file);
    index::ChangeSearch search(file);
    const index::Search whole_search = index::search_in(file, std::nullopt, index::Shading::none);
    bool whole = false;
    Difference found;
    std::vector<std::chrono::duration<double, std::milli>> times;
    for (std::uint32_t i = 0; i < std::max(arguments.repeats, 1u); ++i) {
        const auto started = std::chrono::steady_clock::now();
        const index::CellChange change = search(from, to);
        whole = change.whole;
        found = whole ? difference(whole_search, from, to) : sorted(change);
        times.push_back(std::chrono::steady_clock::now() - started);
    }
    const auto middle = times.begin() + static_cast<std::ptrdiff_t>(times.size() / 2);
    std::nth_element(times.begin(), middle, times.end());
    if (!arguments.added.empty())
        write_ids(arguments.added, found.added);
    if (!arguments.removed.empty())
        write_ids(arguments.removed, found.removed);
    tell_result({{"file", arguments.file.string()},
                 {"array", file->info().array},
                 {"step", from.instant.step},
                 {"fraction", from.instant.fraction},
                 {"isovalue", from.isovalue},
                 {"to_step", to.instant.step},
                 {"to_fraction", to.instant.fraction},
                 {"to_isovalue", to.isovalue},
                 {"added", found.added.size()},
                 {"removed", found.removed.size()},
                 {"searched_anew", whole},
                 {"change_ms", middle->count()}});
    print_answer("isovalue {} at step {} to isovalue {} at step {}\n"
                 "added            {}\n"
                 "removed          {}\n"
                 "found by         {}\n"
                 "time             {:.4f} ms (median of {})\n",
                 from.isovalue, index::number_text(from.instant), to.isovalue,
                 index::number_text(to.instant), grouped(found.added.size()),
                 grouped(found.removed.size()),
                 whole ? "a full search of the second set: little stays the same"
                       : "a search of only what differs",
                 middle->count(), times.size());
}

} // namespace

void add_change(Command& program) {
    auto arguments = std::make_shared<ChangeArguments>();
    Command command =
        program.subcommand("change", "List the cells that become active, and those that stop being "
                                     "active, between two steps or isovalues.");
    command.examples({"isochron change run42.isochron --isovalue 100 --step 0 --to-step 1",
                      "isochron change run42.isochron --isovalue 100 --step 0 --to-step 1 --added "
                      "come.bin --removed gone.bin"});
    command.option("file INDEX", arguments->file, "Index to search").required();
    command.option("--array NAME", arguments->array,
                   "Array to search, where the index has several (default: its first)");
    command.option("--isovalue VALUE", arguments->isovalue, "Isovalue before the change")
        .required();
    command.option("--step STEP", arguments->step, "Step before the change, from 0").required();
    command.option("--to-isovalue VALUE", arguments->to_isovalue,
                   "Isovalue after the change (default: the one before)");
    command.option("--to-step STEP", arguments->to_step,
                   "Step after the change (default: the one before)");
    command
        .option("--fraction FRACTION", arguments->fraction,
                "Begin between --step and the step behind it: 32768 is halfway, as for `query`")
        .between(0u, 65535u)
        .shows_default();
    command
        .option("--to-fraction FRACTION", arguments->to_fraction,
                "End between --to-step and the step behind it (default: --fraction, or 0 with "
                "--to-step)")
        .between(0u, 65535u);
    command.option("--added FILE", arguments->added,
                   "Write the numbers of the cells that become active to this file, as `query "
                   "--output` does");
    command.option("--removed FILE", arguments->removed,
                   "Write the numbers of the cells that stop being active to this file");
    command.flag("--force", arguments->force,
                 "Let --added and --removed replace any file but one that is read; without this "
                 "option they replace only numbers of cells");
    command
        .option("--repeat COUNT", arguments->repeats,
                "Number of times that the search is repeated; the median of the times is printed")
        .between(1u, 1000u)
        .shows_default();
    command.on_run([arguments] { run_change(*arguments); });
}

} // namespace isochron::app
