// The live loop, from devices to frames.
#include "app/session/live_loop.h"

#include "app/frame/pacer.h"
#include "index/error.h"
#include "index/system/new_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <utility>

namespace isochron::app {

using interaction::Commands;
using interaction::InputState;
using interaction::Seconds;

LiveLoop::LiveLoop(const Config& config, interaction::CompositeInput trackers,
                   const LiveOptions& options, stereo::Headset* headset)
    : config_(config), options_(options), trackers_(std::move(trackers)),
      emulation_(emulation_for(config)), camera_(config.installation), headset_(headset),
      opening_(options.why_not_open),
      clock_(options.clock ? options.clock : [start = std::chrono::steady_clock::now()] {
          return Seconds(std::chrono::steady_clock::now() - start);
      }) {}

std::function<void()> LiveLoop::waker() const {
    return [wake = wake_] { (*wake)(); };
}

void LiveLoop::record(const std::filesystem::path& path,
                      const interaction::RecordingHeader& header) {
    recording_.begin(path, header);
    recording_.set_wake(waker());
}

void LiveLoop::keep_session(const std::filesystem::path& path, const SavedSession& start,
                            bool resumed) {
    keeper_.emplace(path, start, resumed);
    keeper_->set_wake(waker());
}

void LiveLoop::watch(const std::filesystem::path& path,
                     std::shared_ptr<const index::IndexFile> file) {
    watch_.emplace(path, std::move(file), waker());
}

void LiveLoop::steer(SessionControl& control) {
    control_ = &control;
    control.set_wake(waker());
}

/// Reports new steps as commands, so that recordings and all processes of a cluster get them.
void LiveLoop::take_new_steps(Session& session, Commands& asked) {
    auto newer = watch_ ? watch_->take() : nullptr;
    if (!newer)
        return;
    const auto steps = static_cast<std::uint32_t>(newer->info().steps());
    if (control_)
        control_->set_file(newer);
    if (surfaces_)
        surfaces_->set_file(newer);
    session.grow(std::move(newer));
    session.show_messages({fmt::format("{} steps now", steps)});
    asked.steps = steps;
    if (session.state().follow)
        asked.step = steps - 1;
}

/// The panel's button: a recording from now on, in the folder of the movies; or the end of the one
/// that goes on.
void LiveLoop::begin_or_end_recording(Session& session) {
    if (recording_.is_open()) {
        recording_.end();
    } else {
        try {
            interaction::RecordingHeader header = movies_->orders().header;
            header.start = session.state().as_commands();
            const auto path = free_recording_name(chosen_folder(session));
            record(path, header);
            session.show_messages({fmt::format("recording to {}", path.string())});
        } catch (const interaction::Error& error) {
            session.show_messages({error.what()});
        }
    }
    session.set_recording(recording_.is_open());
}

/// Where pictures, movies and recordings are written.
std::filesystem::path LiveLoop::chosen_folder(const Session& session) const {
    const std::filesystem::path chosen = session.state().pictures.folder;
    return chosen.empty() ? movies_->orders().folder : chosen;
}

/// Pictures lie where the user has said last.
void LiveLoop::place_pictures(Session& session) {
    if (session.state().pictures.folder == picture_folder_ || !movies_)
        return;
    picture_folder_ = session.state().pictures.folder;
    try {
        index::make_folder(chosen_folder(session));
        session.outputs().set_screenshots(chosen_folder(session));
    } catch (const index::Error& error) {
        session.show_messages({error.what()});
    }
}

/// Begins and ends those that the panel asks for.
void LiveLoop::make_movies(Session& session) {
    if (!movies_)
        return;
    const interaction::WrittenPictures& how = session.state().pictures;
    const MovieManner manner{how.folder, how.rate, how.width, how.height};
    const std::optional<MovieWish> wish = session.panel().take_wanted_movie();
    if (wish == MovieWish::record)
        begin_or_end_recording(session);
    else if (wish == MovieWish::give_up)
        movies_->give_up();
    else if (wish == MovieWish::recording && recording_.is_open())
        movies_->make(recording_.copy(), recording_.work(), manner);
    else if (wish == MovieWish::series)
        movies_->make([series = series_seen(sized(movies_->orders().header, how), session.note(),
                                            session.times(), how.rate)](
                          const auto& path) { write_recording(path, series); },
                      recording_.work(), manner);
    movies_->update();
    session.show_messages(movies_->messages());
    session.set_movies({true, recording_.is_open(), movies_->progress()});
}

/// Begins or cancels an export as the state asks for. @return how far it is, if that is new
std::optional<interaction::ExportWork> LiveLoop::export_surfaces(Session& session) {
    if (!surfaces_)
        return std::nullopt;
    session.show_messages(surfaces_->messages());
    return surfaces_->update(session.state(), [&] { return session.scale(); });
}

/// Why these data cannot give way to others now; empty: they can.
std::string LiveLoop::why_data_stay() const {
    return movies_ && movies_->busy()
               ? "a movie is being made: open other data when it is finished, or cancel it"
               : options_.stays;
}

/// Begins to open other data.
void LiveLoop::open(const std::filesystem::path& data, Session& session) {
    std::string said = why_data_stay();
    if (said.empty())
        said = opening_.open(data);
    if (!said.empty())
        session.show_messages({said});
}

/// Takes other data that the user has chosen, or dropped onto a window.
void LiveLoop::take_next_data(Session& session) {
    if (const auto chosen = session.panel().take_chosen())
        open(*chosen, session);
    if (const auto array = session.panel().take_chosen_array()) {
        if (const std::string why = why_data_stay(); !why.empty())
            session.show_messages({why});
        else
            next_data_ = NextData{{}, *array};
    }
    const auto dropped = session.outputs().windows().first().take_dropped();
    if (const auto name = one_name_of(dropped))
        open(*name, session);
    else if (!dropped.empty())
        session.show_messages({kNoCommonName});
    if (const std::string said = opening_.update(); !said.empty())
        session.show_messages({said});
    if (auto ready = opening_.take_ready())
        next_data_ = NextData{std::move(*ready)};
}

/// What goes on for longer, in the picture.
void LiveLoop::note_work(Session& session) const {
    std::string note = opening_.note();
    if (note.empty() && options_.standing)
        note = options_.standing();
    session.set_standing(std::move(note));
}

/// The devices of a frame that begins now.
InputState LiveLoop::poll(std::span<const interaction::WindowEvent> events) {
    if (options_.emulated)
        emulation_.feed(camera_.feed(events));
    else
        emulation_.feed(events);
    paced_ = headset_.begin_frame(clock_());
    const Seconds now = clock_();
    InputState input = trackers_.poll(now);
    InputState emulated = emulation_.poll(now);
    // The cursor's ray begins at the emulated eye. With a tracked head or wand, the wand points.
    if (input.find("head") || input.find("wand"))
        std::erase_if(emulated.devices,
                      [](const interaction::DeviceState& each) { return each.name == "pointer"; });
    input = interaction::merged(std::move(input), emulated);
    if (options_.emulated)
        input.devices.push_back({.name = kRoomCamera, .pose = camera_.pose(), .valuators = {}});
    return headset_.with_devices(std::move(input), now);
}

bool LiveLoop::goes_on(const Commands& commands, const InputState& input) const {
    return !commands.quit && !options_.ended() && !headset_.ended() &&
           !(options_.length && input.time >= *options_.length);
}

/// Whether a closed window ends the loop. If the user has made changes, asks first; closing a
/// window again while the question is open ends the loop.
bool LiveLoop::closes(const Session& session, Commands& asked) const {
    if (!session.should_close())
        return false;
    const stereo::Windows& windows = session.outputs().windows();
    const bool loses = session.history().has_changes() || (movies_ && movies_->busy());
    if (!windows.should_close() || !loses || session.state().leaving)
        return true;
    windows.keep_open();
    asked.leaving = true;
    return false;
}

/// Saves the session, and gives the clipboard what the user has asked for.
void LiveLoop::keep(Session& session, const Commands& commands, Seconds now) {
    if (commands.copy) {
        const std::string words = session.pointed();
        if (!words.empty())
            session.outputs().windows().first().set_clipboard(words);
        session.show_messages({words.empty() ? "nothing to copy: point at a surface or mark a place"
                                             : "copied: " + words});
    }
    if (!keeper_) {
        if (commands.save)
            session.show_messages({not_kept_});
        return;
    }
    if (commands.save)
        keeper_->save_now(session.state(), emulation_.standing(), session.left_arrays());
    else if (keeper_->is_due(now))
        keeper_->update(session.state(), emulation_.standing(), now, session.left_arrays());
    session.show_messages(keeper_->messages());
}

/// Whether nothing but windows, mouse and keyboard can bring something new.
bool LiveLoop::may_wait(const FrameSharing& frames, const stereo::Headset* headset) const {
    return frames.alone() && !headset && trackers_.empty();
}

/// The windows' events since the last frame. The first frame after a wait gets none: it ends the
/// time without events, so that a new event begins a moment before the frame that gets it, and not
/// when the wait began.
std::vector<interaction::WindowEvent> LiveLoop::new_events(const stereo::Windows& windows) {
    acted_ = false;
    if (waited_)
        return {};
    std::vector<interaction::WindowEvent> events = options_.behind_early(windows.poll_events());
    // What a gamepad's sticks do is seen in the devices; at rest they tremble.
    acted_ = std::ranges::any_of(events, [](const interaction::WindowEvent& event) {
        return !std::holds_alternative<interaction::GamepadEvent>(event);
    });
    return events;
}

/// What the devices, and the work in the background, tell about the next frame.
FrameOutlook LiveLoop::outlook(const InputState& input) const {
    constexpr Seconds kLookForWords{0.1}; // words of another process, or of a thread that ends
    constexpr Seconds kLookForProgress{0.25};
    const bool waited_for = control_ && control_->is_waited_for();
    FrameOutlook next{.busy = is_held(input) || waited_for, .changed = acted_, .final = true};
    const auto look = [&](Seconds at) { next.until = std::min(next.until, at); };
    if (keeper_)
        look(keeper_->due());
    if (options_.length)
        look(*options_.length);
    if (opening_.busy() || (movies_ && movies_->busy()))
        look(input.time + kLookForWords);
    if (options_.standing && !options_.standing().empty())
        look(input.time + kLookForProgress);
    return next;
}

/// Waits until something happens, if nothing does. @return whether it has waited
bool LiveLoop::wait(const FrameOutlook& next, const stereo::Windows& windows) {
    // Events that ended the last wait are still there, and get their frame first.
    const auto longest = idle_.after(next, clock_());
    if (!longest || waited_)
        return false;
    recording_.rest();
    const Seconds end = clock_() + *longest;
    windows.wait(*wake_, *longest);
    if (clock_() < end)
        idle_.woken();
    return true;
}

void LiveLoop::run(Session& session) {
    session.set_wake(waker());
    const Latch latch = [this] { return trackers_.latch(clock_()); };
    Pacer pacer(config_.rendering.frame_rate_limit);
    emulation_.set_eye(
        [&session](const interaction::Pose& head, const interaction::MouseMoveEvent& cursor) {
            return session.ray_at(cursor, head);
        });
    trackers_.begin();
    for (bool running = true; running;) {
        Commands asked;
        if (closes(session, asked))
            break;
        const auto exported = export_surfaces(session);
        auto events = session.panel_events(new_events(session.outputs().windows()));
        if (const std::string said = opening_.cancel_on_escape(events); !said.empty())
            session.show_messages({said});
        if (interaction::is_pressed(interaction::Key::f11, events))
            session.outputs().windows().first().toggle_fullscreen();
        if (config_.devices.empty() &&
            !session.outputs().headset()) // a tracked wand points instead
            emulation_.set_panel(session.state().room_panel, session.room_panel_size());
        const InputState input = poll(events);
        session.set_headset_period(headset_.period());
        Commands commands = session.commands_from(input);
        Commands from_panel = session.take_panel_commands();
        if (!commands.exporting && !from_panel.exporting) // what the user asks for counts
            from_panel.exporting = exported;
        if (control_)
            interaction::merge(asked, control_->take(session));
        take_new_steps(session, asked);
        interaction::merge(from_panel, asked);
        interaction::merge(commands, from_panel);
        headset_.feel(commands.haptics);
        const FrameReport& drawn = session.frame(input, commands, Waiting::never, latch);
        if (control_)
            control_->tell(session, drawn);
        session.set_recording(records());
        if (records())
            recording_.append(
                {input, commands, from_panel, name_of(drawn.footprint), session.latched()});
        session.show_messages(recording_.messages());
        keep(session, commands, input.time);
        place_pictures(session);
        make_movies(session);
        note_work(session);
        take_next_data(session);
        running = goes_on(commands, input) && !next_data_;
        if (!paced_ && !waited_)
            pacer.wait();
        waited_ = running && may_wait(session.frames(), session.outputs().headset()) &&
                  wait(both(session.outlook(), outlook(input)), session.outputs().windows());
        if (waited_)
            session.has_waited();
    }
    headset_.leave();
}

void LiveLoop::run(PatternShow& show) {
    const Latch latch = [this] { return trackers_.latch(clock_()); };
    Pacer pacer(config_.rendering.frame_rate_limit);
    trackers_.begin();
    for (bool running = true; running && !show.should_close();) {
        const InputState input = poll(new_events(show.outputs().windows()));
        const Commands commands = show.commands_from(input);
        show.frame(input, commands, latch);
        running = goes_on(commands, input);
        if (!waited_)
            pacer.wait();
        waited_ = running && may_wait(show.frames(), show.outputs().headset()) &&
                  wait(outlook(input), show.outputs().windows());
    }
}

void LiveLoop::finish(const Session& session) {
    if (movies_) {
        movies_->finish();
        last_words_ = movies_->messages();
    }
    if (surfaces_) {
        const auto words = surfaces_->finish();
        last_words_.insert(last_words_.end(), words.begin(), words.end());
    }
    recording_.finish();
    if (keeper_)
        keeper_->finish(session.state(), emulation_.standing(), session.left_arrays());
}

std::vector<std::string> LiveLoop::status() const {
    std::vector<std::string> lines = trackers_.status();
    const std::vector<std::string> headset = headset_.status();
    lines.insert(lines.end(), headset.begin(), headset.end());
    lines.insert(lines.end(), last_words_.begin(), last_words_.end());
    return lines;
}

} // namespace isochron::app
