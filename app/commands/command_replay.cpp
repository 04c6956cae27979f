// `isochron replay`: a recording becomes pictures and measurements, or plays again in a window.
#include "app/command_line/progress_bar.h"
#include "app/command_line/subcommands.h"
#include "app/explore/cluster_job.h"
#include "app/explore/control_options.h"
#include "app/explore/replay_source.h"
#include "app/kept/recording_file.h"
#include "app/loop/pattern_show.h"
#include "app/output/guarded_outputs.h"
#include "app/output/picture_parts.h"
#include "app/telling.h"
#include "index/system/new_file.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <set>
#include <string>
#include <vector>

namespace isochron::app {
namespace {

namespace fs = std::filesystem;

struct Options : ReplaySource {
    std::optional<std::string> out, report, control;
    std::size_t every = 0;
    bool stamps = false, from_devices = false, test_pattern = false, force = false;
    std::string eyes = "window";
    std::string format = "png";
};

/// Writes the pictures of one frame under names that start with `stem`; adds them to `written`.
void write_pictures(Outputs& outputs, const Options& options, const PictureNames& names,
                    const PictureNote& frame, const std::string& stem,
                    std::vector<fs::path>& written) {
    const fs::path folder = *options.out;
    each_part(outputs, options.eyes == "each", names, frame,
              [&](const PictureNote& note, const std::string& suffix, render::Image image) {
                  outputs.pictures().wait_for_room();
                  written.push_back(folder / fmt::format("{}{}.{}", stem, suffix, options.format));
                  outputs.write_image(std::move(image), written.back(),
                                      note.data_hash.empty() ? note_of_test_pattern()
                                                             : text_of(note));
              });
}

int report_differences(const std::vector<std::string>& lines, std::size_t frames) {
    constexpr std::size_t kShown = 20;
    for (std::size_t i = 0; i < std::min(lines.size(), kShown); ++i)
        print_safely(stderr, "differs: {}\n", lines[i]);
    tell_result({{"different_frames", lines.size()}});
    print_report("commands recomputed from devices: {} of {} frames differ\n", lines.size(),
                 frames);
    return lines.empty() ? 0 : 1;
}

void check(const Options& options) {
    if ((options.every > 0 || options.stamps) && !options.out)
        throw UsageError("--every and --stamps need --output FOLDER");
    if (options.out && options.every == 0 && !options.stamps)
        throw UsageError("--output writes nothing without --every N or --stamps");
    if (options.live && (options.every > 0 || options.stamps || options.from_devices))
        throw UsageError("--live does not go with --every, --stamps or --from-devices");
    if (options.control && !options.live)
        throw UsageError("--control needs --live");
    if (options.test_pattern && (options.live || options.report || options.from_devices))
        throw UsageError("--test-pattern does not go with --live, --report or --from-devices");
}

/// The names of a frame's pictures, without what is added for windows and eyes.
std::vector<std::string> stems_of(const Options& options, std::size_t number,
                                  const interaction::RecordedFrame& frame) {
    std::vector<std::string> stems;
    if (options.every > 0 && number % options.every == 0)
        stems.push_back(fmt::format("frame_{:05}", number));
    if (options.stamps)
        for (const std::string& stamp : frame.commands.stamps)
            stems.push_back(fmt::format("stamp_{:05}_{}", number, file_name(stamp)));
    return stems;
}

/// What may be added to such a name.
std::set<std::string> suffixes_of(const PictureNames& names) {
    std::set<std::string> suffixes{""}; // the picture of the room has none
    for (const PictureNames::Window& window : names.windows) {
        suffixes.insert({window.suffix, window.suffix + "_left", window.suffix + "_right"});
        for (const std::string& viewport : window.viewports)
            for (const stereo::Eye eye :
                 {stereo::Eye::left, stereo::Eye::right, stereo::Eye::center})
                suffixes.insert(fmt::format("{}_{}", viewport, name_of(eye)));
    }
    return suffixes;
}

/// Guards the report, and the pictures of earlier replays in the same folder.
void guard_files(const Options& options, const interaction::Recording& recording,
                 const PictureNames& names, const ClusterJob& job, const index::IndexFile* file) {
    std::vector<Output> outputs;
    if (options.report)
        outputs.push_back({job.own_file(*options.report), OutputKind::report});
    std::error_code none;
    const fs::path folder = options.out.value_or("");
    if (options.out && fs::is_directory(folder, none)) {
        const std::set<std::string> suffixes = suffixes_of(names);
        std::set<std::string> stems;
        for (std::size_t number = 0; number < recording.frames.size(); ++number)
            for (std::string& stem : stems_of(options, number, recording.frames[number]))
                stems.insert(std::move(stem));
        for (const auto& entry : fs::directory_iterator(folder, none)) {
            const fs::path& path = entry.path();
            const std::string name = path.stem().string();
            if (entry.is_regular_file(none) && path.extension() == "." + options.format &&
                std::ranges::any_of(suffixes, [&](const std::string& suffix) {
                    return name.ends_with(suffix) &&
                           stems.contains(name.substr(0, name.size() - suffix.size()));
                }))
                outputs.push_back({path, OutputKind::picture});
        }
    }
    guard_outputs(outputs, reads_of(options, file), options.force);
}

/// Writes the pictures of one frame if the options ask for them.
/// @param note describes what the frame shows; it is empty for a test pattern
void write_pictures(Outputs& outputs, const Options& options, const PictureNames& names,
                    std::size_t number, const interaction::RecordedFrame& frame,
                    const std::function<PictureNote()>& note, std::vector<fs::path>& written) {
    for (const std::string& stem : stems_of(options, number, frame))
        write_pictures(outputs, options, names, note(), stem, written);
}

/// Tells of the pictures, and of the frames that were replayed.
void report_pictures(const Options& options, std::size_t frames,
                     const std::vector<fs::path>& written, bool leads) {
    nlohmann::ordered_json names = nlohmann::ordered_json::array();
    for (const fs::path& path : written) {
        print_report("wrote {}\n", path.string());
        names.push_back(path.string());
    }
    if (leads)
        tell_result({{"recording", options.recording}, {"frames", frames}, {"pictures", names}});
}

/// Replays the recorded heads and hands in front of the test pattern; needs no data.
void replay_test_pattern(const Options& options, ClusterJob& job) {
    interaction::Recording recording;
    Config config;
    PictureNames names;
    std::optional<PatternShow> opened;
    job.together([&] {
        check(options);
        recording = read_recording(options.recording);
        config = config_of(options, recording.header);
        names = picture_names(config.installation);
        prepare_walls(config, job, options.emulate);
        guard_files(options, recording, names, job, nullptr);
        if (options.out)
            index::make_folder(*options.out);
    });
    job.require_same(facts_of(config));
    job.set_limits(config.cluster.limits);
    job.together([&] {
        opened.emplace(config, windows_of(options, config, recording.header, job));
        opened->obey(recording.header.start);
        if (options.stereo)
            opened->set_stereo(*stereo::stereo_mode_from_name(*options.stereo));
    });
    PatternShow& show = *opened;
    job.require_same({{"stereo mode", std::string(stereo::name_of(show.stereo()))}});
    job.tell_shared_processors(show.outputs().gl());
    job.share_frames(show);
    std::vector<fs::path> written;
    const auto done = [&](std::size_t number, const interaction::RecordedFrame& frame) {
        write_pictures(
            show.outputs(), options, names, number, frame, [] { return PictureNote{}; }, written);
    };
    if (job.leads())
        replay_pattern(show, recording, replay_options(options), done);
    else
        job.follow(show, done);
    show.frames().end();
    show.outputs().pictures().finish();
    report_pictures(options, recording.frames.size(), written, job.leads());
    job.finish();
}

/// Everything that is read before the first frame.
struct Prepared {
    interaction::Recording recording;
    Config config;
    PictureNames names;
    std::shared_ptr<const index::IndexFile> file;
    ReplayOptions replay;
};

Prepared prepare(const Options& options, const ClusterJob& job) {
    check(options);
    Prepared all;
    all.recording = read_recording(options.recording);
    if (!all.recording.note.empty() && job.leads())
        print_note("note: {}", all.recording.note);
    all.config = config_of(options, all.recording.header);
    all.names = picture_names(all.config.installation);
    prepare_walls(all.config, job, options.emulate);
    all.file = data_of(options, all.recording.header, all.config);
    guard_files(options, all.recording, all.names, job, all.file.get());
    all.replay = replay_options(options);
    all.replay.from_devices = options.from_devices;
    return all;
}

/// @return one line per frame whose recomputed commands differ
std::vector<std::string> show(Session& session, const Prepared& all, const Options& options,
                              ClusterJob& job, const FrameDone& done) {
    std::vector<std::string> different;
    if (!job.leads()) {
        job.follow(session, done);
    } else if (options.live) {
        const auto control = opened_control(options.control, session, {.only_watches = true});
        replay_live(session, all.recording, all.replay, all.config.rendering.frame_rate_limit,
                    control.get());
    } else {
        ProgressBar bar;
        const auto frames = static_cast<double>(all.recording.frames.size());
        different =
            replay_fixed_step(session, all.recording, all.replay,
                              [&](std::size_t number, const interaction::RecordedFrame& frame) {
                                  done(number, frame);
                                  bar.show("replaying", static_cast<double>(number + 1) / frames);
                              });
    }
    session.frames().end();
    return different;
}

void replay(const Options& options, ClusterJob& job) {
    if (options.test_pattern)
        return replay_test_pattern(options, job);
    std::optional<Prepared> prepared;
    job.together([&] { prepared = prepare(options, job); });
    const Prepared& all = *prepared;
    job.require_same(facts_of(all.config, *all.file));
    job.set_limits(all.config.cluster.limits);
    std::optional<Session> opened;
    job.together([&] {
        opened.emplace(all.config, all.file,
                       windows_of(options, all.config, all.recording.header, job));
        opened->set_data_name(data_name(options, all.recording.header),
                              other_data(all.recording.header, *all.file));
        let_show_models(options, *opened);
        opened->set_state(
            start_of(all.recording.header, opened->state(), all.file->info().steps(), all.replay));
        if (options.out)
            index::make_folder(*options.out);
        if (options.report)
            opened->log().report_to(job.own_file(*options.report));
    });
    Session& session = *opened;
    job.require_same(start_fact(session));
    job.tell_shared_processors(session.outputs().gl());
    job.share_frames(session);

    std::vector<fs::path> written;
    const auto done = [&](std::size_t number, const interaction::RecordedFrame& frame) {
        write_pictures(
            session.outputs(), options, all.names, number, frame, [&] { return session.note(); },
            written);
    };
    const std::vector<std::string> different = show(session, all, options, job, done);
    session.outputs().pictures().finish();
    if (job.leads())
        say_faults(session.models());
    report_pictures(options, all.recording.frames.size(), written, job.leads());
    if (options.report)
        session.log().finish_report(session.drawing(), session.reading());
    job.finish();
    if (!job.leads())
        return;
    tell_result({{"drawn_by", session.drawing()}});
    if (options.report)
        tell_result({{"report", *options.report}});
    print_report("{}\n{}", session.drawing(), SafeText::lines(session.log().table()));
    if (options.from_devices && report_differences(different, all.recording.frames.size()) != 0)
        throw interaction::Error(options.recording +
                                 ": the devices no longer lead to its commands");
}

} // namespace

void add_replay(Command& program) {
    auto options = std::make_shared<Options>();
    Command command = program.subcommand(
        "replay",
        "Replay a recording: write pictures, measure the times of frames, or play it in a "
        "window.");
    command.examples({"isochron replay walk.jsonl --stamps -o pictures",
                      "isochron replay walk.jsonl --every 30 --caption -o series"});
    add_replay_source(command, *options);
    command.option("-o,--output,--out FOLDER", options->out,
                   "Folder for the pictures; it is made where it is missing");
    command.option("--every COUNT", options->every, "Write a picture of every Nth frame")
        .positive();
    command.flag("--stamps", options->stamps, "Write a picture at every stamp");
    command
        .option("--eyes EYES", options->eyes,
                "`window` writes one picture of what the window shows; `each` writes a picture for "
                "each eye of each viewport")
        .one_of({"window", "each"})
        .shows_default();
    command
        .option("--format FORMAT", options->format,
                "Format of the pictures: png, exr (linear light), tiff, or jpg (with losses)")
        .one_of({"png", "exr", "tiff", "jpg"})
        .shows_default();
    command.option("--report FILE", options->report,
                   "Write the times and the state of every frame to this JSON file");
    command.flag(
        "--force", options->force,
        "Let --output and --report replace any files but those that are read; without this "
        "option they replace only pictures and reports of this program");
    command.flag("--from-devices", options->from_devices,
                 "Compute the commands again from the recorded devices, and fail if a command "
                 "differs from the recorded one");
    command.flag(
        "--test-pattern", options->test_pattern,
        "Show a test pattern that tells eyes, walls and trackers apart; this needs no index");
    command.flag("--live", options->live,
                 "Play in a window at the recorded speed; no frame waits for its cells");
    add_control_option(command, options->control);
    command.footer(
        "In a cluster, `mpirun -n N isochron replay ...`, each process writes the pictures "
        "of its own windows.");
    command.exit_status(1, "bad input, or a difference that --from-devices found");
    command.on_run([options] { run_in_cluster([&](ClusterJob& job) { replay(*options, job); }); });
}

} // namespace isochron::app
