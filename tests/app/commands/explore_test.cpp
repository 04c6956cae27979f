// The whole program in a window: a user presses keys, leaves, and the recording tells and replays
// it.
#include "tests/app/commands/explore_fixture.h"
#include "tests/app/explore/small_cave.h"
#include "tests/support/eventually.h"

#include "app/config/shipped_configs.h"
#include "app/explore/explore_start.h"
#include "app/kept/recording_file.h"
#include "index/file/index_file.h"
#include "stereo/image_file.h"

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <algorithm>
#include <chrono>
#include <csignal>

namespace isochron::app {
namespace {

template <class Claim>
bool any_frame(const interaction::Recording& recording, Claim claim) {
    return std::any_of(recording.frames.begin(), recording.frames.end(),
                       [&](const auto& frame) { return claim(frame.commands); });
}

TEST_F(ExploreTest, MakesAnIndexOfFilesOfValuesAndKeepsIt) {
    std::string ramp;
    for (char i = 0; i < 64; ++i)
        ramp += i;
    folder_.write("ramp.raw", ramp);
    for (const char* recording : {"first.jsonl", "second.jsonl"}) {
        // The name alone stands for `explore`.
        ASSERT_EQ(Program({file("ramp.raw"), "--dims", "4", "4", "4", "--type", "u8", "--size",
                           "320", "240", "--seconds", "0.2", "--record", file(recording)})
                      .exit_status(),
                  0);
        const std::filesystem::path kept = read_recording(file(recording)).header.data;
        EXPECT_EQ(kept.parent_path(), state_.path() / "isochron");
        EXPECT_EQ(index::IndexFile::open(kept)->stats().high, 63);
    }
    const std::filesystem::directory_iterator kept(state_.path() / "isochron");
    EXPECT_EQ(
        std::count_if(begin(kept), end(kept),
                      [](const auto& entry) { return entry.path().extension() == ".isochron"; }),
        1);
}

TEST(ExploreStart, AStepThatIsAskedForIsNotBetweenStepsWhereTheSessionWas) {
    ExplorerState resumed;
    resumed.between = interaction::BetweenSteps::blend;
    resumed.instant = {3, 30'000};
    ExploreOptions options;
    EXPECT_EQ(start_from(resumed, options, 10).shown_instant(), resumed.instant);
    options.step = 5;
    EXPECT_EQ(start_from(resumed, options, 10).shown_instant(), index::Instant(5));
}

TEST_F(ExploreTest, OfSeveralArraysItShowsOneAndHasTheOthers) {
    std::string text = "# vtk DataFile Version 3.0\ntwo\nASCII\nDATASET STRUCTURED_POINTS\n"
                       "DIMENSIONS 4 4 4\nORIGIN 0 0 0\nSPACING 1 1 1\nPOINT_DATA 64\n";
    for (const char* array : {"rho", "heat"}) {
        text += fmt::format("SCALARS {} float 1\nLOOKUP_TABLE default\n", array);
        for (int i = 0; i < 64; ++i)
            text += fmt::format("{}\n", i);
    }
    folder_.write("two.vtk", text);
    ASSERT_EQ(Program({"explore", file("two.vtk"), "--size", "320", "240", "--seconds", "0.2",
                       "--record", file("walk.jsonl")})
                  .exit_status(),
              0);
    EXPECT_EQ(index::IndexFile::open(read_recording(file("walk.jsonl")).header.data)->arrays(), 2u);
}

TEST_F(ExploreTest, KeysLeadToCommandsThatTheRecordingHoldsAndReplays) {
    const auto program = explore({"--record", file("walk.jsonl"), "--isovalue", "8", "--no-panel"});
    screen_.xdotool({"key", "space", "Up", "Up", "2", "v", "m"});
    screen_.xdotool(as_words("mousedown 1 mousemove_relative 40 10 mouseup 1"));
    leave();
    ASSERT_EQ(program->exit_status(), 0);

    const auto recording = read_recording(file("walk.jsonl"));
    EXPECT_TRUE(
        any_frame(recording, [](const auto& c) { return c.playback && c.playback->playing; }));
    EXPECT_TRUE(any_frame(recording, [](const auto& c) { return c.isovalue && *c.isovalue > 8; }));
    EXPECT_TRUE(any_frame(
        recording, [](const auto& c) { return c.quality == interaction::QualityMode::fast; }));
    EXPECT_TRUE(any_frame(recording, [](const auto& c) { return c.stereo == "left"; }));
    EXPECT_TRUE(
        any_frame(recording, [](const auto& c) { return c.room_from_physical.has_value(); }));
    EXPECT_TRUE(any_frame(recording, [](const auto& c) { return !c.stamps.empty(); }));
    EXPECT_TRUE(any_frame(recording, [](const auto& c) { return c.quit; }));

    for (const char* folder : {"first", "second"})
        ASSERT_EQ(Program({"replay", file("walk.jsonl"), "--from-devices", "--stamps", "--out",
                           file(folder), "--report", file("timing.json")})
                      .exit_status(),
                  0);
    int pictures = 0;
    for (const auto& entry : std::filesystem::directory_iterator(file("first"))) {
        const auto again = std::filesystem::path(file("second")) / entry.path().filename();
        EXPECT_EQ(stereo::read_image(entry.path()).rgba, stereo::read_image(again).rgba);
        ++pictures;
    }
    EXPECT_EQ(pictures, 1);

    // In a window it takes the time that it took.
    const auto start = std::chrono::steady_clock::now();
    ASSERT_EQ(Program({"replay", file("walk.jsonl"), "--live", "--report", file("live.json")})
                  .exit_status(),
              0);
    EXPECT_GE(std::chrono::steady_clock::now() - start,
              recording.frames.back().input.time - recording.frames.front().input.time);
    EXPECT_NE(folder_.read("live.json").find("\"frames\""), std::string::npos);
}

TEST_F(ExploreTest, EndedByASignalItLeavesAWholeRecordingUnderItsName) {
    for (const int number : {SIGTERM, SIGINT}) {
        const auto program = explore({"--record", file("walk.jsonl")});
        screen_.xdotool({"key", "2"});
        ASSERT_TRUE(comes("walk.jsonl.part", "\"fast\""));
        program->signal(number);
        EXPECT_EQ(program->exit_status(), 128 + number);
        EXPECT_FALSE(read_recording(file("walk.jsonl")).frames.empty());
        EXPECT_EQ(folder_.names(), (std::vector<std::string>{"sphere.isochron", "walk.jsonl"}));
        std::filesystem::remove(file("walk.jsonl"));
        std::filesystem::remove_all(state_.path() / "isochron"); // else it asks whether to go on
    }
}

TEST_F(ExploreTest, PressingOnTheHistogramPicksAnIsovalue) {
    const auto program = explore({"--record", file("walk.jsonl"), "--isovalue", "8"});
    ASSERT_TRUE(test_support::eventually([&] { return screen_.pixel(600, 4)[0] > 30; }))
        << "the panel's bar";
    // In so small a window the section opens over the picture, where it was dark.
    screen_.xdotool({"mousemove_relative", "--", "-180", "-83"});
    await_frame();
    screen_.xdotool({"click", "1"});
    ASSERT_TRUE(test_support::eventually([&] { return screen_.pixel(130, 180)[1] > 80; }));
    screen_.xdotool({"mousemove_relative", "--", "130", "45"});
    // The click is faster than a frame: the panel sees it all the same.
    screen_.xdotool({"click", "1"});
    ASSERT_TRUE(comes("walk.jsonl.part", "\"panel\":{\"isovalue\""));
    leave();
    ASSERT_EQ(program->exit_status(), 0);
    const auto recording = read_recording(file("walk.jsonl"));
    EXPECT_TRUE(
        std::any_of(recording.frames.begin(), recording.frames.end(),
                    [](const auto& frame) { return frame.from_panel.isovalue.has_value(); }));
    EXPECT_FALSE(
        any_frame(recording, [](const auto& c) { return c.room_from_physical.has_value(); }));
}

TEST_F(ExploreTest, FromTheConsoleAnOperatorSteersWithThePanelAndKeys) {
    folder_.write("lab.toml", *shipped_config("desktop") +
                                  "\n[console]\nsize = [400, 700]\nposition = [800, 100]\n");
    const auto program =
        explore({"--config", file("lab.toml"), "--record", file("walk.jsonl"), "--isovalue", "8"});
    screen_.xdotool(as_words("search --sync --onlyvisible --name console"));
    // The middle of the histogram, below the bar and the data.
    screen_.xdotool({"mousemove", "1000", "421"});
    // What is drawn need not be on the screen at once.
    ASSERT_TRUE(test_support::eventually([&] {
        const auto bar = screen_.pixel(1116, 103);
        return bar[0] > 30 && bar[0] < 42 && bar[2] > bar[0] + 4;
    })) << "the panel fills the window";
    screen_.xdotool({"click", "1"});
    ASSERT_TRUE(comes("walk.jsonl.part", "\"panel\":{\"isovalue\""));
    screen_.xdotool({"search", "--name", "console", "windowfocus"});
    leave();
    ASSERT_EQ(program->exit_status(), 0);
    const auto recording = read_recording(file("walk.jsonl"));
    EXPECT_FALSE(any_frame(recording, [](const auto& c) {
        return c.room_from_physical.has_value();
    })) << "clicks are the console's alone";
}

TEST_F(ExploreTest, ClosingTheWindowKeepsTheRecording) {
    const auto program = explore({"--record", file("walk.jsonl")});
    screen_.close_window("Isochron: " + file("sphere.isochron"));
    EXPECT_EQ(program->exit_status(), 0);
    EXPECT_FALSE(read_recording(file("walk.jsonl")).frames.empty());
}

TEST_F(ExploreTest, TheScreenshotKeyWritesASettledPictureWithoutThePanel) {
    // The folder is made.
    const auto program = explore({"--screenshots", file("pictures/new"), "--isovalue", "8"});
    screen_.xdotool({"key", "p"});
    const auto picture = folder_.path() / "pictures/new/isochron_0001.png";
    ASSERT_TRUE(test_support::eventually([&] { return std::filesystem::exists(picture); }));
    leave();
    EXPECT_EQ(program->exit_status(), 0);
    const render::Image image = stereo::read_image(picture);
    // What bars of tools and time and the folded column leave free.
    EXPECT_EQ(image.width, 600);
    EXPECT_EQ(image.height, 392);
    // The panel would be in a corner.
    EXPECT_EQ(0, std::memcmp(image.at(2, 2), image.at(597, 389), 3));
    EXPECT_EQ(
        Program({"reproduce", picture.string(), "--data", file("sphere.isochron")}).exit_status(),
        0);
}

TEST_F(ExploreTest, AnEmulatedCaveTurnsWhileItsKeyIsHeldAndTheRecordingHoldsTheCamera) {
    folder_.write("cave.toml", cave_of("192, 120"));
    const auto program = explore(
        {"--config", file("cave.toml"), "--emulate", "--record", file("walk.jsonl"), "--no-panel"});
    screen_.xdotool({"keydown", "c", "mousedown", "1"});
    screen_.xdotool({"mousemove_relative", "60", "20"});
    screen_.xdotool({"mouseup", "1", "keyup", "c", "key", "m"});
    ASSERT_TRUE(comes("walk.jsonl.part", "stamp-1"));
    leave();
    ASSERT_EQ(program->exit_status(), 0);
    const auto recording = read_recording(file("walk.jsonl"));
    EXPECT_EQ(recording.header.window, (std::array{0, 0})) << "the walls are as configured";
    const interaction::DeviceState* camera = recording.frames.back().input.find("camera");
    ASSERT_TRUE(camera);
    EXPECT_NE(camera->pose, RoomCamera(read_config(file("cave.toml")).installation).pose());
    EXPECT_FALSE(any_frame(recording, [](const auto& c) {
        return c.room_from_physical.has_value();
    })) << "the drag was the camera's";
    EXPECT_EQ(Program({"replay", file("walk.jsonl"), "--from-devices", "--emulate", "--stamps",
                       "--out", file("room"), "--size", "320", "200"})
                  .exit_status(),
              0);
    EXPECT_EQ(std::distance(std::filesystem::directory_iterator(file("room")), {}), 1);
}

TEST_F(ExploreTest, TheTestPatternNeedsNoDataAndStopsAtTheKey) {
    const Program program(as_words("explore --test-pattern --size 640 480"));
    const std::string title = "Isochron: test pattern";
    screen_.xdotool({"search", "--sync", "--onlyvisible", "--name", title});
    screen_.xdotool({"search", "--name", title, "windowfocus", "mousemove", "--window", "%1", "200",
                     "200", "key", "v", "keydown", "Escape"});
    EXPECT_EQ(program.exit_status(), 0);
    EXPECT_EQ(Program({"explore", "--test-pattern", "--record", file("walk.jsonl")}).exit_status(),
              2);
}

TEST_F(ExploreTest, ARecordingIsReplacedOnlyWithForce) {
    for (const char* name : {"walk.jsonl", "cut.jsonl.part"})
        folder_.write(name, "{}");
    for (const char* name : {"walk.jsonl", "cut.jsonl"})
        EXPECT_EQ(
            Program({"explore", file("sphere.isochron"), "--record", file(name)}).exit_status(), 1)
            << name;
    EXPECT_EQ(folder_.read("walk.jsonl"), "{}");
    EXPECT_EQ(folder_.read("cut.jsonl.part"), "{}");
}

TEST_F(ExploreTest, ASessionEndedByASignalIsKeptAndResumed) {
    const auto program = explore({"--record", file("walk.jsonl"), "--isovalue", "8", "--no-panel"});
    screen_.xdotool({"key", "Up", "Up", "h", "keydown", "w"});
    await_frame();
    screen_.xdotool({"keyup", "w"});
    ASSERT_TRUE(comes("walk.jsonl.part", "\"grid\":true"));
    program->signal(SIGTERM);
    ASSERT_EQ(program->exit_status(), 128 + SIGTERM);
    const auto first = read_recording(file("walk.jsonl"));
    const auto again = explore({"--resume", "--record", file("more.jsonl"), "--no-panel"});
    leave();
    ASSERT_EQ(again->exit_status(), 0);
    const auto more = read_recording(file("more.jsonl"));
    EXPECT_EQ(more.header.start.grid, true);
    EXPECT_GT(*more.header.start.isovalue, 8);
    EXPECT_EQ(more.frames.front().input.find("head")->pose,
              first.frames.back().input.find("head")->pose)
        << "the head stands where it stood";
    EXPECT_EQ(Program({"explore", file("sphere.isochron"), "--resume", "--session",
                       file("none.isochron-session")})
                  .exit_status(),
              1);
}

/// Stops the reader of a program as soon as there is one.
bool stops_its_reader(const Program& program) {
    namespace fs = std::filesystem;
    const fs::path tasks = "/proc/" + std::to_string(program.pid()) + "/task";
    return test_support::eventually([&] {
        std::error_code gone;
        for (const auto& task : fs::directory_iterator(tasks, gone)) {
            std::ifstream children(task.path() / "children");
            for (pid_t child = 0; children >> child;) {
                std::string name;
                std::getline(std::ifstream("/proc/" + std::to_string(child) + "/comm"), name);
                if (name == "isochron-reader") // as much as the system keeps of a name
                    return kill(child, SIGSTOP) == 0;
            }
        }
        return !program.runs();
    });
}

TEST_F(ExploreTest, ASignalEndsItWhileItsReaderHangs) {
    std::string values;
    for (int i = 0; i < 512; ++i)
        values += std::to_string(i % 7) + " ";
    folder_.write("a.vti",
                  "<VTKFile type=\"ImageData\" version=\"0.1\"><ImageData "
                  "WholeExtent=\"0 7 0 7 0 7\" Origin=\"0 0 0\" Spacing=\"1 1 1\"><Piece "
                  "Extent=\"0 7 0 7 0 7\"><PointData><DataArray type=\"Float32\" Name=\"v\" "
                  "format=\"ascii\">" +
                      values + "</DataArray></PointData></Piece></ImageData></VTKFile>");
    for (const int number : {SIGTERM, SIGINT}) {
        const Program program({"explore", file("a.vti")});
        ASSERT_TRUE(stops_its_reader(program));
        screen_.xdotool(as_words("search --sync --onlyvisible --name Isochron"));
        const auto begun = std::chrono::steady_clock::now();
        program.signal(number);
        EXPECT_EQ(program.exit_status(), 128 + number);
        EXPECT_LT(std::chrono::steady_clock::now() - begun, std::chrono::seconds(10))
            << "on a busy machine; a reader may be silent for a minute";
    }
}

TEST_F(ExploreTest, ClosingTheWindowAsksWhereSomethingHasChanged) {
    const auto program = explore({"--record", file("walk.jsonl"), "--no-panel"});
    screen_.xdotool({"key", "h"});
    ASSERT_TRUE(comes("walk.jsonl.part", "\"grid\":true"));
    const std::string title = "Isochron: " + file("sphere.isochron");
    screen_.close_window(title);
    ASSERT_TRUE(comes("walk.jsonl.part", "\"leaving\":true"));
    screen_.xdotool({"key", "Escape"}); // stay
    ASSERT_TRUE(comes("walk.jsonl.part", "\"commands\":{\"leaving\":false"));
    leave();
    EXPECT_EQ(program->exit_status(), 0);
}

TEST_F(ExploreTest, NothingThatIsReadIsEverOverwritten) {
    const auto size = std::filesystem::file_size(file("sphere.isochron"));
    for (const char* option : {"--record", "--report"})
        EXPECT_EQ(Program({"explore", file("sphere.isochron"), option, file("sphere.isochron")})
                      .exit_status(),
                  1);
    folder_.write("notes.txt", "mine");
    EXPECT_EQ(
        Program({"explore", file("sphere.isochron"), "--record", file("notes.txt")}).exit_status(),
        1);
    EXPECT_EQ(folder_.read("notes.txt"), "mine");
    EXPECT_EQ(std::filesystem::file_size(file("sphere.isochron")), size);
    EXPECT_EQ(Program({"explore", file("sphere.isochron"), "--isovalue", "nan"}).exit_status(), 2);
}

TEST_F(ExploreTest, AFolderForPicturesThatCannotBeMadeIsToldAtTheStart) {
    folder_.write("taken", "");
    EXPECT_EQ(Program({"explore", file("sphere.isochron"), "--screenshots", file("taken/here")})
                  .exit_status(),
              1);
}

TEST_F(ExploreTest, ResumesAfterTheDataHaveGrown) {
    for (int step = 0; step < 3; ++step) {
        std::vector<float> values;
        for (int i = 0; i < 6 * 6 * 6; ++i)
            values.push_back(static_cast<float>(i % 36 + step));
        folder_.write(fmt::format("t{}.raw", step), {reinterpret_cast<const char*>(values.data()),
                                                     values.size() * sizeof(float)});
    }
    const auto build = [&](const std::string& files, std::vector<std::string> more) {
        std::vector<std::string> words{
            "build",  file(files), "--dims", "6",  "6",
            "6",      "--type",    "f32",    "-o", file("grown.isochron"),
            "--quiet"};
        words.insert(words.end(), more.begin(), more.end());
        return Program(words).exit_status();
    };
    const auto explored = [&](std::vector<std::string> more) {
        std::vector<std::string> words{
            "explore", file("grown.isochron"), "--size", "160", "120", "--seconds", "0.5"};
        words.insert(words.end(), more.begin(), more.end());
        return Program(words).exit_status();
    };
    ASSERT_EQ(build("t[01].raw", {}), 0);
    ASSERT_EQ(explored({"--resume"}), 1) << "there is none";
    {
        const Program first(
            {"explore", file("grown.isochron"), "--step", "1", "--record", file("first.jsonl")});
        screen_.xdotool(
            {"search", "--sync", "--onlyvisible", "--name", "Isochron", "windowfocus", "key", "3"});
        ASSERT_TRUE(comes("first.jsonl.part", "\"quality\":\"quality\""));
        first.signal(SIGTERM);
        ASSERT_EQ(first.exit_status(), 128 + SIGTERM);
    }
    ASSERT_EQ(build("t*.raw", {"--append"}), 0);
    ASSERT_EQ(explored({"--resume", "--record", file("resumed.jsonl")}), 0);
    const auto start = read_recording(file("resumed.jsonl")).header.start;
    EXPECT_EQ(start.quality, interaction::QualityMode::quality);
    EXPECT_EQ(start.instant, index::Instant(1));
}

} // namespace
} // namespace isochron::app
