// Makes configs/demo.jsonl: a visitor's hands, acted out on a fixed clock through the real
// controls.
//
//     build/release/tests/demo_recording build/demo/vorticity.isochron configs/demo.jsonl
#include "app/session/session.h"
#include "app/version.h"
#include "interaction/recording/recording.h"

#include <cstdio>
#include <functional>

namespace isochron::app {
namespace {

using namespace interaction;

constexpr double kFramesPerSecond = 30.0;
constexpr double kIsovalue = 15.5; ///< some 4,000 active cells of the vorticity series

/// The events of one frame, and a stamp where a picture is wanted.
struct Act {
    std::vector<WindowEvent> events;
    std::string stamp;
};

/// Moves the mouse along a line while a button is held: `at` goes from 0 to 1.
MouseMoveEvent drag(float x, float y, float dx, float dy, float at) {
    return {x + dx * at, y + dy * at, 1280, 720};
}

/// Six seconds: rest, play while turning the volume, walk into it, rest.
Act act(int frame) {
    Act now;
    const auto during = [&](int first, int last, const std::function<void(float)>& move) {
        if (frame >= first && frame <= last)
            move(static_cast<float>(frame - first) / static_cast<float>(last - first));
    };
    const auto key = [&](Key which, int press, int release) {
        if (frame == press)
            now.events.push_back(KeyEvent{which, true});
        if (frame == release)
            now.events.push_back(KeyEvent{which, false});
    };
    const auto button = [&](MouseButton which, int press, int release) {
        if (frame == press)
            now.events.push_back(MouseButtonEvent{which, true});
        if (frame == release)
            now.events.push_back(MouseButtonEvent{which, false});
    };
    if (frame == 0)
        now.events.push_back(MouseMoveEvent{0.75f, 0.70f, 1280, 720});
    if (frame == 12)
        now.stamp = "settled";
    key(Key::space, 15, 16);
    button(MouseButton::left, 20, 66);
    during(21, 65, [&](float at) { now.events.push_back(drag(0.75f, 0.70f, -0.30f, -0.10f, at)); });
    if (frame == 50)
        now.stamp = "moving";
    key(Key::space, 72, 73);
    key(Key{'W'}, 80, 122);
    if (frame == 110)
        now.stamp = "walking_in";
    key(Key::up, 128, 129);
    key(Key::up, 132, 133);
    if (frame == 160)
        now.stamp = "settled_close";
    return now;
}

void make(const std::string& data, const std::string& out) {
    constexpr int kFrames = 170;
    const Config config = read_config("headless");
    const auto file = index::IndexFile::open(data);
    const auto context = stereo::make_context(stereo::ContextKind::egl, {.size = {64, 32}});
    Session session(config, file, *context);
    ExplorerState start = session.state();
    start.set_isovalue(kIsovalue);
    start.instant = index::Instant(10);
    session.set_state(start);

    RecordingHeader header;
    header.program = kProgram;
    header.configuration = config.text;
    header.data = "vorticity.isochron"; // and no hash: it plays on any series of as many steps
    header.start = start.as_commands();
    RecordingWriter writer(out, header);
    DesktopEmulation emulation(emulation_for(config));
    for (int frame = 0; frame < kFrames; ++frame) {
        const Act now = act(frame);
        emulation.feed(now.events);
        RecordedFrame recorded;
        recorded.input = emulation.poll(Seconds(frame / kFramesPerSecond));
        recorded.commands = session.commands_from(recorded.input);
        if (!now.stamp.empty())
            recorded.from_panel.stamps.push_back(now.stamp);
        merge(recorded.commands, recorded.from_panel);
        session.frame(recorded.input, recorded.commands, Waiting::never);
        writer.append(recorded);
    }
    writer.finish();
}

} // namespace
} // namespace isochron::app

int main(int argc, char** argv) {
    if (argc != 3) {
        std::fprintf(stderr, "usage: demo_recording INDEX OUT.jsonl\n");
        return 2;
    }
    try {
        isochron::app::make(argv[1], argv[2]);
    } catch (const std::exception& error) {
        std::fprintf(stderr, "demo_recording: %s\n", error.what());
        return 1;
    }
    return 0;
}
