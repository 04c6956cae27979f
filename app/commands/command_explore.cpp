// `isochron explore`: the live program, in a window.
#include "app/command_line/subcommands.h"
#include "app/config/check_config.h"
#include "app/config/tracker_setup.h"
#include "app/explore/exploration.h"
#include "app/explore/explore_start.h"
#include "app/text.h"

#include <fmt/format.h>

#include <memory>

namespace isochron::app {
namespace {

/// Describes the configuration or its devices if the options ask for that.
/// @return true: the options ask for nothing else
bool only_describes(const ExploreOptions& options) {
    if (options.check_config) {
        check_config(read_config(*options.check_config));
        return true;
    }
    if (!options.list_devices)
        return false;
    const Config config = configure(options);
    for (const std::string& line : describe_devices(config))
        print_safely(fmt::format("{}\n", line));
    for (const ConfigProblem& problem : device_problems_of(config))
        print_safely(fmt::format("{}\n", line_of(problem, config)));
    return true;
}

} // namespace

void add_explore(Command& program) {
    auto options = std::make_shared<ExploreOptions>();
    Command command =
        program.subcommand("explore", "Explore an index, or files of values, in a window, live.");
    command.examples({"isochron explore run42.isochron", "isochron explore --check-config cave4"});
    add_explore_options(command, *options);
    command.on_run([options] {
        if (!only_describes(*options))
            run_in_cluster([&](ClusterJob& job) { explore(*options, job); });
    });
}

} // namespace isochron::app
