// `isochron info`: what an index holds, or what files of values are.
#include "app/command_line/progress_bar.h"
#include "app/command_line/subcommands.h"
#include "app/indexing/build_sources.h"
#include "app/indexing/file_patterns.h"
#include "app/indexing/index_report.h"
#include "app/indexing/open_index.h"
#include "app/indexing/series_report.h"
#include "app/safe_text.h"

#include "index/file/index_series.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include <memory>
#include <optional>

namespace isochron::app {
namespace {

struct InfoArguments {
    BuildArguments sources;
    bool json = false, tree = false, measure_time = false;
};

/// Describes files, even where they leave open which array is meant: only `info` needs no choice.
void describe_sources(BuildArguments arguments, bool in_json) {
    arguments.read.any_array = true;
    const auto files = expand_patterns(arguments.files);
    std::optional<ProgressBar> bar(std::in_place);
    const BuildSources sources = open_sources(files, arguments, bar->progress());
    bar.reset(); // its line ends before the description
    const std::string name = fmt::format("{}", fmt::join(arguments.files, " "));
    if (in_json)
        print_safely(SafeText::json(source_json(name, *sources.volume)));
    else
        print_safely(source_text(name, *sources.volume));
}

void run_info(const InfoArguments& given) {
    const BuildArguments arguments = with_path_within(given.sources);
    set_up_readers(arguments);
    const std::string& first = arguments.files.front();
    std::error_code ignored;
    const bool is_data = arguments.files.size() > 1 ||
                         (std::filesystem::path(first).extension() != ".isochron" &&
                          !(std::filesystem::exists(first, ignored) && index::is_index(first)));
    if (is_data && given.tree)
        throw UsageError(fmt::format("--tree: {} is not an index", first));
    if (is_data && given.measure_time)
        throw UsageError(fmt::format("--measure-time: {} is not an index", first));
    if (is_data)
        return describe_sources(arguments, given.json);
    const auto file = array_called(open_index(first), arguments.read.array);
    const IndexReport report{first, *file, given.tree, given.measure_time};
    if (given.json)
        print_safely(SafeText::json(as_json(report)));
    else
        print_safely(as_text(report));
}

} // namespace

void add_info(Command& program) {
    auto arguments = std::make_shared<InfoArguments>();
    Command command = program.subcommand("info", "Describe an index, or the files of a series.");
    command.examples({"isochron info 'run42/*.vti'", "isochron info run42.isochron --json"});
    command.option("files", arguments->sources.files, "Index, or files that `build` accepts")
        .required()
        .type_name("FILES");
    command.flag("--tree", arguments->tree,
                 "Print the number of cells stored at every time node of the paper's tree, if the "
                 "index has it");
    command.flag(
        "--measure-time", arguments->measure_time,
        "Measure anew how well the blend of two steps stands for what lies between them, and say "
        "whether to show the blend there or the step before (hold); else what the build measured "
        "is "
        "said, by which `explore` goes");
    command.flag("--json", arguments->json, "Print one JSON object");
    add_reading_options(command, arguments->sources);
    command.footer(
        "Sizes along axes are in the length unit of the files, times in their time unit, values\n"
        "scaled and in their unit. Coherence is entries for each cell and step, in the same tree "
        "as\n"
        "--tree: 1 when nothing merges in time and every cell has two values. Raw is steps x cells "
        "x 24\n"
        "bytes. JSON keys: file, array, vertices, cells,\n"
        "spacing, uneven (by axis whose spacing is a mean: the least and the greatest one),\n"
        "origin, direction (three axes), handedness (right or left), physical_size,\n"
        "length_unit, anatomy (none, ras, lps or enu), steps, times, time_unit, dates (null "
        "unless\n"
        "the unit has a reference date), uniform_time, type,\n"
        "slope, intercept, low, high (of finite values), value_unit, nan_values, histogram (256\n"
        "equal bins over low to high), file_bytes, volume_bytes, bricks_bytes, tree_bytes,\n"
        "unused_bytes (of tiers that earlier versions built), staying_chunks and staying_percent "
        "(chunks that are as in the "
        "step before, of those of all steps but the first), raw_bytes, percent_of_raw (file "
        "without volume), tiers, plan\n"
        "(why these), levels, lossless, refers_to (files; null when it carries the values),\n"
        "arrays (all that have search structures: array, value_unit, type, low, high, nan_values, "
        "tiers,\n"
        "content_hash; the other keys are of the first, or of the one that --array names),\n"
        "color (only with an array to color by: array, value_unit, type, low, high, nan_values,\n"
        "bytes), lattice and max_variation (of the paper's tree), tree_entries and coherence (only "
        "with a\n"
        "tree), content_hash, sources, notes, between (null where it is not known: advice, hold or "
        "blend,\n"
        "expected_voxels, every_second_voxels, every_fourth_voxels, lone_parts, compared_cells), "
        "tree (only "
        "with --tree: first_step, last_step, "
        "depth\n"
        "and cells of each node, depth first). Of files of values: file to intercept as above, "
        "first_step\n(low, high, nan_values), arrays (all that there are), sources and notes.");
    command.on_run([arguments] { run_info(*arguments); });
}

} // namespace isochron::app
