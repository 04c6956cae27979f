// One session: brings data, search, devices and displays together, frame by frame.
#include "app/session/session.h"

#include "app/end_in_time.h"
#include "app/frame/stop_watch.h"
#include "app/session/start_state.h"
#include "index/file/index_watch.h"
#include "interaction/navigation/key_frames.h"
#include "interaction/navigation/navigation.h"
#include "interaction/navigation/story.h"
#include "interaction/tools/tool_table.h"

#include <fmt/format.h>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vector_relational.hpp>

#include <algorithm>

namespace isochron::app {

using interaction::Commands;

Session::Session(Config config, std::shared_ptr<const index::IndexFile> file,
                 stereo::Windows windows, index::Extract extract,
                 std::unique_ptr<stereo::Headset> headset)
    : config_(std::move(config)), outputs_(config_, std::move(windows), std::move(headset)),
      state_(start_state(config_, file)), home_(state_), arrays_(config_, file, home_),
      times_(known_times(file->info(), 0)), gate_(config_.quality.stillness),
      comfort_(config_.comfort), scene_(outputs_.gl(), file->info(), config_),
      panel_(config_, outputs_), picker_(file),
      supply_(config_, file, scene_.cells(), std::move(extract),
              render::CellBuffers::wanted_shading(outputs_.gl())),
      slices_(file), models_(file->name()), ghosts_(file), further_(file),
      pictures_(config_, arrays_, scene_.cells(), outputs_, panel_, picker_, slices_, models_,
                ghosts_, further_),
      choice_(config_, outputs_, log_, scene_, supply_, pictures_),
      partial_(scene_, outputs_, choice_.quality()), samples_(scene_, outputs_, choice_.quality()),
      nothing_(arrays_, outputs_) {
    for (std::size_t number = 1; number < file->arrays(); ++number)
        scene_.cells().prepare_for(file->array(number).info());
}

bool Session::should_close() const {
    return outputs_.windows().should_close() || frames_->close_wanted();
}

std::string Session::drawing() const {
    std::string text = outputs_.windows().drawing().description();
    for (const std::string& line : scene_.given_up())
        text += "; " + line;
    return text;
}

void Session::set_state(const ExplorerState& state) {
    expect_array(state.array);
    state_ = state;
    show_messages(arrays_.settle(state_));
    picker_.set_file(arrays_.held(state_));
}

void Session::set_home(const ExplorerState& home) {
    home_ = home;
    arrays_.settle(home_);
    state_ = home_;
}

void Session::grow(std::shared_ptr<const index::IndexFile> file) {
    arrays_.set_file(file);
    picker_.set_file(arrays_.held(state_));
    slices_.set_file(file);
    ghosts_.set_file(file);
    further_.set_file(file);
    supply_.set_file(std::move(file));
}

/// In a cluster rank 0 reports that there are more steps, and the other processes look for them.
void Session::grow_with(const Commands& commands) {
    const index::IndexFile& file = *arrays_.file();
    if (!commands.steps || *commands.steps <= file.info().steps())
        return;
    if (auto grown = index::grown(file.name(), file))
        grow(std::move(grown));
}

interaction::ControlContext Session::control_context(const interaction::Ways& ways) const {
    const index::IndexFile& array = arrays_.of(state_, state_.picked);
    return {.settings = state_,
            .series = {.low = array.stats().low,
                       .high = array.stats().high,
                       .times = &times_.at,
                       .gaps = &times_.gaps,
                       .pivot = physical_center(arrays_.file()->info().grid),
                       .home = home_place()},
            .color_arrays = {&arrays_.color_names(), color_array(state_, *arrays_.file())},
            .called_panel = {panel_.in_room().distance(), panel_.place()},
            .ways = ways,
            .stereo_modes = &outputs_.stereo_modes(),
            .data = data_frame(arrays_.file()->info()),
            .find_surface =
                [this](const interaction::Pose& ray) {
                    return picker_.hit_by(ray, state_, scene_.cells().shown());
                },
            .fades = fades_to_steps()};
}

/// Whoever wants no motion that is not their own: in headsets, and where motion narrows the view.
bool Session::fades_to_steps() const {
    return outputs_.headset() || config_.comfort.vignette;
}

Commands Session::commands_from(const interaction::InputState& input) {
    const std::size_t arrays = arrays_.names().size();
    Commands start = state_.way_to_start(home_);
    start.room_from_physical.reset();
    if (const interaction::Similarity home = home_place(); home != state_.room_from_physical)
        start.room_from_physical = home;
    std::optional<Commands> next_array;
    if (arrays > 1)
        next_array = way_to_array((arrays_.number(state_) + 1) % arrays);
    const PanelInRoom::Outcome& panel = panel_.in_room().update(input, state_.room_panel);
    interaction::ControlContext context =
        control_context({.next_array = next_array ? &*next_array : nullptr,
                         .start = &start,
                         .undo = history_.undo(),
                         .redo = history_.redo()});
    if (panel_.in_room().touched()) // the wand points at the panel, which is in front of the data
        context.find_surface = {};
    Commands commands = controls_.update(panel.rest, context);
    interaction::merge(commands, panel.commands);
    picker_.update(panel.rest, state_, scene_.cells().shown());
    return commands;
}

Commands Session::take_panel_commands() {
    Commands commands = panel_.take_commands();
    // What is found depends on what is shown, so it is recorded like the operator's panel's
    // commands.
    interaction::merge(commands, controls_.take_found());
    interaction::merge(commands, picker_.take_found());
    return commands;
}

std::optional<interaction::Pose> Session::ray_at(const interaction::MouseMoveEvent& cursor,
                                                 const interaction::Pose& head) const {
    if (panel_.over().covers(cursor))
        return std::nullopt;
    interaction::InputState emulated;
    emulated.devices.push_back({.name = "head", .pose = head, .valuators = {}});
    return outputs_.ray_at(cursor, pictures_.viewers(emulated, state_));
}

/// The devices that the views are made from, polled as late as possible.
interaction::InputState Session::seen(const interaction::InputState& input, const Latch& latch,
                                      FrameReport& report) {
    const interaction::InputState newest =
        latch ? latch() : interaction::InputState{input.time, {}};
    note_.latched = viewers_heads(newest, config_.installation);
    interaction::InputState seen = with_heads(input, note_.latched);
    report.pose_age = pose_age(seen, newest.time, config_.installation);
    return seen;
}

/// The place of the data at the start, from so far that models are as much in view as the data were.
interaction::Similarity Session::home_place() const {
    const interaction::Similarity& place = home_.room_from_physical;
    if (state_.models.empty())
        return place;
    const index::Grid& grid = arrays_.file()->info().grid;
    const auto data = models_.box({}, grid), all = models_.box(state_, grid);
    if (all == data)
        return place;
    const glm::dvec3 middle = interaction::transform(place, physical_center(grid));
    const glm::dvec3 wider = interaction::transform(place, 0.5 * all[0] + 0.5 * all[1]);
    return interaction::scaled(interaction::moved(place, middle - wider), middle,
                               glm::distance(data[0], data[1]) / glm::distance(all[0], all[1]), 0.0,
                               place.scale);
}

/// Where the data lie to the viewer as they did at the start.
interaction::Similarity Session::all_in_view(const Audience& audience) const {
    const interaction::Pose first{config_.installation.viewers.front().position, {1, 0, 0, 0}};
    const interaction::Similarity home = home_place();
    return audience.viewers.empty()
               ? home
               : interaction::carried(home, first, audience.viewers.front().head);
}

std::string Session::show_model(const std::filesystem::path& file) {
    std::vector<interaction::Model> models = state_.models;
    const std::string path = models_.allow(file);
    const auto there = std::ranges::find(models, path, &interaction::Model::path);
    if (there != models.end())
        there->shown = true;
    else if (models.size() == interaction::kMostModels)
        return fmt::format("{}: not shown: {} models are shown, expected fewer", file.string(),
                           models.size());
    else if (path.size() > interaction::kLongestArrayName)
        return fmt::format("{}: not shown: a path of {} bytes, expected at most {}", file.string(),
                           path.size(), interaction::kLongestArrayName);
    else
        models.push_back({.path = path});
    Commands commands;
    commands.models = std::move(models);
    panel_.add(commands);
    return {};
}

PanelModel Session::panel_model(const FrameReport& report) {
    static const std::vector<interaction::ControlGroup> controls =
        interaction::Controls::documentation();
    const index::IndexFile& array = arrays_.shown(state_);
    const auto scale = pictures_.scale(state_);
    const std::size_t sliced = slice_array(state_, *arrays_.file());
    return {.info = array.info(),
            .stats = array.stats(),
            .data = data_frame(arrays_.file()->info()),
            .asked = state_,
            .frame = report,
            .gaps = times_.gaps.steps(),
            .arrays = arrays_.in_panel(state_),
            .colors = {.range = scale ? scale->range : std::array{0.0, 0.0},
                       .slices = slice_scale(state_, *arrays_.file(), sliced).range,
                       .sliced = sliced,
                       .own_maps = config_.color_maps},
            .work = {.frames = log_.speed(),
                     .reading = reading(),
                     .at_hand_steps = supply_.extractor().at_hand(),
                     .searching = supply_.extractor().busy(),
                     .survey = nothing_.survey()},
            .curves = curves_.in_panel(state_),
            .models = {.lines = models_.listed(state_),
                       .allow = [this](const std::string& path) { models_.allow(path); }},
            .ghosts = {.wished = ghost_words(ghosts_.wished()), .shown = ghosts_.words()},
            .pieces = pieces_.in_panel(report, scene_.cells().shown()),
            .notes = {.failure = failure(), .standing = captures_.note(), .empty = nothing_.why()},
            .controls = controls,
            .at_hand = kinds_at_hand(!config_.devices.empty() || outputs_.headset(), note_.input),
            .ways = {.undo = history_.undo(), .redo = history_.redo()},
            .head = outputs_.audience().viewers.empty() ? interaction::Pose{}
                                                        : outputs_.audience().viewers.front().head,
            .quad_buffered = outputs_.windows()[0].has_stereo_buffers(),
            .room_from_outside = outputs_.room() != nullptr,
            .told_at = told_at(),
            .pointed = [this] { return pictures_.pointed(note_.input, state_); }};
}

/// In the only picture of a window on a desk.
std::optional<glm::vec2> Session::told_at() const {
    const interaction::KeyFrame* const key = interaction::told_key(state_);
    const Audience& audience = outputs_.audience();
    if (!key || !key->place || audience.viewers.empty() || !pictures_.on_desktop(audience))
        return std::nullopt;
    const auto views = outputs_.display().views_in_window(audience.viewers);
    if (views.size() != 1)
        return std::nullopt;
    const render::View& view = views.front();
    const glm::vec4 at(glm::vec3(transform(state_.room_from_physical, *key->place)), 1.0f);
    const glm::vec4 clip = view.steady().clip_from_eye * view.eye_from_room * at;
    const glm::vec2 seen = 0.5f * glm::vec2(clip) / clip.w + 0.5f;
    if (clip.w <= 0.0f || glm::any(glm::lessThan(seen, glm::vec2(0.0f))) ||
        glm::any(glm::greaterThan(seen, glm::vec2(1.0f))))
        return std::nullopt;
    const glm::vec2 window(outputs_.windows().first().framebuffer_size());
    const glm::vec2 pixel = glm::vec2(view.corner) + seen * glm::vec2(view.size);
    return glm::vec2(pixel.x / window.x, 1.0f - pixel.y / window.y);
}

void Session::warm_up(const std::function<bool(float)>& goes_on) {
    if (outputs_.headset())
        return;
    const Picture picture = pictures_.first(state_);
    outputs_.draw(picture.audience,
                  [&, picture](const ScenePlace&, std::span<const render::View> views) {
                      scene_.draw(picture, views);
                  },
                  {});
    Outputs::PartPlace place;
    std::size_t way = 0;
    float share = 0; // share of the window that is drawn
    for (bool whole = false; !whole && goes_on(share);)
        whole = outputs_.draw_part(
            picture.audience, place, [&](const ScenePlace&, std::span<const render::View> views) {
                share = scene_.warm_up(picture, views, way = place.begins ? 0 : way + 1);
                return share >= 1;
            });
    outputs_.prepare_mean();
}

void Session::prepare_first(const std::function<bool(float)>& goes_on,
                            std::unique_ptr<stereo::GlContext> beside) {
    Picture picture = pictures_.first(state_);
    outputs_.draw(picture.audience,
                  [&, picture](const ScenePlace&, std::span<const render::View> views) {
                      scene_.draw(picture, views);
                  },
                  {});
    pictures_.show_cells(picture, state_); // and how they are colored
    const std::vector<std::size_t> needed = scene_.begin_in_few_ways(picture);
    Preparation::Target target{
        .views = {}, .size = glm::ivec2(1), .options = display_options(outputs_.gl(), config_)};
    Outputs::PartPlace place;
    for (std::size_t i = 0; i < needed.size(); ++i) {
        if (!goes_on(static_cast<float>(i) / static_cast<float>(needed.size())))
            return;
        outputs_.draw_part(picture.audience, place,
                           [&](const ScenePlace&, std::span<const render::View> views) {
                               target.views.assign(views.begin(), views.end());
                               scene_.prepare(needed[i], views);
                               return i + 1 == needed.size();
                           });
    }
    for (const render::View& view : target.views)
        target.size = glm::max(target.size, view.corner + view.size);
    preparation_.emplace(outputs_.gl(), scene_, std::move(target), std::move(beside));
}

bool Session::prepare_some() {
    const DrawsOnly draws; // a driver compiles for seconds
    const bool has = preparation_ && preparation_->advance();
    if (preparation_ && preparation_->is_done()) {
        preparation_.reset();
        outputs_.prepare_mean();
    }
    return has;
}

void Session::draw_eyes(const Frame& frame, const Picture& now,
                        const interaction::InputState& input, const SessionPanel::Facts& facts) {
    const Outputs::Overlay overlay =
        frames_->leads() ? [&](glm::ivec2 size) {
            draw_aids();
            panel_.draw_over(size, state_, facts, frame.report.time);
        } : Outputs::Overlay();
    const auto parts = plan_.state.in_parts();
    const bool in_parts = parts == now.footprint;
    partial_.begin_frame(in_parts);
    samples_.begin_frame(is_settled(frame));
    if (parts && !frame.report.redrawn && !in_parts && outputs_.want(now.audience)) {
        samples_.give_up();
        if (auto whole = partial_.draw(frame, now, overlay)) {
            drawn_ = std::move(whole);
            frame.report.footprint = drawn_->footprint;
            frame.report.redrawn = true;
        } else {
            frame.report.draws_parts = true;
            show_again(frame, now, overlay, facts);
        }
    } else {
        if (!plan_.state.is_held())
            drawn_ = now;
        if (frame.report.redrawn)
            draw_anew(frame, now, overlay);
        else
            show_again(frame, now, overlay, facts);
    }
    outputs_.draw_room(input, overlay);
}

void Session::draw_anew(const Frame& frame, const Picture& now, const Outputs::Overlay& overlay) {
    StopWatch watch;
    partial_.give_up_others(*drawn_);
    samples_.give_up();
    supply_.forget_views();
    outputs_.leave_free(now.layout.free);
    outputs_.show_aside(now.layout.aside);
    if (plan_.state.is_trial())
        scene_.forget_cells();
    // What is only drawn over kept cells, or without cells, tells nothing of what cells take.
    const bool cells =
        drawn_->surfaces && !scene_.keeps_cells(*drawn_, outputs_.viewports(now.audience));
    if (cells)
        choice_.quality().begin(log_.next());
    const bool keeps = supply_.keeps_cells(frame, *drawn_);
    const auto scene = [this, keeps](const ScenePlace& place, std::span<const render::View> views) {
        if (place.kept) {
            scene_.draw(pictures_.kept(*drawn_, state_.pictures), views);
        } else {
            supply_.note_views(views);
            scene_.draw(*drawn_, views, {.keeps = keeps});
        }
    };
    const DrawLoad of_cell = outputs_.draw(now.audience, scene, overlay);
    if (cells)
        choice_.quality().end(frame.report, of_cell, frame.report.upload + watch.lap());
}

/// Whether the picture of this frame is exact, and nothing but itself is still to be drawn.
bool Session::is_settled(const Frame& frame) const {
    const FrameReport& report = frame.report;
    return frame.is_live() && frames_->alone() && report.final && !plan_.state.is_held() &&
           report.footprint == render::Footprint::surface && !report.moved && !report.extracting &&
           !plan_.state.draws_ahead() && !state_.playback.playing && !supply_.set_comes() &&
           !more_comes() && scene_.cells().is_complete();
}

bool Session::samples_come_later() const {
    return prepares() && !awaited_ && captures_.wanted() == 0;
}

/// Keeps the last picture. It is composed anew only if something else lies over it, or if it has more
/// samples.
void Session::show_again(const Frame& frame, const Picture& now, const Outputs::Overlay& overlay,
                         const SessionPanel::Facts& facts) {
    const bool can_stay = frames_->alone() && outputs_.can_stay();
    if (can_stay)
        panel_.lay_out_over(state_, facts, frame.report.time);
    if (can_stay && !samples_come_later() && samples_.take(*drawn_))
        outputs_.show_parts(overlay);
    else if (can_stay && contents_.stay(panel_.overlay(pictures_.over())))
        outputs_.stay(now.audience);
    else
        outputs_.draw_again(now.audience, overlay);
}

/// Over the last picture, which lacks them.
void Session::draw_aids() {
    const Aids& over = pictures_.over();
    if (!over.wand && !over.pointed)
        return;
    for (const render::View& view : outputs_.display().views_in_window(outputs_.audience().viewers))
        scene_.draw_aids(*drawn_, over, view);
}

/// The answer that other processes get before a frame is shown.
FrameAnswer Session::answer() const {
    outputs_.gl().Finish(); // a frame that is still being drawn would be shown late
    FrameAnswer answer;
    answer.close = outputs_.windows().should_close();
    answer.failure = supply_.extractor().failure().value_or("");
    answer.view = choice_.quality().view();
    answer.surface_limit = scene_.cells().surface_limit();
    answer.parts_whole = partial_.are_whole();
    answer.parts_took = partial_.took();
    return answer;
}

CaptureView Session::capture_view(const FrameReport& frame) const {
    CaptureView view = CaptureView::of(frame, frames_->has_no_answer(supply_.extractor()));
    if (samples_.are_missing() || more_comes()) {
        view.final = false;
        view.improves = true;
    }
    return view;
}

PictureNote Session::note() const {
    PictureNote note = note_;
    note.data_hash = fmt::format("{:016x}", arrays_.file()->content_hash());
    note.reading = arrays_.file()->metadata().reading_number;
    note.footprint = name_of(drawn_ ? drawn_->footprint : render::Footprint{});
    note.text = drawn_ ? drawn_->layout.text : 0.0f;
    if (drawn_ && drawn_->title.opacity > 0) {
        note.title = drawn_->title.words;
        note.opacity = static_cast<double>(drawn_->title.opacity);
    }
    note.as_seen = config_.pictures.only_kept ||
                   (drawn_ && pictures_.kept(*drawn_, state_.pictures) == *drawn_);
    ExplorerState state = state_;
    state.pictures = pictures_.written(state.pictures);
    if (const index::ExtractionPtr& shown = scene_.cells().shown()) { // may lag while time plays
        state.instant = shown->query.instant;
        for (std::size_t i = 0; i < shown->query.isovalues.size() && i < state.isosurfaces.size();
             ++i)
            if (state.isosurfaces[i].of_shown_array())
                state.isosurfaces[i].isovalue = shown->query.isovalues[i];
    }
    note.state = interaction::kept_state(state.as_commands());
    return note;
}

/// Takes the commands over into the state, and into what depends on it.
void Session::obey(const Commands& commands, const interaction::InputState& input) {
    const ExplorerState before = state_;
    grow_with(commands);
    state_.apply(commands, arrays_.file()->info().steps());
    if (state_.isosurfaces != before.isosurfaces || state_.array != before.array)
        show_messages(arrays_.settle(state_));
    if (arrays_.turn(before, state_))
        picker_.set_file(arrays_.held(state_));
    if (times_.at.size() != steps())
        times_ = known_times(arrays_.file()->info(), steps());
    history_.add(before, state_, commands, input);
    if (commands.undo || commands.redo)
        show_messages({fmt::format("{}: {}", commands.undo ? "Undo" : "Redo",
                                   words_for_change(before, state_))});
    if (commands.screenshot)
        captures_.ask();
}

void Session::set_wake(const std::function<void()>& wake) {
    supply_.set_wake(wake);
    slices_.set_wake(wake);
    models_.set_wake(wake);
    ghosts_.set_wake(wake);
    further_.set_wake(wake);
    picker_.set_wake(wake);
    nothing_.set_wake(wake);
    curves_.set_wake(wake);
    pieces_.set_wake(wake);
    outputs_.pictures().set_wake(wake);
    if (preparation_)
        preparation_->set_wake(wake);
}

FrameOutlook Session::outlook() const {
    const FrameReport& last = log_.frames().back();
    const FrameOutlook picture{
        .busy = state_.playback.playing || controls_.tells_on(state_.story) || last.extracting ||
                more_comes() || partial_.are_made() ||
                (samples_.are_missing() && !samples_come_later()) || captures_.wanted() > 0 ||
                last.comfort != interaction::ComfortState{},
        .changed = contents_.changed() || last.uploaded != render::UploadCount{},
        .final =
            last.final && !last.retries && scene_.cells().is_complete() && !supply_.set_comes()};
    return both(picture, panel_.outlook());
}

const FrameReport& Session::frame(const interaction::InputState& input, const Commands& commands,
                                  Waiting waiting, const Latch& latch) {
    StopWatch whole, since_input;
    const Milliseconds worked = processor_time();
    const Latch heads = frames_->begin(input, commands, waiting, latch, config_.installation);
    FrameReport report;
    report.time = input.time;
    report.after_wait = std::exchange(waited_, false);
    report.tracking = tracking_of(input);
    take_panel_commands(); // nobody takes them in a replay
    show_messages(controls_.take_notes());
    const interaction::InputState rest = panel_.in_room().update(input, state_.room_panel).rest;
    obey(commands, input);
    report.comfort =
        comfort_.update(input, state_.room_from_physical,
                        waiting == Waiting::never && fades_to_steps() ? state_.story : 0);
    report.asked = arrays_.surfaces(state_);
    report.pace = gate_.update(rest, commands, state_.quality, playing_in(waiting));
    const Frame frame{.state = state_,
                      .file = *arrays_.file(),
                      .steps = steps(),
                      .waiting = waiting,
                      .is_kept = captures_.wanted() > 0,
                      .drawn = drawn_,
                      .sharing = *frames_,
                      .plan = plan_,
                      .report = report};
    const SessionPanel::Facts facts = [&] { return panel_model(report); };
    const DrawsOnly draws; // what is sent to the GPU may make it compile
    supply_.request(frame);
    supply_.take_newest(frame);
    slices_.update(frame);
    models_.update(frame);
    if (const auto& slices = slices_.shown(); !slices.empty())
        picker_.set_slices(slices, arrays_.file()->array(slices.front()->query.array).info());
    else
        picker_.set_slices({}, {});
    ghosts_.update(frame, times_.gaps);
    picker_.set_ghosts(ghosts_.shown());
    further_.update(frame, arrays_.further(state_));
    picker_.set_further(shown_further(further_.shown(), state_, *arrays_.file()));
    show_messages(supply_.take_messages());
    show_messages(slices_.take_messages());
    show_messages(models_.take_messages());
    show_messages(ghosts_.take_messages());
    show_messages(further_.take_messages());
    curves_.update(frame, arrays_, supply_.extractor());
    pieces_.update(frame, arrays_);
    panel_.lay_out_room(state_, facts, report.time);
    Picture now = pictures_.make(frame, seen(rest, heads, report));
    choice_.choose(frame, now);
    nothing_.update(frame, {.cells = scene_.cells().shown(),
                            .audience = now.audience,
                            .in_window = pictures_.on_desktop(now.audience),
                            .all_in_view = all_in_view(now.audience)});
    if (now.audience.lifted && !std::exchange(told_of_lifting_, true))
        show_messages({"the background is lifted, so that dark colors are seen: Ctrl + G"});
    StopWatch stages;
    contents_.begin_frame();
    draw_eyes(frame, now, input, facts);
    panel_.draw_alone(facts, report.time);
    report.draw = stages.lap();
    frames_->swap_barrier([this] { return answer(); });
    report.barrier = stages.lap();
    const Milliseconds drawn = processor_time();
    contents_.end_frame(panel_.overlay(pictures_.over()), report.redrawn);
    const bool damaged = outputs_.windows().take_damage();
    if (contents_.composed() || damaged)
        outputs_.present();
    panel_.present(damaged);
    report.present = stages.lap();
    if (contents_.composed()) // without the wait for a display that paces the frames
        choice_.quality().presented(std::min(report.present, processor_time() - drawn));
    report.latency = clock_ ? Milliseconds(clock_() - input.time) : since_input.lap();
    partial_.draw_ahead(frame, now, whole);
    note_.input = input;
    if (captures_.take(capture_view(report)))
        outputs_.take_screenshots(note());
    show_messages(outputs_.pictures().messages());
    show_messages(picker_.messages());
    show_messages(curves_.messages());
    report.extracting |= supply_.extractor().busy() || more_comes();
    report.processor = processor_time() - worked;
    report.total = whole.lap();
    log_.add(report);
    return log_.frames().back();
}

} // namespace isochron::app
