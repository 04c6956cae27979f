// How a session of `explore` begins.
#include "app/explore/explore_start.h"

#include "app/config/check_config.h"
#include "app/config/config_words.h"
#include "app/config/tracker_setup.h"
#include "app/explore/drawing_options.h"
#include "app/frame/empty_picture.h"
#include "app/indexing/file_patterns.h"
#include "app/indexing/open_index.h"
#include "app/kept/recording_file.h"
#include "app/output/guarded_outputs.h"
#include "app/output/room_view.h"
#include "app/session/shown_arrays.h"
#include "app/session/start_state.h"
#include "app/telling.h"
#include "index/error.h"
#include "index/file/blend_advice.h"
#include "index/file/color_source.h"
#include "index/readers/formats/model_file.h"
#include "index/system/new_file.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <filesystem>
#include <vector>

namespace isochron::app {
namespace {

bool names_array(const ExploreOptions& options) {
    return options.array || !options.sources.arrays.empty();
}

/// The step that the options ask for.
std::uint32_t first_step(const ExploreOptions& options, std::size_t steps) {
    return options.step.value_or(options.follow ? static_cast<std::uint32_t>(steps) - 1 : 0);
}

/// A recording that was cut short is replaced only with --force, too.
void refuse_to_replace_part_of(const std::filesystem::path& recording) {
    const std::string part = recording.string() + ".part";
    if (std::filesystem::exists(part))
        throw index::Error("{}: exists already, a recording that was cut short and can be "
                           "replayed; --force replaces it",
                           part);
}

} // namespace

std::size_t first_array(const index::IndexFile& file) {
    return has_surfaces(file.array(0).stats()) ? 0 : next_with_surfaces(file, 0).value_or(0);
}

std::size_t first_array(const ExploreOptions& options, const index::IndexFile& file) {
    if (!names_array(options))
        return first_array(file);
    // An index has the array that it was made for as its first.
    const auto& arrays = options.sources.arrays;
    const bool made_before = options.data_name == *options.data;
    return made_before && !arrays.empty() ? array_number(file, arrays.front()) : 0;
}

std::string passed_over(const ExploreOptions& options, const index::IndexFile& file) {
    const std::size_t number = first_array(options, file);
    if (names_array(options) || number == 0)
        return {};
    const index::IndexFile& first = file.array(0);
    return fmt::format("{}: {} is shown instead",
                       nothing_to_show(first.info().array, has_values(first.stats()),
                                       first.stats().low, first.info().value_unit),
                       file.array(number).info().array);
}

Config configure(const ExploreOptions& options) {
    Config config = read_config(options.config);
    if (options.context)
        config.rendering.context = *stereo::context_kind_from_name(*options.context);
    if (options.quality)
        config.start.quality = value_of<interaction::QualityMode>(*options.quality, "quality mode");
    if (options.footprint)
        config.quality.settled = value_of<SettledFootprint>(*options.footprint);
    set_shape(config, options.shape);
    if (!options.size.empty() && !options.emulate)
        for (stereo::Window& window : config.installation.windows) {
            window.size = {options.size[0], options.size[1]};
            window.fullscreen = false;
        }
    config.openxr.enabled = config.openxr.enabled && !options.emulate;
    config.openxr.verbose = tells(Telling::verbose);
    const bool in_headset =
        config.openxr.enabled &&
        config.rendering.context == stereo::ContextKind::egl; // shows without window
    if (config.rendering.context != stereo::ContextKind::glfw && !in_headset)
        throw UsageError("explore needs a window: --context glfw, not {} (egl only with a headset, "
                         "[openxr] enabled = true); `isochron replay` draws pictures without one",
                         stereo::name_of(config.rendering.context));
    stereo::OpenXrOptions& openxr = config.openxr.options;
    openxr.windowless = in_headset;
    openxr.near_plane = config.installation.near_plane;
    openxr.far_plane = config.installation.far_plane;
    openxr.local_in_room.position = config.installation.viewers.front().position;
    return config;
}

void check_start(const ExploreOptions& options, const index::IndexFile& file, std::size_t steps) {
    if (options.step && *options.step >= steps)
        throw UsageError("--step: expected 0 to {}, got {}", steps - 1, *options.step);
    for (const std::string& model : options.models) {
        std::error_code error;
        if (!index::is_model_name(model))
            throw UsageError("--model: expected a file of {}, got {}", index::model_extensions(),
                             model);
        if (!index::is_model_series(model) && !std::filesystem::is_regular_file(model, error))
            throw UsageError("--model: {}: there is no such file", model);
    }
    if (options.models.size() > interaction::kMostModels)
        throw UsageError("--model: {} models, expected at most {}", options.models.size(),
                         interaction::kMostModels);
    if (options.isovalue)
        warn_beyond(*options.isovalue, file.array(first_array(options, file)));
}

ExplorerState filling_window(Session& session, const Config& config,
                             const index::SeriesInfo& info) {
    ExplorerState home = session.home();
    const stereo::Windows& windows = session.outputs().windows();
    const stereo::Screen& screen = config.installation.windows.front().viewports.front().screen;
    if (config.placement.fill <= 0 || !config.devices.empty() || config.openxr.enabled ||
        !screen.carried_by_head || !screen.fit_aspect || windows.room() ||
        !windows.first().has_window())
        return home;
    const glm::ivec2 size = windows.first().framebuffer_size();
    const stereo::Margins panel = session.panel().covered(size, rows_of(session.state()));
    home.room_from_physical =
        filling(info, config.placement, screen,
                {config.installation.viewers.front().position, {1, 0, 0, 0}},
                glm::max(size - glm::ivec2(panel.left, panel.top + panel.bottom), 1));
    return home;
}

ExplorerState first_look(const Session& session, const ExploreOptions& options,
                         const Config& config,
                         const std::shared_ptr<const index::IndexFile>& file) {
    ExplorerState state = session.state();
    state.pictures.scale_bar = true; // what is seen is what is written
    const std::size_t steps = file->info().steps(), number = first_array(options, *file);
    if (number > 0)
        state.apply(session.way_to_array(number), steps);
    if (const std::uint32_t step = first_step(options, steps); step > state.instant.step)
        state.isosurfaces = first_surfaces(config, array_of(file, number), step);
    if (!options.between && !config.between)
        state.between = advised_between(*array_of(file, number));
    return state;
}

interaction::BetweenSteps advised_between(const index::IndexFile& file) {
    try {
        const auto quality = index::blend_quality(file);
        return quality && !quality->holds() ? interaction::BetweenSteps::blend
                                            : interaction::BetweenSteps::hold;
    } catch (const index::Error&) {
        return interaction::BetweenSteps::hold;
    }
}

ExplorerState start_from(ExplorerState state, const ExploreOptions& options, std::size_t steps) {
    state.set_isovalue(options.isovalue.value_or(state.isovalue()));
    state.steps = static_cast<std::uint32_t>(steps);
    state.follow = state.follow || options.follow;
    if (options.step || options.follow)
        state.instant = index::Instant(first_step(options, steps));
    if (options.between)
        state.between = *interaction::value_named<interaction::BetweenSteps>(*options.between);
    state.panel = state.panel && !options.no_panel;
    if (options.stereo)
        state.set_stereo(*stereo::stereo_mode_from_name(*options.stereo));
    return state;
}

void check_outputs(const ExploreOptions& options, const ClusterJob& job,
                   const index::IndexFile& file) {
    namespace fs = std::filesystem;
    std::error_code ignored;
    Reads reads{{*options.data, options.config}, &file};
    if (options.story)
        reads.files.emplace_back(*options.story);
    if (*options.data != options.data_name) // it is the index of these
        for (const fs::path& source : expand_patterns(options.sources.files))
            reads.files.push_back(source);
    std::vector<Output> outputs;
    if (options.report)
        outputs.push_back({job.own_file(*options.report), OutputKind::report});
    if (job.leads() && options.record)
        outputs.push_back({*options.record, OutputKind::recording});
    if (job.leads() && options.session)
        outputs.push_back({*options.session, OutputKind::session});
    guard_outputs(outputs, reads, options.force);
    index::make_folder(options.screenshots);
    if (!job.leads())
        return;
    if (options.record && !options.force)
        refuse_to_replace_part_of(index::end_of_links(*options.record));
    if (options.record && fs::exists(*options.record, ignored))
        read_recording(*options.record); // only a recording may be overwritten
    if (options.session && fs::path(*options.session).has_parent_path())
        index::make_folder(fs::path(*options.session).parent_path());
    for (const auto& out : {options.record, options.report, options.session})
        if (out)
            index::NewFile{*out};
}

stereo::Windows open_windows(const ExploreOptions& options, const Config& config,
                             const ClusterJob& job, const stereo::Headset* headset) {
    const std::string title =
        fmt::format("Isochron: {}", options.test_pattern        ? "test pattern"
                                    : options.data_name.empty() ? "open data"
                                                                : options.data_name);
    const stereo::Installation& installation = config.installation;
    if (options.emulate) {
        stereo::ContextOptions room{.title = title, .vsync = config.rendering.vsync};
        room.fits = room.scales = options.size.empty();
        if (!options.size.empty())
            room.size = {options.size[0], options.size[1]};
        return stereo::open_room(config.rendering.context, installation, room);
    }
    const stereo::StereoMode start = options.stereo
                                         ? *stereo::stereo_mode_from_name(*options.stereo)
                                         : installation.windows.front().stereo;
    // A headset paces the frames, so the window that mirrors it must not wait for its own display.
    return stereo::open_windows(
        config.rendering.context, installation,
        {.title = title,
         .vsync = config.rendering.vsync && !headset,
         .stereo = headset ? stereo::StereoMode::mono : start,
         .api = headset ? headset->context_api() : stereo::ContextApi::native,
         .console = job.leads() && config.panel.console
                        ? std::optional(config.panel.console->window())
                        : std::nullopt,
         .rank = job.rank(),
         .ranks = job.size()});
}

void warn_of_colors(const Config& config, const index::IndexFile& file) {
    const std::string& wanted = config.start.coloring.array;
    if (wanted.empty())
        return;
    const std::vector<std::string> there = index::color_source_names(file);
    if (std::ranges::find(there, wanted) == there.end())
        print_note("warning: {}: no array {} to color by, there {}", file.name(), wanted,
                   there.empty() ? "is none" : fmt::format("are {}", fmt::join(there, ", ")));
}

void warn(const Config& config) {
    for (const ConfigProblem& problem : problems_of(config))
        print_note("{}", line_of(problem, config));
}

} // namespace isochron::app
