// The explorer and its desktop: data to choose, files that are dropped, sizes, a display that goes.
#include "tests/app/commands/explore_fixture.h"
#include "tests/support/child_process.h"
#include "tests/support/eventually.h"

#include "app/kept/recording_file.h"
#include "app/kept/user_memory.h"
#include "stereo/image_file.h"

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <algorithm>
#include <array>
#include <csignal>
#include <filesystem>
#include <functional>
#include <stdexcept>

namespace isochron::app {
namespace {

class ExploreWindow : public ExploreTest {
  protected:
    /// The title of the window that shows these data.
    std::string title(const std::string& name) const { return "Isochron: " + file(name); }
    void wait_for_window(const std::string& pattern) {
        screen_.xdotool({"search", "--sync", "--onlyvisible", "--name", pattern});
    }
    static bool is_shown(const std::string& data) {
        return system(
                   ("xdotool search --onlyvisible --name " + data + " > /dev/null 2>&1").c_str()) ==
               0;
    }
    /// Does it, once a frame at most, until these data are shown. @return false if they never are
    bool is_shown_after(const std::string& data, const std::function<void()>& act) const {
        return test_support::eventually([&] {
            try {
                act();
                await_frame();
            } catch (const std::runtime_error&) { // the window has just given way to another one
            }
            return is_shown(data);
        });
    }
    /// The bar of the tools is dark gray, what is beside it nearly black. Where no icon is.
    bool is_bar(int y) {
        const auto color = screen_.pixel(600, y);
        return color[0] > 30 && color[0] < 60 && color[2] > color[0];
    }
};

TEST_F(ExploreWindow, WithoutADisplayItSaysSo) {
    unsetenv("DISPLAY");
    EXPECT_EQ(Program({"explore", file("sphere.isochron")}).exit_status(), 1);
    EXPECT_EQ(Program({"explore"}).exit_status(), 1);
}

TEST_F(ExploreWindow, CopiesTheValueUnderTheCursorAndSavesTheSession) {
    const auto program = explore({"--record", file("walk.jsonl"), "--isovalue", "8", "--no-panel",
                                  "--session", file("kept.isochron-session")});
    screen_.xdotool(as_words("search --name Isochron mousemove --window %1 320 240"));
    std::string copied;
    EXPECT_TRUE(test_support::eventually([&] { // the surface is there after some frames
        screen_.xdotool({"key", "ctrl+c"});
        await_frame();
        copied = screen_.clipboard();
        return copied.find(" 8, t 0 s") != copied.npos;
    })) << copied;
    screen_.xdotool({"key", "ctrl+s"});
    await_frame();
    EXPECT_TRUE(comes("kept.isochron-session", "\"isovalue\": 8"));
    screen_.xdotool({"key", "ctrl+q"});
    await_frame();
    screen_.xdotool({"key", "Return"});
    EXPECT_EQ(program->exit_status(), 0);
    const auto recording = read_recording(file("walk.jsonl"));
    const auto any = [&](auto claim) {
        return std::ranges::any_of(recording.frames,
                                   [&](const auto& frame) { return claim(frame.commands); });
    };
    EXPECT_TRUE(any([](const auto& c) { return c.copy; }));
    EXPECT_TRUE(any([](const auto& c) { return c.save; }));
    EXPECT_TRUE(any([](const auto& c) { return c.leaving == true; }));
}

TEST_F(ExploreWindow, WritesThePictureThatIsSeenBesideThePanel) {
    const auto program = explore_sized(
        {"--isovalue", "8", "--screenshots", folder_.path().string(), "--size", "1000", "600"});
    screen_.xdotool(as_words("search --name Isochron mousemove --window %1 700 300"));
    await_frame();
    screen_.xdotool({"key", "p"});
    EXPECT_TRUE(test_support::eventually([&] {
        await_frame();
        return std::filesystem::exists(folder_.path() / "isochron_0001.png");
    }));
    program->signal(SIGTERM);
    EXPECT_EQ(program->exit_status(), 128 + SIGTERM);
    const render::Image seen = stereo::read_image(folder_.path() / "isochron_0001.png");
    EXPECT_LT(seen.height, 600) << "without the bars";
    EXPECT_GT(seen.height, 400);
    EXPECT_LT(seen.width, 1000) << "without the column";
    EXPECT_GT(seen.width, 400);
    EXPECT_EQ(Program({"reproduce", file("isochron_0001.png"), "--data", file("sphere.isochron")})
                  .exit_status(),
              0);
}

TEST_F(ExploreWindow, SaysAtOnceThatASessionCannotBeKept) {
    folder_.write("none", "a file where a folder should be");
    const ChildResult result =
        run_child(test_support::binary_root() + "/isochron",
                  {"explore", file("sphere.isochron"), "--size", "320", "240", "--seconds", "0.2"},
                  folder_.path(), {.environment = {"XDG_STATE_HOME=" + file("none")}});
    EXPECT_EQ(result.status, 0) << result.err;
    EXPECT_THAT(result.err, testing::HasSubstr("this session is not saved: " + file("none")));
}

TEST_F(ExploreWindow, HasTheSizeThatItHadLast) {
    const auto size_of = [&] {
        const Program program({"explore", file("sphere.isochron"), "--record", file("walk.jsonl"),
                               "--force", "--seconds", "0.2"});
        EXPECT_EQ(program.exit_status(), 0);
        return read_recording(file("walk.jsonl")).header.window;
    };
    EXPECT_EQ(size_of()[1], 720) << "as configured";
    {
        const auto program = explore_sized({});
        screen_.resize_window(title("sphere.isochron"), 700, 500);
        await_frame();
        program->signal(SIGTERM);
        EXPECT_EQ(program->exit_status(), 128 + SIGTERM);
    }
    EXPECT_EQ(size_of(), (std::array{700, 500}));
}

TEST_F(ExploreWindow, OfAnEmulatedRoomGrowsWithTheDisplaysScaleAndFitsOnIt) {
    screen_.set_dots_per_inch(120);
    const auto program = explore_sized({"--emulate"});
    const auto is_covered = [&](int y) {
        return screen_.pixel(640, y) != std::array<int, 3>{0, 0, 0};
    };
    EXPECT_TRUE(test_support::eventually([&] { return is_covered(800); }))
        << "720 pixels would be as at 96 dots per inch";
    EXPECT_FALSE(is_covered(1023)) << "its lower end is on the screen";
    program->signal(SIGTERM);
    EXPECT_EQ(program->exit_status(), 128 + SIGTERM);
}

TEST_F(ExploreWindow, OpensTheSameFilesWithAnotherArrayFromTheListOfAll) {
    std::filesystem::create_directory(file("run.zarr"));
    folder_.write("run.zarr/.zgroup", R"({"zarr_format":2})");
    for (const auto& [name, size] : {std::pair("heat", 6), std::pair("speed", 4)}) {
        std::filesystem::create_directory(file(std::string("run.zarr/") + name));
        folder_.write(fmt::format("run.zarr/{}/.zarray", name),
                      fmt::format(R"({{"zarr_format":2,"shape":[{0},{0},{0}],"chunks":[{0},{0},{0}],
            "dtype":"|u1","compressor":null,"fill_value":0,"order":"C","filters":null}})",
                                  size));
        std::string values;
        for (int i = 0; i < size * size * size; ++i)
            values += static_cast<char>(i % 100);
        folder_.write(fmt::format("run.zarr/{}/0.0.0", name), values);
    }
    const Program program({"explore", file("run.zarr"), "--size", "640", "480"});
    wait_for_window("Isochron");
    screen_.xdotool({"search", "--name", "Isochron", "windowfocus"});
    const UserMemory memory(state_.path() / "isochron");
    const auto is_chosen_by = [&](const std::string& array, const std::vector<std::string>& keys) {
        return test_support::eventually([&] {
            try {
                for (const std::string& key : keys) {
                    screen_.xdotool({"search", "--name", "Isochron", "windowfocus", "key", key});
                    await_frame();
                }
            } catch (const std::exception&) { // no window while other data are opened
            }
            return memory.array_of(file("run.zarr")) == array;
        });
    };
    EXPECT_TRUE(is_chosen_by("heat", {"Return"})) << "the window asks";
    EXPECT_TRUE(is_chosen_by("speed", {"ctrl+shift+a", "Down", "Return"}));
    EXPECT_TRUE(test_support::eventually([&] {
        const std::filesystem::directory_iterator kept(state_.path() / "isochron");
        return std::ranges::count_if(kept, [](const auto& entry) {
                   return entry.path().extension() == ".isochron";
               }) == 2;
    })) << "an index of each shape";
    program.signal(SIGTERM);
    EXPECT_EQ(program.exit_status(), 128 + SIGTERM);
}

