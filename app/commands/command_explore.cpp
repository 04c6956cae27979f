// `isochron explore`: the live program, in a window.
#include "app/command_line/subcommands.h"
#include "app/config/check_config.h"
#include "app/config/tracker_setup.h"
#include "app/explore/exploration.h"
#include "app/explore/explore_start.h"
#include "app/output/guarded_outputs.h"
#include "app/output/picture_note.h"
#include "app/output/room_plan.h"
#include "app/telling.h"
#include "stereo/image_file.h"

#include <nlohmann/json.hpp>

#include <memory>
#include <string>
#include <vector>

namespace isochron::app {
namespace {

/// Draws the room of a configuration into the file that the options name.
void draw_room(const Config& config, const ExploreOptions& options) {
    if (!stereo::is_picture_name(*options.picture))
        throw UsageError(
            "--picture: expected a name that ends with .png, .tif, .jpg or .exr, got {}",
            *options.picture);
    guard_outputs({{*options.picture, OutputKind::picture}}, {{*options.check_config}},
                  options.force);
    stereo::write_image(room_plan(config, problems_of(config)), *options.picture,
                        note_of_room_plan());
}

/// Describes the configuration or its devices if the options ask for that.
/// @return true: the options ask for nothing else
bool only_describes(const ExploreOptions& options) {
    if (options.picture && !options.check_config)
        throw UsageError("--picture draws a configuration: expected --check-config FILE, too");
    if (options.check_config) {
        const Config config = read_config(*options.check_config);
        if (options.picture)
            draw_room(config, options);
        check_config(config);
        return true;
    }
    if (!options.list_devices)
        return false;
    const Config config = configure(options);
    const std::vector<std::string> devices = describe_devices(config);
    const std::vector<ConfigProblem> problems = device_problems_of(config);
    tell_result({{"configuration", config.name},
                 {"devices", devices},
                 {"problems", json_of(problems, config)}});
    for (const std::string& line : devices)
        print_answer("{}\n", line);
    for (const ConfigProblem& problem : problems)
        print_answer("{}\n", line_of(problem, config));
    return true;
}

} // namespace

void add_explore(Command& program) {
    auto options = std::make_shared<ExploreOptions>();
    Command command =
        program.subcommand("explore", "Explore an index, or volume files, in a window.");
    command.examples({"isochron explore run42.isochron", "isochron explore --check-config cave4"});
    add_explore_options(command, *options);
    command.on_run([options] {
        if (!only_describes(*options))
            run_in_cluster([&](ClusterJob& job) { explore(*options, job); });
    });
}

} // namespace isochron::app
