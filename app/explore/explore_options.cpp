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
    text +=
        "\nIn a cluster, `mpirun -n N isochron explore ...`, each process opens the windows of its "
        "node, and the first process reads the devices; see docs/guide/clusters.md.\n";
    return text;
}

} // namespace

void add_explore_options(Command& command, ExploreOptions& options) {
    command.option(
        "files FILE", options.sources.files,
        "Index that `isochron build` wrote. Or volume files, of which an index is made in "
        "your cache folder. Without FILE, a window lets you choose");
    command
        .option("--config FILE", options.config,
                fmt::format("Configuration: a TOML file, or the name of a shipped one: {}",
                            fmt::join(shipped_config_names(), ", ")))
        .shows_default();
    command.option("--check-config FILE", options.check_config,
                   "List the windows, screens, viewers and devices of this configuration and its "
                   "errors, and end");
    command.option("--picture FILE", options.picture,
                   "With --check-config, draw a floor plan and elevations of the room, with walls, "
                   "eyes, trackers and data, into this file (.png, .tif, .jpg, .exr)");
    command.flag("--emulate", options.emulate,
                 "Show the whole installation in one window: the room from outside, with the "
                 "picture on every wall");
    command
        .option(
            "--context CONTEXT", options.context,
            "OpenGL context: glfw opens windows, egl serves where a headset is the only display")
        .one_of({"glfw", "egl"});
    command.option("--stereo MODE", options.stereo, "Stereo mode to begin with")
        .one_of(words_of<stereo::StereoMode>());
    command.option("--quality MODE", options.quality, "Quality mode to begin with")
        .one_of(interaction::all_names<interaction::QualityMode>());
    command
        .option(
            "--footprint FOOTPRINT", options.footprint,
            "How cells are drawn once nothing moves: auto (the exact surface), gaussian, mesh or "
            "surface")
        .one_of(words_of<SettledFootprint>(kSettledField));
    add_shape_option(command, options.shape);
    command
        .option("--size PIXELS PIXELS", options.size,
                "Size of each window, or with --emulate of the window that shows the room")
        .between(16, 16384);
    command.option("--isovalue VALUE", options.isovalue,
                   "Isovalue to begin with, in the unit of the values");
    command.option("--step STEP", options.step, "Step to begin with, from 0");
    command
        .option("--between MODE", options.between,
                "What to show between two steps: `hold` shows the step before, `blend` a blend of "
                "both (key Ctrl + T)")
        .one_of(interaction::all_names<interaction::BetweenSteps>());
    command.option(
        "--model FILE", options.models,
        "Show the triangles of this file beside the surfaces, in the data's coordinates: "
        ".stl, .ply, .obj, .vtp, .gltf, .glb; may be given several times");
    command.flag("--follow", options.follow,
                 "Show the last step, and each new one that `build --append` adds (key End)");
    add_control_option(command, options.control);
    command.option("--record FILE", options.record, "Record the session in this file (JSON Lines)");
    command.flag("--force", options.force,
                 "Let --record replace a recording, and --report, --session and --picture any file "
                 "but one that is read; without this option they replace only a report, a session "
                 "and a picture");
    command.option(
        "--session FILE", options.session,
        "Save the session in this file (NAME.isochron-session) instead of your state folder; "
        "it is saved every 30 s and at the end");
    command.flag("--resume", options.resume,
                 "Continue the last session on these data, or the session in --session");
    command.option(
        "--story FILE", options.story,
        "Tell the story in this file: NAME.isochron-story, a file of keys that have texts "
        "(docs/FORMATS.md), or a session with such keys. A story that names its data is "
        "opened alone, too, as FILE");
    command.option("--report FILE", options.report,
                   "Write the times of each frame's stages to this JSON file");
    command
        .option("--screenshots FOLDER", options.screenshots,
                "Folder for screenshots (key P); it is made where it is missing")
        .shows_default();
    command.option("--seconds SECONDS", options.seconds, "End the session after this time")
        .positive();
    command.flag("--list-devices", options.list_devices,
                 "List the devices that the configuration names, and end; this needs no index");
    command.flag("--test-pattern", options.test_pattern,
                 "Show a test pattern instead of data: the letter of each eye, the name of each "
                 "wall, a cross at a known depth, and the axes of every device");
    command.flag("--no-panel", options.no_panel, "Begin with the panel hidden; Tab shows it");
    add_reading_options(command, options.sources);
    command.footer(footer());
}

} // namespace isochron::app