TEST_F(ExploreWindow, OpensOtherDataFromTheListOfThoseThatWereOpenLately) {
    std::filesystem::copy_file(file("sphere.isochron"), file("other.isochron"));
    UserMemory memory(state_.path() / "isochron");
    memory.remember(file("other.isochron"));
    const auto program = explore({});
    ASSERT_EQ(memory.recent().front(), file("sphere.isochron"));
    // The place of the list is chosen, which is seen by its blue. Once it is there, nothing is pressed
    // twice: data that come change places with those that are open.
    ASSERT_TRUE(test_support::eventually([&] {
        screen_.xdotool({"key", "ctrl+o"});
        await_frame();
        const auto color = screen_.pixel(120, 104);
        return color[2] > color[0] + 40;
    }));
    for (const char* key : {"Down", "Return"}) { // the first line holds the data that are open
        screen_.xdotool({"key", key});
        await_frame();
    }
    EXPECT_TRUE(test_support::eventually(
        [&] { return memory.recent().front() == file("other.isochron"); }));
    wait_for_window("Isochron: .*/other.isochron");
    program->signal(SIGTERM);
    EXPECT_EQ(program->exit_status(), 128 + SIGTERM);
}

TEST_F(ExploreWindow, WithoutDataItLetsTheUserChooseSome) {
    UserMemory(state_.path() / "isochron").remember(file("sphere.isochron"));
    const Program program(as_words("explore --size 640 480 --seconds 300"));
    wait_for_window("Isochron: open data");
    // The first of those that were open lately; until it is there, nothing is clicked.
    EXPECT_TRUE(is_shown_after("sphere.isochron", [&] {
        screen_.xdotool(as_words("search --name Isochron windowfocus mousemove --window %1 320 150 "
                                 "click --repeat 2 --delay 40 1"));
    }));
    program.signal(SIGTERM);
    EXPECT_EQ(program.exit_status(), 128 + SIGTERM);
    const Program leaves({"explore", "--size", "640", "480"});
    wait_for_window("Isochron: open data");
    screen_.xdotool(as_words("search --name Isochron windowfocus keydown Escape"));
    EXPECT_EQ(leaves.exit_status(), 0);
}

