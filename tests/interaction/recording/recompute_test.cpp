// A whole session through emulation and controls: every command can be recomputed from its
// recording.
#include "interaction/controls/controls.h"
#include "interaction/controls/desktop_emulation.h"
#include "interaction/controls/motion_gate.h"

#include "tests/interaction/input_builders.h"
#include "tests/interaction/obeyed.h"
#include "tests/interaction/recording/recording_in.h"
#include "tests/support/paths.h"
#include "tests/support/test_folder.h"
#include "tests/support/test_seed.h"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>

namespace isochron::interaction {
namespace {

/// The settings and what surrounds them: the least of a session.
class SimulatedSession {
  public:
    SimulatedSession() { settings_.room_from_physical = context_.series.home; }
    const ControlContext& context() const { return context_; }
    const Settings& settings() const { return settings_; }
    void obey(const Commands& commands) { interaction::obey(commands, settings_); }

  private:
    const std::vector<double> times_{0, 0.1, 0.5, 0.6, 2, 2.5, 2.6, 7};
    const std::vector<std::string> modes_{"mono", "left", "side_by_side"};
    Settings settings_;
    const ControlContext context_{
        .settings = settings_,
        .series = {.low = -1e-3,
                   .high = 17.3,
                   .times = &times_,
                   .home = {{0, 1.3, -1.5}, glm::dquat(1, 0, 0, 0), 0.03}},
        .stereo_modes = &modes_};
};

std::vector<WindowEvent> random_events(Random& random) {
    std::vector<WindowEvent> events;
    for (unsigned i = random() % 5; i > 0; --i) {
        const auto fraction = [&] { return static_cast<float>(uniform(random, 0, 1)); };
        switch (random() % 8) {
        case 0:
        case 1:
        case 2: {
            const auto keys = key_bindings();
            events.push_back(KeyEvent{keys[random() % keys.size()].key, random() % 2 == 0});
            break;
        }
        case 3:
            events.push_back(
                MouseButtonEvent{static_cast<MouseButton>(random() % 3), random() % 2 == 0});
            break;
        case 4: events.push_back(cursor_at(fraction(), fraction())); break;
        case 5: events.push_back(ScrollEvent{0, fraction() - 0.5f}); break;
        case 6:
            if (random() % 8 == 0)
                events.push_back(FocusEvent{false});
            break;
        default:
            events.push_back(GamepadEvent{
                random() % 4 != 0,
                {fraction(), fraction(), fraction(), fraction(), fraction(), fraction()},
                static_cast<std::uint32_t>(random() & random())});
        }
    }
    return events;
}

TEST(Recompute, DevicesExplainEveryCommandThatThePanelDoesNot) {
    const test_support::TestFolder folder;
    const std::filesystem::path path = folder.path() / "recompute.jsonl";
    Random random(test_seed());
    for (int session_number = 0; session_number < tries(10); ++session_number) {
        SCOPED_TRACE(testing::Message() << "session " << session_number);
        std::vector<Pace> paces;
        std::size_t navigated = 0, stepped = 0;
        {
            SimulatedSession session;
            DesktopEmulation emulation{EmulationOptions{}};
            Controls controls;
            MotionGate gate{StillnessLimits{}};
            RecordingWriter writer(path, {});
            double now = 0;
            for (int frame = 0; frame < 1000; ++frame) {
                emulation.feed(random_events(random));
                RecordedFrame record;
                record.input = emulation.poll(Seconds(now));
                record.commands = controls.update(record.input, session.context());
                if (random() % 20 == 0)
                    record.from_panel.isovalue = uniform(random, 0, 17);
                if (random() % 50 == 0)
                    record.from_panel.instant = Instant(random() % 8);
                merge(record.commands, record.from_panel);
                session.obey(record.commands);
                paces.push_back(
                    gate.update(record.input, record.commands, session.settings().quality));
                navigated += record.commands.room_from_physical.has_value();
                stepped += record.commands.instant.has_value();
                writer.append(record);
                now += uniform(random, 0.001, 0.06);
            }
            writer.finish();
        }
        EXPECT_GT(navigated, 100u);
        EXPECT_GT(stepped, 20u);

        const Recording recording = recording_in(path);
        ASSERT_EQ(recording.frames.size(), 1000u);
        SimulatedSession session;
        Controls controls;
        MotionGate gate{StillnessLimits{}};
        ReplayInput replay(recording);
        for (std::size_t frame = 0; frame < recording.frames.size(); ++frame) {
            const RecordedFrame& record = recording.frames[frame];
            const InputState input = replay.poll(record.input.time);
            Commands commands = controls.update(input, session.context());
            merge(commands, record.from_panel);
            ASSERT_EQ(commands, record.commands) << "frame " << frame;
            session.obey(commands);
            ASSERT_EQ(gate.update(input, commands, session.settings().quality), paces[frame]);
        }
        EXPECT_TRUE(replay.finished());
    }
}

/// Every key was pressed for it, by a program that wrote version 1; its footprints are the paces.
TEST(Recompute, ARecordingOfVersion1LeadsToTheCommandsThatItHolds) {
    const Recording recording = recording_in(test_support::test_data() + "/old/version1.jsonl");
    const std::vector<double> times{0, 0.1, 0.5, 0.6, 2, 2.5, 2.6, 7};
    const std::vector<std::string> modes{"mono", "left", "side_by_side"}, arrays{"u", "w"};
    Settings settings;
    Commands start, undo, redo, next;
    start.isovalue = 3;
    undo.undo = true;
    redo.redo = true;
    next.array = "u";
    const ControlContext context{
        .settings = settings,
        .series = {.low = -1e-3,
                   .high = 17.3,
                   .times = &times,
                   .home = {{0, 1.3, -1.5}, glm::dquat(1, 0, 0, 0), 0.03}},
        .color_arrays = {.names = &arrays},
        .ways = {.next_array = &next, .start = &start, .undo = &undo, .redo = &redo},
        .stereo_modes = &modes,
        .data = {glm::dmat4(60, 0, 0, 0, 0, 50, 0, 0, 0, 0, 60, 0, 0, 0, 0, 1), "mm"}};
    obey(recording.header.start, settings);
    Controls controls;
    MotionGate gate{StillnessLimits{}};
    ActionSet seen;
    for (std::size_t i = 0; i < recording.frames.size(); ++i) {
        const RecordedFrame& frame = recording.frames[i];
        const Commands commands = controls.update(frame.input, context);
        ASSERT_EQ(commands, frame.commands) << "frame " << i;
        obey(commands, settings);
        EXPECT_EQ(name_of(gate.update(frame.input, commands, settings.quality)), frame.footprint)
            << "frame " << i;
        seen |= frame.input.find("keys")->actions;
    }
    EXPECT_EQ(seen.count(), 81u) << "all that version 1 had";
}

} // namespace
} // namespace isochron::interaction
