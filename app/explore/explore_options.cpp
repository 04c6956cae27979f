// The command line options of `explore`.
#include "app/explore/explore_options.h"

#include "app/config/config_words.h"
#include "app/config/shipped_configs.h"
#include "app/explore/control_options.h"
#include "app/explore/drawing_options.h"
#include "app/output/room_camera.h"
#include "interaction/controls/controls.h"
#include "stereo/stereo_mode.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace isochron::app {
namespace {

std::string footer() {
    std::string text;
    for (const interaction::ControlGroup& group : interaction::Controls::documentation()) {
        text += fmt::format("{}:\n", words_of(group.device));
        for (const std::string& line : group.lines)
            text += "  " + line + "\n";
        text += "\n";
    }
    text += "With --emulate:\n";
    for (const std::string& line : RoomCamera::documentation())
        text += "  " + line + "\n";
    text += "\nIn a cluster (mpirun -n N isochron explore ...) each process opens the windows of "
            "its node;\nthe first one reads the devices. See docs/guide/clusters.md.\n";
    text += "\nExit status: 0 done, 1 bad input, 2 bad usage.";
    return text;
}

} // namespace

void add_explore_options(Command& command, ExploreOptions& options) {
    command
        .option("files", options.sources.files,
                "Index made by `isochron build`, or volume files: their index is then built in the "
                "user's cache folder. Without files, the window offers a choice")
        .type_name("FILES");
    command
        .option("--config", options.config,
                fmt::format("TOML file, or the name of a shipped one: {}",
                            fmt::join(shipped_config_names(), ", ")))
        .shows_default();
    command.option("--check-config", options.check_config,
                   "List the windows, screens, viewers and devices of this configuration and its "
                   "errors, and exit");
    command.option("--picture", options.picture,
                   "With --check-config: draw floor plan and elevations of the room, with walls, "
                   "eyes, trackers and data, into this file (.png, .tif, .jpg, .exr)");
    command.flag("--emulate", options.emulate,
                 "Show the whole installation in one window: the room from outside, with the "
                 "picture on every wall");
    command
        .option("--context", options.context,
                "GL context: glfw (a window), or egl if a headset is the only display")
        .one_of({"glfw", "egl"});
    command.option("--stereo", options.stereo, "Stereo mode to start in")
        .one_of(words_of<stereo::StereoMode>());
    command.option("--quality", options.quality, "auto, fast, quality or paper")
        .one_of(interaction::all_names<interaction::QualityMode>());
    command
        .option("--footprint", options.footprint,
                "Footprint once nothing moves: auto (the exact surface), gaussian, "
                "mesh or surface")
        .one_of(words_of<SettledFootprint>(kSettledField));
    add_shape_option(command, options.shape);
    command
        .option("--size", options.size,
                "Size of each window in pixels, or of the room with --emulate")
        .values(2)
        .between(16, 16384);
    command.option("--isovalue", options.isovalue, "Isovalue to start with, in data units");
    command.option("--step", options.step, "Step to start at, from 0");
    command
        .option("--between", options.between,
                "Between two steps: hold the step before, or blend both (key Ctrl + T)")
        .one_of(interaction::all_names<interaction::BetweenSteps>());
    command.flag("--follow", options.follow,
                 "Show the last step, and each new one as `build --append` adds it (key End)");
    add_control_option(command, options.control);
    command.option("--record", options.record, "Record the session to this file (JSON Lines)");
    command.flag(
        "--force", options.force,
        "Let --record replace an existing recording, and --report, --session and --picture any "
        "file but one that is read; else these replace only a report, a session, a picture");
    command.option("--session", options.session,
                   "Save the session in this file (NAME.isochron-session) instead of the user's "
                   "state folder; it is saved every 30 s and at the end");
    command.flag("--resume", options.resume,
                 "Continue the last session on these data, or the one in --session");
    command.option("--report", options.report,
                   "Write the times of every frame's stages to this JSON file");
    command
        .option("--screenshots", options.screenshots,
                "Folder for screenshots (key P); created if missing")
        .shows_default();
    command.option("--seconds", options.seconds, "Exit after this many seconds").positive();
    command.flag("--list-devices", options.list_devices,
                 "List the devices that the configuration names, and exit; needs no index");
    command.flag("--test-pattern", options.test_pattern,
                 "Show a test pattern instead of data: each eye's letter, each wall's name, a "
                 "cross at a known depth, the axes of every device; needs no index");
    command.flag("--verbose", options.verbose, "Also print the messages of the OpenXR loader");
    command.flag("--no-panel", options.no_panel, "Start with the panel hidden (Tab shows it)");
    add_reading_options(command, options.sources);
    command.footer(footer());
}

} // namespace isochron::app
