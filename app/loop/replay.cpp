// Replays a recording.
#include "app/loop/replay.h"

#include "app/frame/pacer.h"
#include "index/error.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <chrono>
#include <utility>

namespace isochron::app {
namespace {

using interaction::Commands;

/// The commands of a frame that a replay obeys: not those for settings that the options override.
Commands obeyed(Commands commands, const ReplayOptions& options) {
    if (options.stereo)
        commands.stereo.reset();
    if (options.quality)
        commands.quality.reset();
    commands.screenshot = false;
    return commands;
}

/// A latch with the recorded heads; empty if none were recorded.
Latch latch_of(const interaction::RecordedFrame& frame) {
    if (frame.latched.devices.empty())
        return {};
    return [&frame] { return frame.latched; };
}

/// Before the first picture is made.
void expect_arrays(const Session& session, const interaction::Recording& recording) {
    for (const interaction::RecordedFrame& frame : recording.frames)
        if (frame.commands.array)
            session.expect_array(*frame.commands.array);
}

} // namespace

ExplorerState start_of(const interaction::RecordingHeader& header, const ExplorerState& fallback,
                       std::size_t steps, const ReplayOptions& options) {
    ExplorerState state = fallback;
    const auto refused = state.refusals(header.start, steps);
    if (!refused.empty() && !options.any_data)
        throw interaction::Error(
            "the recording's start state does not fit the data: {} (--any-data goes on without)",
            fmt::join(refused, "; "));
    state.resume(header.start, steps);
    if (options.stereo)
        state.set_stereo(*options.stereo);
    state.quality = options.quality.value_or(state.quality);
    return state;
}

void expect_cells(const Session& session) {
    if (const std::string failure = session.failure(); !failure.empty())
        throw index::Error(failure);
}

std::vector<std::string> replay_fixed_step(Session& session,
                                           const interaction::Recording& recording,
                                           const ReplayOptions& options, const FrameDone& done,
                                           const Skips& skips) {
    std::vector<std::string> different;
    expect_arrays(session, recording);
    Commands waiting; // commands of skipped frames
    bool waits = false;
    for (std::size_t number = 0; number < recording.frames.size(); ++number) {
        const interaction::RecordedFrame& frame = recording.frames[number];
        if (options.from_devices) {
            Commands recomputed = session.commands_from(frame.input);
            interaction::merge(recomputed, frame.from_panel);
            const auto fields = interaction::differences(frame.commands, recomputed);
            if (!fields.empty())
                different.push_back(fmt::format("frame {} at {:.3f} s: {}", number,
                                                frame.input.time.count(), fmt::join(fields, ", ")));
        }
        Commands commands = obeyed(frame.commands, options);
        if (skips && skips(number)) {
            interaction::merge(waiting, commands);
            waits = true;
        } else {
            if (std::exchange(waits, false)) {
                interaction::merge(waiting, commands);
                commands = std::exchange(waiting, {});
            }
            session.frame(frame.input, commands, Waiting::for_cells, latch_of(frame));
            expect_cells(session);
        }
        done(number, frame);
    }
    return different;
}

void replay_pattern(PatternShow& show, const interaction::Recording& recording,
                    const ReplayOptions& options, const FrameDone& done) {
    for (std::size_t number = 0; number < recording.frames.size(); ++number) {
        const interaction::RecordedFrame& frame = recording.frames[number];
        show.frame(frame.input, obeyed(frame.commands, options), latch_of(frame));
        done(number, frame);
    }
}

void replay_live(Session& session, const interaction::Recording& recording,
                 const ReplayOptions& options, double frame_rate_limit, SessionControl* control) {
    const auto& frames = recording.frames;
    expect_arrays(session, recording);
    session.warm_up();
    const auto clock = [start = std::chrono::steady_clock::now(), &frames] {
        return std::chrono::steady_clock::now() - start + frames.front().input.time;
    };
    session.set_clock(clock);
    Pacer pacer(frame_rate_limit);
    interaction::ReplayInput devices(recording);
    while (!devices.finished() && !session.should_close()) {
        session.outputs().windows().poll_events();
        const interaction::Seconds now = clock();
        Commands commands;
        std::size_t next = devices.frames_played();
        interaction::InputState input = devices.poll(now);
        for (; next < devices.frames_played(); ++next)
            interaction::merge(commands, obeyed(frames[next].commands, options));
        input.time = now;
        const FrameReport& shown = session.frame(input, commands, Waiting::never, [&] {
            return interaction::InputState{clock(), frames[next - 1].latched.devices};
        });
        if (control)
            control->tell(session, shown);
        pacer.wait();
    }
}

} // namespace isochron::app
