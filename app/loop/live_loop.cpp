// The live loop, from devices to frames.
#include "app/loop/live_loop.h"

#include "app/end_in_time.h"
#include "app/frame/pacer.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <iterator>
#include <ranges>

namespace isochron::app {

using interaction::Commands;
using interaction::InputState;
using interaction::Seconds;

namespace {

/// Whether the user did something. What a gamepad's sticks do is seen in the devices; at rest they
/// tremble.
bool acts(const std::vector<interaction::WindowEvent>& events) {
    return std::ranges::any_of(events, [](const interaction::WindowEvent& event) {
        return !std::holds_alternative<interaction::GamepadEvent>(event);
    });
}

/// Gives the clipboard what the user points at, or has chosen in the panel; else the link.
/// @param asks the user wants what they point at
void give_to_desktop(Session& session, bool asks, const std::function<std::string()>& link) {
    const DesktopWish wish = session.panel().take_desktop_wish();
    if (!wish.folder.empty())
        open_folder(wish.folder);
    std::string words = wish.text.empty() && asks ? session.pointed() : wish.text;
    if (words.empty() && asks && link)
        words = link();
    if (!words.empty())
        session.outputs().windows().first().set_clipboard(words);
    const auto lines = std::ranges::count(words, '\n');
    if (asks || !words.empty())
        session.show_messages({words.empty() ? "nothing to copy: point at a surface or mark a place"
                               : lines > 2   ? fmt::format("copied: {} lines", lines)
                                             : "copied: " + words});
}

} // namespace

LiveLoop::LiveLoop(const Config& config, interaction::CompositeInput trackers,
                   const LiveOptions& options, stereo::Headset* headset)
    : config_(config), options_(options), trackers_(std::move(trackers)),
      emulation_(emulation_for(config)), camera_(config.installation), headset_(headset),
      opening_(options.why_not_open),
      clock_(options.clock ? options.clock : [start = std::chrono::steady_clock::now()] {
          return Seconds(std::chrono::steady_clock::now() - start);
      }) {}

void LiveLoop::join(CompanionPlace place, std::shared_ptr<Companion> companion) {
    companion->set_wake(waker());
    companions_[place] = std::move(companion);
}

/// Why other data are not to be opened now, as a companion's work would be lost; empty: they can be.
std::string LiveLoop::unfinished() const {
    for (const auto& [place, companion] : companions_)
        if (std::string why = companion->why_stay(); !why.empty())
            return why;
    return {};
}

/// The devices of a frame that begins now.
InputState LiveLoop::poll(std::span<const interaction::WindowEvent> events) {
    if (options_.emulated)
        emulation_.feed(camera_.feed(events));
    else
        emulation_.feed(events);
    headset_.begin_frame(clock_());
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
    const bool loses = session.history().has_changes() || !unfinished().empty();
    if (!windows.should_close() || !loses || session.state().leaving)
        return true;
    windows.keep_open();
    asked.leaving = true;
    return false;
}

/// Whether nothing but windows, mouse and keyboard can bring something new.
bool LiveLoop::may_wait(const FrameSharing& frames, const stereo::Headset* headset) const {
    return frames.alone() && !headset && trackers_.empty();
}

/// The windows' events since the last frame. The first frame after a wait gets none: it ends the
/// time without events, so that a new event begins a moment before the frame that gets it, and not
/// when the wait began.
std::vector<interaction::WindowEvent> LiveLoop::new_events(const stereo::Windows& windows) {
    if (waited_)
        return {};
    const DrawsOnly waits; // maybe for the display
    return options_.behind_early(windows.poll_events());
}

/// What the devices, and the work in the background, tell about the next frame.
FrameOutlook LiveLoop::outlook(const InputState& input, bool acted) const {
    constexpr Seconds kLookForProgress{0.25};
    FrameOutlook next{.busy = is_held(input), .changed = acted, .final = true};
    for (const auto& [place, companion] : companions_)
        next = both(next, companion->outlook(input.time));
    const auto look = [&](Seconds at) { next.until = std::min(next.until, at); };
    if (options_.length)
        look(*options_.length);
    if (opening_.busy())
        look(input.time + Companion::kLookForWords);
    if (!options_.standing().empty())
        look(input.time + kLookForProgress);
    return next;
}

/// Waits until something happens, if nothing does. @return whether it has waited
bool LiveLoop::wait(const FrameOutlook& next, const stereo::Windows& windows) {
    // Events that ended the last wait are still there, and get their frame first.
    const auto longest = idle_.after(next, clock_());
    if (!longest || waited_)
        return false;
    for (const auto& [place, companion] : companions_)
        companion->rest();
    const Seconds end = clock_() + *longest;
    const DrawsOnly waits;
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
        const auto happened = new_events(session.outputs().windows());
        auto events = session.panel_events(happened);
        opening_.cancel_on_escape(session, events);
        if (interaction::is_pressed(interaction::Key::f11, events))
            session.outputs().windows().first().toggle_fullscreen();
        if (config_.devices.empty() &&
            !session.outputs().headset()) // a tracked wand points instead
            emulation_.set_panel(session.state().room_panel, session.room_panel_size());
        const InputState input = poll(events);
        session.set_headset_period(headset_.period());
        Commands commands = session.commands_from(input);
        Commands from_panel = session.take_panel_commands();
        interaction::merge(commands, from_panel);
        for (const auto& [place, companion] : companions_)
            companion->before_frame(session, commands, asked);
        interaction::merge(from_panel, asked);
        interaction::merge(commands, asked);
        headset_.feel(commands.haptics);
        const FrameReport& drawn = session.frame(input, commands, Waiting::never, latch);
        const LiveFrame frame{input, commands, from_panel, drawn, emulation_.standing()};
        for (const auto& [place, companion] : companions_) {
            companion->after_frame(session, frame);
            session.show_messages(companion->messages());
        }
        give_to_desktop(session, commands.copy, options_.link);
        if (commands.save && !companions_.contains(CompanionPlace::keeper))
            session.show_messages({options_.not_kept});
        session.set_standing(opening_.busy() ? opening_.note() : options_.standing());
        const std::string why_stay = unfinished();
        opening_.update(session, why_stay.empty() ? options_.stays : why_stay);
        running = goes_on(commands, input) && !next_data();
        if (!headset_.period() && !waited_)
            pacer.wait();
        const FrameOutlook next = both(session.outlook(), outlook(input, acts(happened)));
        const bool prepared = !next.busy && !next.changed && session.prepare_some();
        waited_ = running && !prepared && may_wait(session.frames(), session.outputs().headset()) &&
                  wait(next, session.outputs().windows());
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
        const auto events = new_events(show.outputs().windows());
        const InputState input = poll(events);
        const Commands commands = show.commands_from(input);
        show.frame(input, commands, latch);
        running = goes_on(commands, input);
        if (!waited_)
            pacer.wait();
        waited_ = running && may_wait(show.frames(), show.outputs().headset()) &&
                  wait(outlook(input, acts(events)), show.outputs().windows());
    }
}

std::vector<std::string> LiveLoop::finish(const Session& session) {
    std::vector<std::string> words;
    for (const auto& [place, companion] : companions_ | std::views::reverse)
        std::ranges::move(companion->finish(session), std::back_inserter(words));
    return words;
}

void LiveLoop::save(const Session& session) const {
    for (const auto& [place, companion] : companions_ | std::views::reverse)
        companion->save(session);
}

std::vector<std::string> LiveLoop::status() const {
    std::vector<std::string> lines = trackers_.status();
    const std::vector<std::string> headset = headset_.status();
    lines.insert(lines.end(), headset.begin(), headset.end());
    return lines;
}

} // namespace isochron::app
