// `isochron info`: what an index holds.
#include "app/commands/index_report.h"
#include "app/commands/open_index.h"
#include "app/commands/subcommands.h"

#include <fmt/format.h>

#include <memory>

namespace isochron::app {
namespace {

struct InfoArguments {
    std::filesystem::path file;
    bool json = false, tree = false;
};

void run_info(const InfoArguments& arguments) {
    const auto file = open_index(arguments.file);
    const IndexReport report{arguments.file.string(), *file, arguments.tree};
    fmt::print("{}", arguments.json ? as_json(report) : as_text(report));
}

} // namespace

void add_info(Command& program) {
    auto arguments = std::make_shared<InfoArguments>();
    Command command = program.subcommand("info", "Print what an index holds.");
    command.option("file", arguments->file, "Index").required().type_name("NAME.isochron");
    command.flag("--tree", arguments->tree,
                 "Print the cells stored at every time node: of the paper's tree where there "
                 "is one, else of the cells");
    command.flag("--json", arguments->json, "Print one JSON object");
    command.footer(
        "Sizes along axes are in the length unit of the files, times in their time unit, values\n"
        "scaled and in their unit. Coherence is entries for each cell and step, in the same tree "
        "as\n"
        "--tree: 1 when nothing merges in time and every cell has two values. Raw is steps x cells "
        "x 24\n"
        "bytes. JSON keys: file, array, vertices, cells,\n"
        "spacing, origin, direction (three axes), handedness (right or left), physical_size,\n"
        "length_unit, anatomy (none, ras, lps or enu), steps, times, time_unit, uniform_time, "
        "type,\n"
        "slope, intercept, low, high (of finite values), value_unit, nan_values, histogram (256\n"
        "equal bins over low to high), file_bytes, volume_bytes, bricks_bytes, cells_bytes,\n"
        "deltas_bytes, tree_bytes, raw_bytes, percent_of_raw (file without volume), tiers, plan\n"
        "(why these), levels, lossless, refers_to (files; null when it carries the values),\n"
        "color (only with an array to color by: array, value_unit, type, low, high, nan_values,\n"
        "bytes), lattice and max_variation (of the paper's tree), tree_entries and coherence (only "
        "with a\n"
        "tree), content_hash, sources, notes, tree (only with --tree: first_step, last_step, "
        "depth\n"
        "and cells of each node, depth first).");
    command.on_run([arguments] { run_info(*arguments); });
}

} // namespace isochron::app
