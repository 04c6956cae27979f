// The options that all replaying commands share.
#include "app/explore/replay_source.h"

#include "app/config/config_words.h"
#include "app/explore/drawing_options.h"
#include "app/explore/kept_session.h"
#include "app/indexing/open_index.h"
#include "app/telling.h"
#include "index/system/links/link.h"

#include <filesystem>

namespace isochron::app {

namespace fs = std::filesystem;

void add_replay_source(Command& command, ReplaySource& source, const std::string& what) {
    command.option("recording FILE", source.recording, what).required();
    command.option("--data INDEX", source.data,
                   "Index to use instead of the recorded one; a relative path is tried from the "
                   "recording's folder, too");
    command.flag("--any-data", source.any_data,
                 "Accept data that differ from the recorded ones, as their hashes tell");
    command
        .option("--size PIXELS PIXELS", source.size,
                "Size of each window's pictures, or with --emulate of the picture of the room "
                "(default: as recorded)")
        .between(16, 16384);
    command
        .option("--samples COUNT", source.samples,
                "Number of samples per pixel (default: as configured, or 4)")
        .between(1, 64);
    command.option("--model FILE", source.models,
                   "Let the recording show this file of triangles, though it lies outside of the "
                   "folders of recording and data; may be given several times");
    command.flag("--emulate", source.emulate,
                 "Show the whole room from outside, with the picture on every wall");
    command.option("--stereo MODE", source.stereo, "Stereo mode to use instead of the recorded one")
        .one_of(words_of<stereo::StereoMode>());
    command
        .option("--quality MODE", source.quality, "Quality mode to use instead of the recorded one")
        .one_of(interaction::all_names<interaction::QualityMode>());
    command
        .option(
            "--footprint FOOTPRINT", source.footprint,
            "How cells are drawn in a picture at rest, instead of the configured way: auto (the "
            "exact surface), gaussian, mesh or surface")
        .one_of(words_of<SettledFootprint>(kSettledField));
    command.flag("--ray", source.ray,
                 "Also show the ray of the wand and what the cursor points at");
    command.flag("--caption", source.caption,
                 "Add isovalue, time, axes and a scale bar to the pictures");
    command
        .option("--picture-background BACKGROUND", source.background,
                "Background of the pictures instead of the recorded one. Movies are white where "
                "it is transparent")
        .one_of(interaction::all_names<interaction::WrittenBackground>());
    command
        .option("--dpi DPI", source.dpi,
                "Pixels per inch that the picture files state (default: none)")
        .between(1.0, interaction::kMostDpi);
    add_shape_option(command, source.shape);
    command.option(
        "--config FILE", source.config,
        "Configuration to use instead of the recorded one: a TOML file, or the name of a "
        "shipped configuration");
    command
        .option("--context CONTEXT", source.context,
                "OpenGL context to draw with (default: egl, or glfw with --live)")
        .one_of({"glfw", "egl", "osmesa"});
}

Config config_of(const ReplaySource& options, const interaction::RecordingHeader& header) {
    Config config =
        options.config ? read_config(*options.config)
                       : parse_config(header.configuration, options.recording + " (configuration)");
    // A recording made in a window replays without one unless a window is asked for.
    config.rendering.context = options.live ? stereo::ContextKind::glfw : stereo::ContextKind::egl;
    if (options.context)
        config.rendering.context = *stereo::context_kind_from_name(*options.context);
    if (header.window[0] >= 16 && header.window[1] >= 16 && !options.config) {
        config.installation.windows.front().size = {header.window[0], header.window[1]};
        config.pictures.text = static_cast<float>(header.text);
    }
    if (options.footprint)
        config.quality.settled = value_of<SettledFootprint>(*options.footprint);
    set_shape(config, options.shape);
    config.pictures.samples = options.samples.value_or(config.pictures.samples);
    config.pictures.ray = config.pictures.ray || options.ray;
    config.pictures.caption = config.pictures.caption || options.caption;
    if (options.background)
        config.pictures.background =
            *interaction::value_named<interaction::WrittenBackground>(*options.background);
    config.pictures.dpi = options.dpi.value_or(0);
    for (stereo::Window& window : config.installation.windows) {
        if (!options.size.empty() && !options.emulate)
            window.size = {options.size[0], options.size[1]};
        window.fullscreen = false; // a replay must not take over the displays
    }
    return config;
}

std::shared_ptr<const index::IndexFile> data_of(const ReplaySource& options,
                                                const interaction::RecordingHeader& header,
                                                const Config& config) {
    std::string path = options.data.value_or(header.data);
    std::error_code ignored;
    if (!options.data && !index::is_link(path) && !fs::exists(path, ignored)) {
        // A relative path refers to the folder where the session was started; try the recording's
        // folder too.
        path = (fs::path(options.recording).parent_path() / header.data).string();
        if (!fs::exists(path, ignored))
            throw interaction::Error(
                "{}: recorded on {}, which was not found; give its path with --data",
                options.recording, header.data);
    }
    auto file = open_index_to_show(path, config.memory.cache_bytes());
    if (const std::string note = other_reading(options.recording, header.reading, *file);
        !note.empty())
        print_note("{}", note);
    if (!options.any_data && !other_data(header, *file).empty())
        throw interaction::Error("{}: recorded on other data: expected hash {}, {} has {} "
                                 "(--any-data replays all the same)",
                                 options.recording, header.data_hash, path, data_hash_of(*file));
    return file;
}

Reads reads_of(const ReplaySource& options, const index::IndexFile* file) {
    Reads reads{{options.recording}, file};
    if (options.config)
        reads.files.emplace_back(*options.config);
    if (file)
        reads.files.emplace_back(file->name());
    return reads;
}

std::string other_data(const interaction::RecordingHeader& header, const index::IndexFile& file) {
    // A recording without a hash, such as a demonstration, is not bound to one data set. Data may
    // have grown since they were recorded on.
    if (header.data_hash.empty() || held_hash(file, header.data_hash) == header.data_hash)
        return {};
    return header.data_hash;
}

std::string data_name(const ReplaySource& options, const interaction::RecordingHeader& header) {
    return fs::path(options.data.value_or(header.data)).filename().string();
}

stereo::Windows windows_of(const ReplaySource& options, const Config& config,
                           const interaction::RecordingHeader& header, const ClusterJob& job) {
    const std::string title = "Isochron: " + options.recording;
    if (options.emulate) {
        stereo::ContextOptions room{.title = title};
        if (!options.size.empty())
            room.size = {options.size[0], options.size[1]};
        return open_room(config.rendering.context, config.installation, room);
    }
    const std::string mode = options.stereo.value_or(header.start.stereo.value_or(""));
    return open_windows(config.rendering.context, config.installation,
                        {.title = title,
                         .vsync = config.rendering.vsync,
                         .stereo = stereo::stereo_mode_from_name(mode).value_or(
                             config.installation.windows.front().stereo),
                         .rank = job.rank(),
                         .ranks = job.size()});
}

void let_show_models(const ReplaySource& options, Session& session) {
    session.models().add_folder(fs::path(options.recording).parent_path());
    for (const std::string& file : options.models)
        session.models().allow(fs::absolute(file));
}

void say_faults(const ModelSupply& models) {
    for (const std::string& line : models.faults())
        print_note("{}", line);
}

ReplayOptions replay_options(const ReplaySource& options) {
    ReplayOptions replay;
    replay.any_data = options.any_data;
    if (options.stereo)
        replay.stereo = stereo::stereo_mode_from_name(*options.stereo);
    if (options.quality)
        replay.quality = value_of<interaction::QualityMode>(*options.quality, "quality mode");
    return replay;
}

} // namespace isochron::app
