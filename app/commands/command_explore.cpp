// `isochron explore`: the live program, in a window.
#include "app/command_line/cancel.h"
#include "app/command_line/subcommands.h"
#include "app/config/check_config.h"
#include "app/config/tracker_setup.h"
#include "app/config/user_folders.h"
#include "app/explore/cluster_job.h"
#include "app/explore/explore_options.h"
#include "app/explore/explore_start.h"
#include "app/explore/explored_data.h"
#include "app/explore/kept_session.h"
#include "app/explore/live_setup.h"
#include "app/indexing/open_index.h"
#include "app/session/data_choice.h"
#include "app/session/live_loop.h"
#include "app/session/user_memory.h"
#include "app/text.h"
#include "index/error.h"
#include "index/system/new_file.h"
#include "interaction/recording/recording.h"
#include "stereo/context/display_loss.h"
#include "stereo/loading_picture.h"

#include <fmt/format.h>

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <utility>

namespace isochron::app {
namespace {

std::optional<std::filesystem::path> kept_in(const ExploreOptions& options,
                                             const index::IndexFile& file) {
    if (options.session)
        return index::end_of_links(*options.session);
    return session_path(*options.data, data_hash_of(file));
}

/// Where the earlier session lies. If the data have grown since, its name has their earlier hash.
std::optional<std::filesystem::path> earlier_kept_in(const ExploreOptions& options,
                                                     const index::IndexFile& file) {
    const auto path = kept_in(options, file);
    return options.session || !path ? path : kept_on_fewer_steps(*path, file);
}

void print_status(const LiveLoop& live) {
    for (const std::string& line : live.status())
        fmt::print(stderr, "{}\n", line);
}

/// Shows the test pattern instead of data, with the devices and windows of a session.
void show_test_pattern(const ExploreOptions& options, ClusterJob& job) {
    Config config;
    interaction::CompositeInput trackers;
    std::optional<PatternShow> opened;
    job.together([&] {
        if (options.record || options.report)
            throw UsageError("--test-pattern does not go with --record or --report");
        config = configure(options);
        prepare_walls(config, job, options.emulate);
        if (!job.leads())
            return;
        warn(config);
        open_trackers(config, trackers);
    });
    job.require_same(facts_of(config));
    job.set_limits(config.cluster.limits);
    job.together([&] { opened.emplace(config, open_windows(options, config, job, nullptr)); });
    PatternShow& show = *opened;
    if (options.stereo)
        show.set_stereo(*stereo::stereo_mode_from_name(*options.stereo));
    job.require_same({{"stereo mode", std::string(stereo::name_of(show.stereo()))}});
    job.tell_shared_processors(show.outputs().gl());
    job.share_frames(show);
    LiveLoop live(config, std::move(trackers), live_options(options));
    if (job.leads())
        live.run(show);
    else
        job.follow(show);
    show.frames().end();
    print_status(live);
    job.finish();
}

/// Describes the configuration or its devices if the options ask for that.
/// @return true: the options ask for nothing else
bool only_describes(const ExploreOptions& options) {
    if (options.check_config) {
        check_config(*options.check_config);
        return true;
    }
    if (!options.list_devices)
        return false;
    const Config config = configure(options);
    for (const std::string& line : describe_devices(config))
        fmt::print("{}\n", line);
    for (const std::string& warning : device_warnings(config))
        fmt::print("warning: {}\n", warning);
    return true;
}

/// What there is of a session whose display is gone.
void save(const ExploreOptions& options, LiveLoop& live, Session& session) {
    try {
        live.finish(session);
        session.outputs().pictures().finish();
        if (options.record)
            fmt::print(stderr, "recording: {}\n", *options.record);
    } catch (const std::exception& error) {
        fmt::print(stderr, "isochron: {}\n", one_line(error.what()));
    }
}

/// What the user chooses in a window of its own, where the command line names no data.
/// @return nothing: they leave
std::optional<std::string> chosen_data(const ExploreOptions& options, ClusterJob& job) {
    const CancelOnSignal signals;
    Config config = configure(options);
    if (config.rendering.context != stereo::ContextKind::glfw)
        throw UsageError("file is required: an index made by `isochron build`");
    config.openxr.enabled = false; // nobody chooses a file in a headset
    const stereo::Windows windows = open_windows(options, config, job, nullptr);
    const auto chosen =
        choose_data(windows, {.recent = UserMemory(user_state_folder()).recent(),
                              .why_not_open = [&](const auto& data) { return why_not_open(data); },
                              .window = {.ended = [] { return CancelOnSignal::received() != 0; },
                                         .background = config.rendering.background,
                                         .frame_rate_limit = config.rendering.frame_rate_limit,
                                         .font_scale = config.panel.font_scale}});
    signals.check();
    return chosen ? std::optional(chosen->string()) : std::nullopt;
}

/// @return other data that the user wants to see; empty: the user leaves
std::optional<std::string> explore(const ExploreOptions& asked, ClusterJob& job) {
    ExploreOptions options = asked;
    // A signal ends the session as its user would: the recording gets its final name.
    const CancelOnSignal signals;
    if (options.test_pattern) {
        show_test_pattern(options, job);
        return std::nullopt;
    }
    Config config;
    std::shared_ptr<const index::IndexFile> file;
    interaction::CompositeInput trackers;
    std::unique_ptr<Indexing> indexing; ///< of these data, while they are shown
    std::unique_ptr<stereo::Headset> headset;
    std::optional<stereo::Windows> windows;
    const auto open_outputs = [&] {
        headset = open_headset(config.openxr);
        windows.emplace(open_windows(options, config, job, headset.get()));
        show_loading(*windows, config.rendering.background);
    };
    job.together([&] {
        if (!options.data && options.sources.files.empty())
            throw UsageError("file is required in a job: an index made by `isochron build`");
        config = configure(options);
        if (job.leads())
            warn(config);
        if (config.openxr.enabled && job.size() > 1)
            throw UsageError("a headset belongs to one process: start it without mpirun");
        prepare_walls(config, job, options.emulate);
        if (job.leads())
            open_trackers(config, trackers);
        indexing = begin_indexing(options, job);
        if (indexing) {
            open_outputs();
            options.data = wait_for_index(*indexing, *windows, options, config);
            if (!options.data)
                return;
        }
        file = open_index_to_show(*options.data, config.memory.cache_bytes());
        if (job.leads()) {
            warn_of_colors(config, *file);
            check_start(options, *file, indexing ? indexing->state().of : file->info().steps());
        }
        check_outputs(options, job, *file);
    });
    signals.check();
    if (!file) // the user left before there was anything to see
        return std::nullopt;
    job.require_same(facts_of(config, *file));
    job.set_limits(config.cluster.limits);
    std::optional<Session> opened;
    std::optional<SavedSession> earlier;
    job.together([&] {
        if (job.size() == 1)
            earlier = earlier_session(earlier_kept_in(options, *file), options.resume);
        else if (options.resume)
            throw UsageError("--resume is for one process, without mpirun");
        if (!windows)
            open_outputs();
        opened.emplace(config, file, std::move(*windows), index::Extract(), std::move(headset));
        const std::size_t steps = file->info().steps();
        const ExplorerState start =
            earlier ? state_of(*earlier, opened->state(), held_hash(*file, earlier->data_hash),
                               steps, "--resume")
                    : opened->state();
        opened->set_state(start);
        if (earlier)
            opened->recall_arrays(earlier->arrays);
        else
            opened->set_state(first_look(*opened, options, config, file));
        opened->set_state(start_from(opened->state(), options, steps));
        opened->outputs().set_screenshots(options.screenshots);
        opened->set_data_name(std::filesystem::path(options.data_name).filename().string());
        if (config.cluster.swap_group && job.size() > 1)
            stereo::join_swap_group(opened->outputs().windows());
    });
    Session& session = *opened;
    job.require_same(start_fact(session));
    job.tell_shared_processors(session.outputs().gl());
    job.share_frames(session);
    LiveOptions how = live_options(options);
    UserMemory memory(job.size() == 1 ? user_state_folder() : std::nullopt);
    BackgroundWork remembering; // no frame waits for that disk
    if (job.size() == 1) {
        how.why_not_open = [&](const std::filesystem::path& data) {
            return why_not_open(options, data);
        };
        if (indexing)
            how.standing = [&indexing] {
                const Indexing::State now = indexing->state();
                return now.failure.empty() ? now.line() : "indexing has ended: " + now.failure;
            };
        greet(session, memory, remembering, name_to_remember(options));
    }
    LiveLoop live(config, std::move(trackers), how, session.outputs().headset());
    session.set_clock(live.clock());
    if (job.leads()) {
        if (job.size() == 1)
            keep_session(live, kept_in(options, *file), *options.data, *file, session, earlier);
        const auto header = header_of(session, config, *file, *options.data);
        if (options.record) {
            live.record(index::end_of_links(*options.record), header);
            session.set_recording(true);
        }
        if (job.size() == 1)
            live.offer_movies(movie_orders(options, header));
        live.watch(*options.data, file);
        const stereo::DisplayLoss loss([&] { save(options, live, session); });
        live.run(session);
    } else {
        job.follow(session);
    }
    session.frames().end();
    live.finish(session);
    session.outputs().pictures().finish();
    if (session.panel().introduced())
        memory.set_introduced();
    print_status(live);
    if (options.report)
        session.log().write(job.own_file(*options.report), session.drawing(), session.reading());
    job.finish();
    if (options.record && job.leads())
        fmt::print(stderr, "recording: {}\n", *options.record);
    signals.check();
    if (live.next_data())
        return live.next_data()->string();
    if (indexing)
        indexing->check();
    return std::nullopt;
}

} // namespace

void add_explore(Command& program) {
    auto options = std::make_shared<ExploreOptions>();
    Command command =
        program.subcommand("explore", "Explore an index, or files of values, in a window, live.");
    add_explore_options(command, *options);
    command.on_run([options] {
        if (!only_describes(*options))
            run_in_cluster([&](ClusterJob& job) {
                ExploreOptions now = with_index(*options);
                if (now.sources.files.empty() && !now.test_pattern && job.size() == 1) {
                    const auto chosen = chosen_data(now, job);
                    if (!chosen)
                        return;
                    now = with_data(std::move(now), *chosen);
                }
                while (const auto next = explore(now, job))
                    now = with_data(std::move(now), *next);
            });
    });
}

} // namespace isochron::app
