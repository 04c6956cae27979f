// One session: brings data, search, devices and displays together, frame by frame.
#include "app/session/session.h"

#include "app/session/start_state.h"
#include "interaction/input/device_reading.h"
#include "interaction/navigation/navigator.h"
#include "interaction/tools/tool_table.h"

#include <utility>

namespace isochron::app {
namespace {

using interaction::Commands;

} // namespace

Session::Session(Config config, std::shared_ptr<const index::IndexFile> file,
                 stereo::Windows windows, index::Extract extract,
                 std::unique_ptr<stereo::Headset> headset)
    : config_(std::move(config)), file_(std::move(file)),
      newest_(std::make_shared<index::NewestIndex>(file_)), times_(file_->info().times),
      outputs_(config_, std::move(windows), std::move(headset)),
      state_(start_state(config_, file_)), home_(state_), gate_(config_.stillness),
      comfort_(config_.comfort),
      extractor_(extract ? std::move(extract)
                         : index::extract_from_newest(
                               newest_, render::CellBuffers::wanted_shading(outputs_.gl())),
                 file_->cache_bytes() / 2),
      scene_(outputs_.gl(), file_->info(), config_),
      details_(file_->info().grid, static_cast<std::uint64_t>(config_.most_cells)),
      panel_(outputs_.gl(), outputs_.windows(), config_.panel.font_scale),
      room_panel_(outputs_.gl(), config_.panel), picker_(file_),
      // Beside a headset the window's refresh rate does not count.
      quality_(outputs_.gl(), config_,
               outputs_.headset() ? std::nullopt : outputs_.windows().first().refresh_rate()) {
    take_arrays();
}

bool Session::should_close() const {
    return outputs_.windows().should_close() || frames_->close_wanted();
}

std::string Session::failure() const {
    return frames_->failure(extractor_);
}

interaction::ControlContext Session::control_context() const {
    interaction::ControlContext context;
    context.isovalue = state_.isovalue();
    context.isosurfaces = static_cast<std::uint32_t>(state_.isosurfaces.size());
    context.picked = state_.picked;
    context.coloring = state_.coloring;
    context.bounding_box = state_.bounding_box;
    context.color_arrays = &color_names_;
    context.color_array = color_array(state_, *file_);
    context.next_array = next_array_ ? &*next_array_ : nullptr;
    context.low = array().stats().low;
    context.high = array().stats().high;
    context.step = state_.step;
    context.times = &times_;
    context.follow = state_.follow;
    context.playback = state_.playback;
    context.room_from_physical = state_.room_from_physical;
    context.home = home_.room_from_physical;
    context.pivot = physical_center(file_->info().grid);
    context.quality = state_.quality;
    context.eye_separation = state_.eye_separation;
    context.stereo = stereo::name_of(state_.stereo);
    context.panel = state_.panel;
    context.room_panel = state_.room_panel;
    context.panel_distance = room_panel_.distance();
    context.panel_place = panel_place();
    context.grid = state_.grid;
    context.views = &state_.views;
    context.stereo_modes = &outputs_.stereo_modes();
    context.tools = state_.tools;
    context.state = {state_.mark, state_.clip, state_.ruler};
    context.data = data_frame(file_->info());
    context.find_surface = [this](const interaction::Pose& ray) {
        return picker_.hit_by(ray, state_, scene_.cells().shown());
    };
    context.orthographic = state_.orthographic;
    context.start = &start_;
    context.leaving = state_.leaving;
    context.undo = history_.undo();
    context.redo = history_.redo();
    return context;
}

/// Commands that lead back to the start state, except for displays, viewpoints and tools.
Commands Session::way_to_start() const {
    Commands way = state_.commands_to(home_);
    way.quality.reset();
    way.stereo.reset();
    way.views.reset();
    way.tools.reset();
    way.steps.reset();
    way.follow.reset();
    return way;
}

Commands Session::commands_from(const interaction::InputState& input) {
    start_ = way_to_start();
    next_array_.reset();
    if (file_->arrays() > 1)
        next_array_ = way_to_array((array_number() + 1) % file_->arrays());
    PanelInRoom::Outcome panel = room_panel_.outcome(input, state_.room_panel);
    interaction::ControlContext context = control_context();
    if (panel.touched) // the wand points at the panel, which is in front of the data
        context.find_surface = {};
    Commands commands = controls_.update(panel.rest, context);
    interaction::merge(commands, panel.commands);
    // What is found depends on what is shown, so it is recorded like the operator's panel's
    // commands.
    interaction::merge(panel_commands_, controls_.found());
    interaction::merge(panel_commands_, picker_.update(panel.rest, state_, scene_.cells().shown()));
    show_messages(controls_.notes());
    return commands;
}

/// Whether the drawn cells have the current coloring. Before that, their color coordinates have
/// another meaning.
bool Session::colored_as_asked() const {
    const index::ExtractionPtr& shown = scene_.cells().shown();
    const index::SurfacesQuery wanted = surfaces();
    return shown && shown->query.coloring == wanted.coloring &&
           shown->query.colors == wanted.colors && shown->query.array == wanted.array;
}

std::optional<ColorScale> Session::scale() const {
    return color_scale(state_, *file_,
                       colored_as_asked() ? scene_.cells().shown() : index::ExtractionPtr(),
                       percentiles_);
}

/// The color scale of the drawn cells. Empty until these have the current coloring.
std::optional<ColorScale> Session::shown_scale() const {
    return colored_as_asked() ? scale() : std::nullopt;
}

void Session::set_headset_period(std::optional<interaction::Seconds> period) {
    quality_.set_headset_period(period ? std::optional(Milliseconds(*period)) : std::nullopt);
}

/// The picture of this frame, with the footprint of the last one.
Picture Session::picture(const interaction::InputState& input, const FrameReport& report) {
    const bool in_windows = this->in_windows(report);
    const Aids all = aids(input), none;
    const bool over = aids_lie_over();
    const Aids& seen = over ? none : all;
    over_ = over ? all : none;
    Picture picture{
        .audience = {.viewers = viewer_poses(config_.installation, input, state_.eye_separation,
                                             parallel_center()),
                     .eyes = outputs_.headset_eyes(),
                     .wand = seen.wand,
                     .panel = room_panel_.shown(state_.room_panel),
                     .stereo = state_.stereo,
                     .aids = seen.wand || seen.pointed,
                     .in_windows = in_windows},
        .mark = state_.mark,
        .pointed = seen.pointed,
        .tools = drawing_of({state_.mark, state_.clip, state_.ruler}, data_frame(file_->info())),
        .clip = state_.clip,
        .guides = {state_.grid, interaction::teleport_target(input)},
        .veil = {static_cast<float>(report.comfort.fade),
                 static_cast<float>(report.comfort.vignette)},
        .room_from_physical = state_.room_from_physical,
        .footprint = drawn_ ? drawn_->footprint : render::Footprint{},
        .cells = scene_.cells().shown(),
        .isosurfaces = state_.isosurfaces,
        .value_unit = array().info().value_unit,
        .look = state_.look,
        .scale = shown_scale(),
        .bounding_box = state_.bounding_box,
        .orientation = false,
        .caption = {},
        .layout = {
            .windows = outputs_.window_sizes(),
            .free = flat_panel() ? panel_.covered(outputs_.windows()[0].framebuffer_size().x /
                                                  panel_places().x)
                                 : 0,
            .aside = stands_beside(interaction::Reading(input).viewer()) ? kPanelShare : 0.0f}};
    picture.orientation = on_desktop(picture.audience) && !state_.room_panel.shown;
    return picture;
}

/// The devices that the views are made from, polled as late as possible.
interaction::InputState Session::seen(const interaction::InputState& input, const Latch& latch,
                                      FrameReport& report) {
    const interaction::InputState newest =
        latch ? latch() : interaction::InputState{input.time, {}};
    latched_ = viewers_heads(newest, config_.installation);
    interaction::InputState seen = with_heads(input, latched_);
    report.pose_age = pose_age(seen, newest.time, config_.installation);
    return seen;
}

/// Learns the draw costs of the slowest process, as all draw with the same footprint.
void Session::learn_costs() {
    quality_.learn(frames_->samples(quality_.collect(log_)));
    quality_.charge(frames_->largest(quality_.view()));
}

/// Takes over rank 0's choice. @return whether rank 0 wants this frame measured
bool Session::agree(bool measure, const index::DetailQuery& detail, FrameReport& report) {
    // More cells than a frame can draw come in slices alone, which may begin some frames later; also
    // far more than those that were drawn, of which the time is not known well.
    constexpr std::size_t kFarMore = 4;
    const bool near =
        !drawn_ || !drawn_->cells || report.cells <= kFarMore * drawn_->cells->cells();
    const bool fits = near && report.expected && *report.expected <= report.budget;
    const FrameChoice choice = frames_->agree({report.footprint, report.reason, report.final,
                                               measure, quality_.wants_mesh(), detail,
                                               report.in_slices, frames_->slices_are_whole(),
                                               quality_.ends_in_slices() && !fits, all_at_rest_});
    mesh_wanted_ = choice.mesh;
    detail_ = choice.detail;
    all_at_rest_ = choice.all_at_rest;
    shows_slices_ = choice.shows_slices;
    comes_in_slices_ = choice.holds_finer;
    report.in_slices = choice.in_slices;
    report.footprint = choice.footprint;
    report.reason = choice.reason;
    report.final = choice.final;
    return choice.measure;
}

void Session::choose_quality(Picture& now, Waiting waiting, FrameReport& report) {
    learn_costs();
    choose_set(now, waiting, report);
    const bool live = waiting == Waiting::never;
    if (live && !log_.frames().empty())
        report.missed = quality_.missed(report.time - log_.frames().back().time);
    const bool finer = only_gets_finer(now, waiting);
    const bool changed = now != drawn_ && !finer;
    render::FootprintSet footprints = scene_.cells().footprints();
    render::FootprintSet possible = scene_.cells().possible_footprints();
    if (report.cells > frames_->surface_limit())
        for (render::FootprintSet* set : {&footprints, &possible})
            set->remove(render::Footprint::surface);
    const Choosing how = choosing(waiting);
    const bool had_mesh = mesh_wanted_;
    const index::DetailQuery had_detail = detail_;
    bool measure = quality_.choose(state_, changed, how, footprints, possible, report);
    report.final &= is_finest(waiting);
    const index::DetailQuery wanted = wanted_detail(waiting, report);
    report.final &= !live || wanted == detail_;
    measure = agree(measure, wanted, report);
    // A replay's picture is as good as it gets at once.
    if (!live && ((mesh_wanted_ && !had_mesh) || detail_ != had_detail)) {
        request_cells(waiting);
        take_newest_cells(waiting, report);
        now.cells = scene_.cells().shown();
        footprints = scene_.cells().footprints();
        measure = agree(quality_.choose(state_, changed, how, footprints, footprints, report),
                        detail_, report);
    }
    now.footprint = report.footprint;
    rest_in_slices(now, waiting, report);
    comes_in_slices_ &= finer;
    // While a headset wants no picture, there is nothing to draw or to measure.
    report.redrawn = outputs_.want(now.audience) && (now != drawn_ || measure) && !comes_in_slices_;
}

void Session::draw_eyes(const Picture& now, const interaction::InputState& input,
                        FrameReport& report) {
    const Outputs::Overlay panel = frames_->leads()
                                       ? [&](glm::ivec2 size) {
                                             draw_aids();
                                             draw_panel_overlay(size, report);
                                         }
                                       : Outputs::Overlay();
    slices_whole_ = report.in_slices && now.footprint == *report.in_slices;
    if (report.in_slices && !report.redrawn && now.footprint != *report.in_slices &&
        outputs_.want(now.audience)) {
        draw_slices(now, panel, report);
        return outputs_.draw_room(input, panel);
    }
    if (!comes_in_slices_)
        drawn_ = now;
    StopWatch watch;
    if (report.redrawn) {
        slices_.reset();
        views_.clear();
        outputs_.leave_free(now.layout.free);
        outputs_.show_aside(now.layout.aside);
        quality_.begin(log_.next());
        const auto scene = [this](const ScenePlace& place, std::span<const render::View> views) {
            if (!place.kept)
                views_.insert(views_.end(), views.begin(), views.end());
            draw_views(place, views, *drawn_);
        };
        const DrawLoad of_cell = outputs_.draw(now.audience, scene, panel);
        quality_.end(report, of_cell, report.upload + watch.lap());
    } else {
        outputs_.draw_again(now.audience, panel);
    }
    outputs_.draw_room(input, panel);
}

/// The answer that other processes get before a frame is shown.
FrameAnswer Session::answer() const {
    outputs_.gl().Finish(); // a frame that is still being drawn would be shown late
    FrameAnswer answer;
    answer.close = outputs_.windows().should_close();
    answer.failure = extractor_.failure().value_or("");
    answer.view = quality_.view();
    answer.surface_limit = scene_.cells().surface_limit();
    answer.slices_whole = slices_whole_;
    if (slices_ && slices_->whole)
        answer.slices_took = slices_->pace.whole();
    return answer;
}

bool Session::captures(const FrameReport& report) {
    return captures_.take({.time = report.time,
                           .asked = report.asked,
                           .shown = report.shown,
                           .failed = frames_->has_no_answer(extractor_),
                           .final = report.final});
}

void Session::show_messages(std::vector<std::string> messages) {
    if (messages.empty())
        return;
    message_ = std::move(messages.back());
    messages_ += messages.size();
}

const FrameReport& Session::frame(const interaction::InputState& input, const Commands& commands,
                                  Waiting waiting, const Latch& latch) {
    StopWatch whole, since_input;
    const Milliseconds worked = processor_time();
    const Latch heads = frames_->begin(input, commands, waiting, latch, config_.installation);
    FrameReport report;
    report.time = input.time;
    report.tracking = tracking_of(input);
    panel_commands_ = {}; // nobody takes them in a replay
    const interaction::InputState rest = room_panel_.update(input, state_.room_panel);
    const ExplorerState before = state_;
    grow_with(commands);
    state_.apply(commands, file_->info().steps());
    turn_to_array(before);
    if (times_.size() != steps())
        times_.assign(file_->info().times.begin(),
                      file_->info().times.begin() + static_cast<std::ptrdiff_t>(steps()));
    history_.add(before, state_, commands, input);
    if (commands.screenshot)
        captures_.ask();
    report.comfort = comfort_.update(input, state_.room_from_physical);
    report.asked = surfaces();
    report.pace = gate_.update(rest, commands, state_.quality);
    request_cells(waiting);
    report.extracting = extractor_.busy();
    take_newest_cells(waiting, report);
    if (state_.room_panel.shown)
        room_panel_.lay_out(panel_model(PanelPlace::in_room, report), report.time);
    else
        room_panel_.leave_out();
    Picture now = picture(seen(rest, heads, report), report);
    choose_quality(now, waiting, report);

    StopWatch stages;
    draw_eyes(now, input, report);
    interaction::merge(panel_commands_, panel_.draw_alone(panel_models(report), report.time));
    report.draw = stages.lap();
    frames_->swap_barrier([this] { return answer(); });
    report.barrier = stages.lap();
    outputs_.present();
    panel_.present();
    report.present = stages.lap();
    report.latency = clock_ ? Milliseconds(clock_() - input.time) : since_input.lap();
    measure_unseen(now, whole, report);
    input_ = input;
    if (captures(report))
        outputs_.take_screenshots(note());
    show_messages(outputs_.pictures().messages());
    show_messages(picker_.messages());
    report.extracting |= extractor_.busy();
    report.processor = processor_time() - worked;
    report.total = whole.lap();
    log_.add(report);
    return log_.frames().back();
}

} // namespace isochron::app
