// From devices to frames, live.
#include "app/session/live_loop.h"

#include "app/frame/pacer.h"

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
      clock_([start = std::chrono::steady_clock::now()] {
          return Seconds(std::chrono::steady_clock::now() - start);
      }) {}

std::function<Seconds()> LiveLoop::clock() const {
    return clock_;
}

void LiveLoop::record(const std::filesystem::path& path,
                      const interaction::RecordingHeader& header) {
    recorder_ = std::make_shared<interaction::RecordingWriter>(path, header);
}

/// The devices of a frame that begins now.
InputState LiveLoop::poll(std::span<const interaction::WindowEvent> events) {
    if (options_.emulated)
        emulation_.feed(camera_.feed(events));
    else
        emulation_.feed(events);
    paced_ = headset_.begin_frame(clock_());
    const Seconds now = clock_();
    InputState input = interaction::merged(trackers_.poll(now), emulation_.poll(now));
    if (options_.emulated)
        input.devices.push_back({.name = kRoomCamera, .pose = camera_.pose(), .valuators = {}});
    return headset_.with_devices(std::move(input), now);
}

bool LiveLoop::goes_on(const Commands& commands, const InputState& input) const {
    return !commands.quit && !headset_.ended() &&
           !(options_.length && input.time >= *options_.length);
}

void LiveLoop::record(interaction::RecordedFrame frame) {
    recording_.post([recorder = recorder_, frame = std::move(frame)] {
        recorder->append(frame);
        return std::string();
    });
}

void LiveLoop::run(Session& session) {
    const Latch latch = [this] { return trackers_.latch(clock_()); };
    Pacer pacer(config_.frame_rate_limit);
    for (bool running = true; running && !session.should_close();) {
        const auto events = session.panel_events(session.outputs().windows().poll_events());
        if (config_.devices.empty() && !session.outputs().headset()) // a tracked wand points itself
            emulation_.set_panel(session.state().room_panel, session.room_panel_size());
        const InputState input = poll(events);
        Commands commands = session.commands_from(input);
        const Commands from_panel = session.take_panel_commands();
        interaction::merge(commands, from_panel);
        headset_.feel(commands.haptics);
        const FrameReport& drawn = session.frame(input, commands, Waiting::never, latch);
        if (recorder_)
            record({input, commands, from_panel, name_of(drawn.footprint), session.latched()});
        session.show_messages(recording_.messages());
        running = goes_on(commands, input);
        if (!paced_)
            pacer.wait();
    }
    headset_.leave();
}

void LiveLoop::run(PatternShow& show) {
    const Latch latch = [this] { return trackers_.latch(clock_()); };
    Pacer pacer(config_.frame_rate_limit);
    for (bool running = true; running && !show.outputs().windows().should_close();) {
        const InputState input = poll(show.outputs().windows().poll_events());
        const Commands commands = show.commands_from(input);
        show.obey(commands);
        show.frame(input, latch);
        running = goes_on(commands, input);
        pacer.wait();
    }
}

void LiveLoop::finish() {
    recording_.finish();
    if (recorder_)
        recorder_->finish();
}

std::vector<std::string> LiveLoop::status() const {
    std::vector<std::string> lines = trackers_.status();
    const std::vector<std::string> headset = headset_.status();
    lines.insert(lines.end(), headset.begin(), headset.end());
    return lines;
}

} // namespace isochron::app
