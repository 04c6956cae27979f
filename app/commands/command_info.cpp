// `isochron info`: what an index holds, or what files of values are.
#include "app/command_line/progress_bar.h"
#include "app/command_line/subcommands.h"
#include "app/indexing/build_sources.h"
#include "app/indexing/file_patterns.h"
#include "app/indexing/index_report.h"
#include "app/indexing/open_index.h"
#include "app/indexing/series_report.h"
#include "app/telling.h"

#include "index/file/index_series.h"
#include "index/system/links/link.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include <memory>
#include <optional>

namespace isochron::app {
namespace {

struct InfoArguments {
    BuildArguments sources;
    bool tree = false, measure_time = false;
};

/// Describes files, even where they leave open which array is meant: only `info` needs no choice.
void describe_sources(BuildArguments arguments) {
    arguments.read.any_array = true;
    const auto files = expand_patterns(arguments.files);
    std::optional<ProgressBar> bar(std::in_place);
    const BuildSources sources = open_sources(files, arguments, bar->progress());
    bar.reset(); // its line ends before the description
    const std::string name = fmt::format("{}", fmt::join(arguments.files, " "));
    if (tells_json())
        tell_result(source_json(name, *sources.volume));
    else
        print_answer(source_text(name, *sources.volume));
}

void run_info(const InfoArguments& given) {
    const BuildArguments arguments = with_path_within(given.sources);
    set_up_readers(arguments);
    const std::string& first = arguments.files.front();
    std::error_code ignored;
    const bool is_data =
        arguments.files.size() > 1 ||
        (!index::is_link(first) && std::filesystem::path(first).extension() != ".isochron" &&
         !(std::filesystem::exists(first, ignored) && index::is_index(first)));
    if (is_data && given.tree)
        throw UsageError("--tree: {} is not an index", first);
    if (is_data && given.measure_time)
        throw UsageError("--measure-time: {} is not an index", first);
    if (is_data)
        return describe_sources(arguments);
    const auto file = open_array(first, arguments.read.array);
    const IndexReport report{first, *file, given.tree, given.measure_time};
    if (tells_json())
        tell_result(as_json(report));
    else
        print_answer(as_text(report));
}

} // namespace

void add_info(Command& program) {
    auto arguments = std::make_shared<InfoArguments>();
    Command command = program.subcommand(
        "info", "Describe an index, or volume files as `build` would read them.");
    command.examples({"isochron info 'run42/*.vti'", "isochron info run42.isochron --json"});
    command.option("files FILE", arguments->sources.files, "Index, or files that `build` accepts")
        .required();
    command.flag("--tree", arguments->tree,
                 "Also print how many cells each node of the paper's tree stores, if the index has "
                 "this tree");
    command.flag("--measure-time", arguments->measure_time,
                 "Measure again how well a blend of two steps predicts the step between them, and "
                 "advise what to show between two steps: the blend, or the step before (hold). "
                 "Without this option, the advice is the one that the build stored");
    add_reading_options(command, arguments->sources);
    command.footer(
        "Lengths are in the files' unit of length, times in their unit of time, values after "
        "scaling "
        "and in their unit. `Coherence` is the number of the tree's entries, divided by cells "
        "times "
        "steps. It is 1 where a cell stores one entry at each step, and less where the tree merges "
        "steps. `Raw` is the size of a table with 24 bytes for each cell and step.");
    command.on_run([arguments] { run_info(*arguments); });
}

} // namespace isochron::app