TEST_F(ExploreWindow, OpensTheFileThatIsDroppedOntoIt) {
    std::filesystem::copy_file(file("sphere.isochron"), file("other.isochron"));
    folder_.write("none.txt", "no index");
    const auto program = explore({});
    screen_.drop_file(title("sphere.isochron"), file("none.txt")); // said, and nothing else
    screen_.drop_file(title("sphere.isochron"), file("other.isochron"));
    wait_for_window("Isochron: .*/other.isochron");
    program->signal(SIGTERM);
    EXPECT_EQ(program->exit_status(), 128 + SIGTERM);
}

/// 54 MiB, too much to be indexed as a whole, nearly all of it holes.
void write_series(const TestFolder& folder) {
    for (int step = 0; step < 5; ++step) {
        const std::string name = "s" + std::to_string(step) + ".vtk";
        folder.write(name, "# vtk DataFile Version 3.0\ns\nBINARY\nDATASET STRUCTURED_POINTS\n"
                           "DIMENSIONS 224 224 224\nORIGIN 0 0 0\nSPACING 1 1 1\nPOINT_DATA "
                           "11239424\nSCALARS s unsigned_char 1\nLOOKUP_TABLE default\n" +
                               std::string(100'000, static_cast<char>('a' + step)));
        const auto header = std::filesystem::file_size(folder.path() / name) - 100'000;
        std::filesystem::resize_file(folder.path() / name, header + 11239424);
    }
}

TEST_F(ExploreWindow, OfFilesWithoutAnIndexItShowsAllStepsInTheEnd) {
    write_series(folder_);
    const Program program({"explore", file("s*.vtk"), "--size", "640", "480", "--record",
                           file("walk.jsonl"), "--report", file("report.json"), "--seconds",
                           "300"});
    // Until all steps are there: at the start, or as the index grows.
    ASSERT_TRUE(comes("walk.jsonl.part", "\"steps\":5"));
    program.signal(SIGTERM);
    EXPECT_EQ(program.exit_status(), 128 + SIGTERM);
    EXPECT_FALSE(read_recording(file("walk.jsonl")).frames.empty());
    // What the user knows them by.
    EXPECT_EQ(UserMemory(state_.path() / "isochron").recent().front(),
              folder_.path() / "s[0-9]*.vtk");
}

TEST_F(ExploreWindow, OpensFilesOfValuesThatAreDroppedOntoIt) {
    write_series(folder_);
    folder_.write("damaged.vtk", "# vtk DataFile Version 3.0\nnothing\n");
    const auto program = explore({});
    screen_.drop_file(title("sphere.isochron"), file("damaged.vtk")); // said, and nothing else
    screen_.drop_file(title("sphere.isochron"), file("s2.vtk"));
    wait_for_window("Isochron: .*/s2.vtk");
    program->signal(SIGTERM);
    EXPECT_EQ(program->exit_status(), 128 + SIGTERM);
}

TEST_F(ExploreWindow, ComesToRestAndIsWokenByAKeyAndBySignals) {
    const auto program = explore({"--record", file("walk.jsonl")});
    // A loop that goes on adds a frame to the recording each time. The test's limit ends a hang.
    const auto rests = [this] {
        for (std::string before = "none", now; now != before;) {
            before = std::exchange(now, folder_.read("walk.jsonl.part"));
            std::this_thread::sleep_for(std::chrono::seconds(2));
            now = folder_.read("walk.jsonl.part");
        }
    };
    rests();
    screen_.xdotool({"key", "2"});
    while (folder_.read("walk.jsonl.part").find("\"fast\"") == std::string::npos)
        std::this_thread::sleep_for(std::chrono::milliseconds(20));
    rests();
    program->signal(SIGTERM);
    EXPECT_EQ(program->exit_status(), 128 + SIGTERM);
    EXPECT_FALSE(read_recording(file("walk.jsonl")).frames.empty());
}

TEST_F(ExploreWindow, ShowsAgainWhatTheServerHasLost) {
    const auto program = explore({});
    ASSERT_TRUE(test_support::eventually([&] { return is_bar(4); }));
    screen_.xdotool(as_words("search --name Isochron windowunmap --sync"));
    ASSERT_TRUE(test_support::eventually([&] { return !is_bar(4); }));
    screen_.xdotool(as_words("search --name Isochron windowmap --sync"));
    EXPECT_TRUE(test_support::eventually([&] { return is_bar(4); }));
    program->signal(SIGTERM);
    EXPECT_EQ(program->exit_status(), 128 + SIGTERM);
}

TEST_F(ExploreWindow, EndsWithItsDisplayAndKeepsTheRecording) {
    const auto program = explore({"--record", file("walk.jsonl")});
    screen_.xdotool({"key", "2"});
    ASSERT_TRUE(comes("walk.jsonl.part", "\"fast\""));
    screen_.die();
    EXPECT_EQ(program->exit_status(), 1);
    EXPECT_FALSE(read_recording(file("walk.jsonl")).frames.empty());
    EXPECT_FALSE(std::filesystem::exists(file("walk.jsonl.part")));
}

TEST_F(ExploreWindow, ADesktopWithTwiceTheDotsHasAPanelOfTwiceTheSize) {
    for (const int scale : {1, 2}) {
        screen_.set_dots_per_inch(96 * scale);
        const Program program({"explore", file("sphere.isochron"), "--size", "1000", "800"});
        wait_for_window("Isochron");
        EXPECT_TRUE(test_support::eventually([&] { return is_bar(4); }));
        EXPECT_EQ(is_bar(66), scale == 2) << "36 high, or 72";
        program.signal(SIGTERM);
        program.exit_status();
    }
}

} // namespace
} // namespace isochron::app
