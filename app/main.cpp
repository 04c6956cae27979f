// The program and its subcommands.
#include "app/command_line/subcommands.h"
#include "app/output/leftover_files.h"
#include "commit.h"
#include "index/readers/process/file_fence.h"

#include <string>
#include <string_view>

namespace {

/// The lines of --version that help with reports of errors.
std::string version_details() {
    std::string details =
        kSinceRelease + std::string("\ncommit ") + kCommit + "\nwith " ISOCHRON_PARTS_WITH;
    constexpr std::string_view kWithout = ISOCHRON_PARTS_WITHOUT;
    if (!kWithout.empty())
        details.append("; without ").append(kWithout);
    if (isochron::index::file_fence_version() < 1)
        details.append("\nthis kernel has no Landlock: readers can read every file that you can");
    return details;
}

} // namespace

int main(int argc, char** argv) {
    using namespace isochron::app;
    hold_standard_streams();
    remove_leftover_files(argc, argv);
    return run_program(
        {.name = "isochron",
         .description =
             "Explore isosurfaces of volume data that change over time, on a desktop, in a "
             "headset or in a CAVE.",
         .version_details = version_details,
         .examples = {"isochron build 'run42/*.vti' -o run42.isochron",
                      "isochron explore run42.isochron"},
         .first_commands = 5},
        {add_info,     add_build,  add_explore, add_replay, add_movie,
         add_figure,   add_export, add_query,   add_change, add_measure,
         add_table,    add_verify, add_serve,   add_tell,   add_reproduce,
         add_generate, add_config, add_help,    add_manual, add_completion},
        argc, argv);
}
