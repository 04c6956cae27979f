// `isochron explore`: the live program, in a window.
#include "app/commands/cancel.h"
#include "app/commands/cluster_job.h"
#include "app/commands/drawing_options.h"
#include "app/commands/explore_options.h"
#include "app/commands/explored_data.h"
#include "app/commands/file_patterns.h"
#include "app/commands/kept_session.h"
#include "app/commands/live_setup.h"
#include "app/commands/open_index.h"
#include "app/commands/subcommands.h"
#include "app/config/check_config.h"
#include "app/config/shipped_configs.h"
#include "app/config/tracker_setup.h"
#include "app/config/user_folders.h"
#include "app/session/data_choice.h"
#include "app/session/live_loop.h"
#include "app/session/recording_file.h"
#include "app/session/user_memory.h"
#include "app/text.h"
#include "app/version.h"
#include "index/error.h"
#include "index/system/new_file.h"
#include "interaction/recording/recording.h"
#include "stereo/context/display_loss.h"
#include "stereo/loading_picture.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>
#include <filesystem>

namespace isochron::app {
namespace {

Config configure(const ExploreOptions& options) {
    Config config = read_config(options.config);
    if (options.context)
        config.context = *stereo::context_kind_from_name(*options.context);
    if (options.quality)
        config.quality = quality_mode_from_name(*options.quality);
    if (options.footprint)
        config.settled_footprint = settled_footprint_from_name(*options.footprint);
    set_shape(config, options.shape);
    if (!options.size.empty() && !options.emulate)
        for (stereo::Window& window : config.installation.windows) {
            window.size = {options.size[0], options.size[1]};
            window.fullscreen = false;
        }
    config.openxr.enabled = config.openxr.enabled && !options.emulate;
    config.openxr.verbose = options.verbose;
    const bool in_headset =
        config.openxr.enabled && config.context == stereo::ContextKind::egl; // shows without window
    if (config.context != stereo::ContextKind::glfw && !in_headset)
        throw UsageError(
            fmt::format("explore needs a window: --context glfw, not {} (egl only with a headset, "
                        "[openxr] enabled = true); `isochron replay` draws pictures without one",
                        stereo::name_of(config.context)));
    stereo::OpenXrOptions& openxr = config.openxr.options;
    openxr.windowless = in_headset;
    openxr.near_plane = config.installation.near_plane;
    openxr.far_plane = config.installation.far_plane;
    openxr.local_in_room.position = config.installation.viewers.front().position;
    return config;
}

void check_start(const ExploreOptions& options, const index::IndexFile& file) {
    const std::size_t steps = file.info().steps();
    if (options.step && *options.step >= steps)
        throw UsageError(fmt::format("--step: expected 0 to {}, got {}", steps - 1, *options.step));
    if (options.isovalue && !std::isfinite(*options.isovalue))
        throw UsageError(
            fmt::format("--isovalue: expected a finite number, got {}", *options.isovalue));
    if (options.isovalue)
        warn_beyond(*options.isovalue, file);
}

ExplorerState start_from(ExplorerState state, const ExploreOptions& options, std::size_t steps) {
    state.set_isovalue(options.isovalue.value_or(state.isovalue()));
    state.steps = static_cast<std::uint32_t>(steps);
    state.follow = state.follow || options.follow;
    state.step = options.step.value_or(options.follow ? state.steps - 1 : state.step);
    state.panel = state.panel && !options.no_panel;
    if (options.stereo)
        state.stereo = *stereo::stereo_mode_from_name(*options.stereo);
    return state;
}

/// Refuses to overwrite an existing recording, which only --force allows.
void refuse_to_replace(const std::string& recording) {
    for (const std::string& name : {recording, recording + ".part"})
        if (std::filesystem::exists(name))
            throw index::Error(fmt::format("{}: exists already{}; --force replaces it", name,
                                           name == recording
                                               ? ""
                                               : ", a recording that was cut short and can be "
                                                 "replayed"));
}

/// Reports now the errors in output paths that would otherwise show, or destroy a file, only when
/// the session ends.
void check_outputs(const ExploreOptions& options, const ClusterJob& job) {
    namespace fs = std::filesystem;
    std::error_code ignored;
    index::make_folder(options.screenshots);
    if (!job.leads())
        return;
    for (const auto& out : {options.record, options.report, options.session})
        if (out)
            refuse_input_as_output({*options.data}, *out);
    if (options.record && !options.force)
        refuse_to_replace(*options.record);
    if (options.record && fs::exists(*options.record, ignored))
        read_recording(*options.record); // only a recording may be overwritten
    if (options.session && fs::path(*options.session).has_parent_path())
        index::make_folder(fs::path(*options.session).parent_path());
    for (const auto& out : {options.record, options.report, options.session})
        if (out)
            index::NewFile{*out};
}

/// @param headset mirrored by the first window; it paces the frames, not that window's display
stereo::Windows open(const ExploreOptions& options, const Config& config, const ClusterJob& job,
                     const stereo::Headset* headset) {
    const std::string title =
        fmt::format("Isochron: {}", options.test_pattern        ? "test pattern"
                                    : options.data_name.empty() ? "open data"
                                                                : options.data_name);
    const stereo::Installation& installation = config.installation;
    if (options.emulate) {
        stereo::ContextOptions room{.title = title, .vsync = config.vsync};
        if (!options.size.empty())
            room.size = {options.size[0], options.size[1]};
        return open_room(config.context, installation, room);
    }
    const stereo::StereoMode start = options.stereo
                                         ? *stereo::stereo_mode_from_name(*options.stereo)
                                         : installation.windows.front().stereo;
    // A headset paces the frames, so the window that mirrors it must not wait for its own display.
    return open_windows(config.context, installation,
                        {.title = title,
                         .vsync = config.vsync && !headset,
                         .stereo = headset ? stereo::StereoMode::mono : start,
                         .api = headset ? headset->context_api() : stereo::ContextApi::native,
                         .console = job.leads() ? config.panel.console : std::nullopt,
                         .rank = job.rank(),
                         .ranks = job.size()});
}

void warn(const Config& config) {
    for (const ConfigProblem& problem : problems_of(config))
        fmt::print(stderr, "isochron: {}\n", line_of(problem, config));
    for (const std::string& warning : device_warnings(config))
        fmt::print(stderr, "isochron: warning: {}\n", one_line(warning));
}

std::optional<std::filesystem::path> kept_in(const ExploreOptions& options,
                                             const index::IndexFile& file) {
    if (options.session)
        return *options.session;
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
    job.together([&] { opened.emplace(config, open(options, config, job, nullptr)); });
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
        live.finish(session.state());
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
    if (config.context != stereo::ContextKind::glfw)
        throw UsageError("file is required: an index made by `isochron build`");
    config.openxr.enabled = false; // nobody chooses a file in a headset
    const stereo::Windows windows = open(options, config, job, nullptr);
    const auto chosen =
        choose_data(windows, {.recent = UserMemory(user_state_folder()).recent(),
                              .why_not_open = [&](const auto& data) { return why_not_open(data); },
                              .ended = [] { return CancelOnSignal::received() != 0; },
                              .background = config.background,
                              .frame_rate_limit = config.frame_rate_limit,
                              .font_scale = config.panel.font_scale});
    signals.check();
    return chosen ? std::optional(chosen->string()) : std::nullopt;
}

/// @return other data that the user wants to see; empty: the user leaves
std::optional<std::string> explore(const ExploreOptions& options, ClusterJob& job) {
    // A signal ends the session as its user would: the recording gets its final name.
    const CancelOnSignal signals;
    if (options.test_pattern) {
        show_test_pattern(options, job);
        return std::nullopt;
    }
    Config config;
    std::shared_ptr<const index::IndexFile> file;
    interaction::CompositeInput trackers;
    job.together([&] {
        if (!options.data)
            throw UsageError("file is required in a job: an index made by `isochron build`");
        config = configure(options);
        if (job.leads())
            warn(config);
        if (config.openxr.enabled && job.size() > 1)
            throw UsageError("a headset belongs to one process: start it without mpirun");
        prepare_walls(config, job, options.emulate);
        if (job.leads())
            open_trackers(config, trackers);
        file = open_index_to_show(*options.data, config.cache_bytes());
        if (job.leads())
            check_start(options, *file);
        check_outputs(options, job);
    });
    job.require_same(facts_of(config, *file));
    job.set_limits(config.cluster.limits);
    std::optional<Session> opened;
    std::optional<SavedSession> earlier;
    job.together([&] {
        if (job.size() == 1)
            earlier = earlier_session(earlier_kept_in(options, *file), options.resume);
        else if (options.resume)
            throw UsageError("--resume is for one process, without mpirun");
        auto headset = open_headset(config.openxr);
        stereo::Windows windows = open(options, config, job, headset.get());
        show_loading(windows, config.background);
        opened.emplace(config, file, std::move(windows), index::Extract(), std::move(headset));
        const std::size_t steps = file->info().steps();
        const ExplorerState start =
            earlier ? state_of(*earlier, opened->state(), held_hash(*file, earlier->data_hash),
                               steps, "--resume")
                    : opened->state();
        opened->set_state(start_from(start, options, steps));
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
        greet(session, memory, remembering,
              options.data_name == *options.data ? options.data : std::nullopt);
    }
    LiveLoop live(config, std::move(trackers), how, session.outputs().headset());
    session.set_clock(live.clock());
    if (job.leads()) {
        if (job.size() == 1)
            keep_session(live, kept_in(options, *file), *options.data, *file, session, earlier);
        const auto header = header_of(session, config, *file, *options.data);
        if (options.record) {
            live.record(*options.record, header);
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
    live.finish(session.state());
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
    if (!live.next_data())
        return std::nullopt;
    return live.next_data()->string();
}

/// The options for other data, without those that were meant for the first data only.
ExploreOptions with_data(ExploreOptions options, const std::string& data) {
    options.data = options.data_name = data;
    options.isovalue.reset();
    options.step.reset();
    options.session.reset();
    options.report.reset();
    options.resume = false;
    return options;
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
                ExploreOptions now = with_index(*options, job);
                if (!now.data && !now.test_pattern && job.size() == 1) {
                    const auto chosen = chosen_data(now, job);
                    if (!chosen)
                        return;
                    now.data = now.data_name = *chosen;
                }
                while (const auto next = explore(now, job))
                    now = with_data(std::move(now), *next);
            });
    });
}

} // namespace isochron::app
