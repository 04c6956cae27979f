// `isochron info`: what an index holds.
#include "app/commands.h"
#include "app/index_report.h"
#include "app/progress_bar.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <unistd.h>

#include <memory>

namespace isochron::app {
namespace {

struct InfoArguments {
    std::filesystem::path file;
    bool json = false, tree = false, verify = false;
};

void run_info(const InfoArguments& arguments) {
    const auto file = index::IndexFile::open(arguments.file);
    if (arguments.verify) {
        ProgressBar bar;
        file->verify([&](std::string_view phase, double fraction) {
            if (isatty(STDERR_FILENO))
                bar.show(fmt::format("verifying {}", phase), fraction);
        });
    }
    const IndexReport report{arguments.file.string(), *file, arguments.tree, arguments.verify};
    fmt::print("{}", arguments.json ? as_json(report) : as_text(report));
}

} // namespace

void add_info(CLI::App& program) {
    auto arguments = std::make_shared<InfoArguments>();
    CLI::App* command = program.add_subcommand("info", "Print what an index holds.");
    command->add_option("file", arguments->file, "Index")->required()->type_name("NAME.isochron");
    command->add_flag("--tree", arguments->tree, "Print the cells stored at every time node");
    command->add_flag("--verify", arguments->verify,
                      "Compare the checksums of all sections first: reads the whole file");
    command->add_flag("--json", arguments->json, "Print one JSON object");
    command->footer(
        "Sizes along axes are in the length unit of the files, times in their time unit, values\n"
        "scaled and in their unit. Coherence is tree entries per cell-step: 1 when nothing merges\n"
        "in time. Raw is steps x cells x 24 bytes. JSON keys: file, array, vertices, cells,\n"
        "spacing, origin, direction (three axes), handedness (right or left), physical_size,\n"
        "length_unit, anatomy (none, ras or lps), steps, times, time_unit, uniform_time, type,\n"
        "slope, intercept, low, high (of finite values), value_unit, nan_values, histogram (256\n"
        "equal bins over low to high), file_bytes, volume_bytes, tree_bytes, raw_bytes,\n"
        "percent_of_raw (file without volume), lattice, max_variation, tree_entries and coherence\n"
        "(only with a tree), content_hash, sources, notes, tree (only with --tree: first_step,\n"
        "last_step, depth and cells of each node, depth first), verified (only with --verify).");
    command->callback([arguments] { run_info(*arguments); });
}

} // namespace isochron::app
