// The whole program as a job of several processes: they show one picture and end together.
#include "tests/app/explore/small_cave.h"
#include "tests/support/child_process.h"
#include "tests/support/eventually.h"
#include "tests/support/session_fixture.h"

#include "app/kept/recording_file.h"
#include "tests/support/nearness_series.h"
#include "tests/support/paths.h"
#include "tests/support/virtual_display.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <csignal>
#include <functional>
#include <future>
#include <map>
#include <set>

namespace isochron::app {
namespace {

using testing::HasSubstr;

class ClusterJobTest : public testing::Test {
  protected:
    ClusterJobTest() { build_sphere(folder_.path(), 12); }

    /// Moments between steps, a flight, and then somebody who stands and looks.
    void record(const std::string& configuration, int frames = 16) {
        interaction::RecordingHeader header;
        header.configuration = configuration;
        header.data = "sphere.isochron";
        header.start.isovalue = 8.0;
        header.start.stereo = "quadbuffer";
        header.start.between = interaction::BetweenSteps::blend;
        interaction::RecordingWriter writer(folder_.path() / "walk.jsonl", header);
        for (int i = 0; i < frames; ++i) {
            interaction::RecordedFrame frame;
            frame.input = head_at_rest(i < 8 ? i / 60.0 : 1.0 + i);
            if (i < 8)
                frame.input.devices.front().pose->position.x = 0.02f * static_cast<float>(i);
            if (i < 6) {
                frame.commands.instant = {static_cast<std::uint32_t>(i),
                                          static_cast<std::uint32_t>(10'000 * i)};
            }
            if (i % 5 == 0)
                frame.commands.stamps = {"stamp"};
            writer.append(frame);
        }
        writer.finish();
    }

    /// The array of the surfaces changes, then what colors them, and both at once.
    void record_changing_arrays(const std::string& configuration) {
        MovingSphere sphere(12);
        NearnessSeries nearness(sphere.info());
        build_index(sphere, folder_.path() / "both.isochron",
                    {.further = {{.series = &nearness, .array = "nearness"}}});
        interaction::RecordingHeader header;
        header.configuration = configuration;
        header.data = "both.isochron";
        header.start.isovalue = 8.0;
        header.start.stereo = "quadbuffer";
        interaction::RecordingWriter writer(folder_.path() / "arrays.jsonl", header);
        const auto surface = [](double isovalue) {
            return std::vector{interaction::Isosurface{.isovalue = isovalue}};
        };
        const auto colored_by = [](const std::string& array) {
            interaction::Coloring coloring{.by = interaction::ColorBy::value};
            coloring.array = array;
            return coloring;
        };
        for (int i = 0; i < 8; ++i) {
            interaction::RecordedFrame frame;
            frame.input = head_at_rest(1.0 + i);
            frame.commands.instant = index::Instant(static_cast<std::uint32_t>(i));
            frame.commands.stamps = {"stamp"};
            if (i == 1)
                frame.commands.coloring = colored_by("nearness");
            if (i == 3) {
                frame.commands.array = "nearness";
                frame.commands.isosurfaces = surface(70);
                frame.commands.coloring = interaction::Coloring{};
            }
            if (i == 4)
                frame.commands.coloring = colored_by("distance");
            if (i == 6) {
                frame.commands.array = "distance";
                frame.commands.isosurfaces = surface(6);
                frame.commands.coloring = colored_by("nearness");
            }
            writer.append(frame);
        }
        writer.finish();
    }

    /// What a shell makes of one process's part; `$isochron` is the program.
    static std::string part(const std::string& script) {
        return fmt::format("isochron='{}/isochron'; {}", test_support::binary_root(), script);
    }
    /// A job of as many processes as there are scripts.
    ChildResult job(const std::vector<std::string>& scripts) {
        // One command for all processes: mpirun 5.0.7 crashes if there are several.
        std::string parts = "case $OMPI_COMM_WORLD_RANK in";
        for (std::size_t rank = 0; rank < scripts.size(); ++rank)
            parts += fmt::format("\n{}) {} ;;", rank, part(scripts[rank]));
        return run_child("/usr/bin/env",
                         of_processes(scripts.size(), {"/bin/sh", "-c", parts + "\nesac"}),
                         folder_.path());
    }
    ChildResult job(int processes, const std::string& script) {
        return job(std::vector<std::string>(static_cast<std::size_t>(processes), script));
    }
    ChildResult alone(const std::string& script) {
        return run_child("/bin/sh", {"-c", part(script)}, folder_.path());
    }

    std::map<std::string, std::string> files_in(const std::string& name) const {
        std::map<std::string, std::string> files;
        for (const auto& entry : std::filesystem::directory_iterator(folder_.path() / name))
            files[entry.path().filename()] =
                folder_.read(name + "/" + entry.path().filename().string());
        return files;
    }

    /// What the program said, line by line, without what mpirun says.
    static std::vector<std::string> lines_of(const ChildResult& result) {
        std::vector<std::string> lines;
        for (std::size_t at = 0; (at = result.err.find("isochron: ", at)) != std::string::npos;
             ++at)
            lines.push_back(result.err.substr(at, result.err.find('\n', at) - at));
        // That processes draw on the same processors is no fault of theirs.
        std::erase_if(lines, [](const std::string& line) { return line.starts_with(kProcessors); });
        return lines;
    }
    static void expect_one_line(const ChildResult& result, const std::string& start,
                                const std::string& part) {
        EXPECT_NE(result.status, 0);
        const auto lines = lines_of(result);
        ASSERT_EQ(lines.size(), 1u) << result.err;
        EXPECT_THAT(lines.front(), testing::StartsWith("isochron: " + start));
        EXPECT_THAT(lines.front(), HasSubstr(part));
    }

    /// Sends a process a signal once the job has written pictures.
    static std::string struck_by(const std::string& signal, const std::string& command) {
        return fmt::format("echo $$ > struck; (while kill -0 $$ && ! ls out/frame_00002*; do "
                           "sleep 0.05; done; kill -{} $$) >/dev/null 2>&1 & exec {}",
                           signal, command);
    }

    static constexpr const char* kProcessors = "isochron: note: ";
    TestFolder folder_;
};

constexpr const char* kReplay = "$isochron replay walk.jsonl --out out --every 1";

TEST_F(ClusterJobTest, PicturesEqualThoseOfASingleProcess) {
    record(small_cave());
    for (const auto& [eyes, processes] : {std::pair<std::string, int>{"window", 2}, {"each", 5}}) {
        const std::string replay =
            "$isochron replay walk.jsonl --stamps --eyes " + eyes + " --out ";
        ASSERT_EQ(alone(replay + eyes).status, 0);
        const auto expected = files_in(eyes);
        EXPECT_EQ(expected.size(), 4u * 4 * 2);
        const ChildResult result = job(processes, replay + eyes + "_job --report timing.json");
        ASSERT_EQ(result.status, 0) << result.err;
        EXPECT_EQ(files_in(eyes + "_job"), expected) << processes << " processes";
    }
    EXPECT_THAT(folder_.read("timing.json"), HasSubstr("\"barrier\""));
    EXPECT_THAT(folder_.read("timing.json"), HasSubstr("\"surface\": "));
    EXPECT_THAT(folder_.read("timing_rank4.json"), HasSubstr("\"barrier\""));
}

TEST_F(ClusterJobTest, AFilmOfKeysHasTheSameBytesTwiceAndOnFiveProcesses) {
    build_sphere(folder_.path());
    folder_.write("cave.toml", small_cave());
    folder_.write("keys.json", R"({"format": "isochron keys", "version": 1, "keys": [
        {"time": 0, "step": 0, "isovalue": 8,
         "head": [0, 1.6, 0, 0, 0, 0, 1],
         "room_from_physical": {"translation": [-0.5, 0.8, -1.5], "rotation": [0, 0, 0, 1],
                                "scale": 0.05}},
        {"time": 1, "hold": 0.5, "step": 3, "isovalue": 12,
         "room_from_physical": {"translation": [-0.2, 1, -1], "rotation": [0, 0.6, 0, 0.8],
                                "scale": 0.03}},
        {"time": 3, "step": 5, "head": [0.3, 1.5, 0, 0, 0, 0, 1],
         "room_from_physical": {"translation": [-1, 0.5, -1.5], "rotation": [0, 0, 0, 1],
                                "scale": 0.1}}]})");
    const std::string film = "$isochron movie sphere.isochron --config cave.toml --keys keys.json "
                             "--rate 2 -o ";
    for (const char* name : {"a.jsonl", "b.jsonl"}) {
        const ChildResult made = alone(film + name);
        ASSERT_EQ(made.status, 0) << made.err;
    }
    EXPECT_EQ(folder_.read("a.jsonl"), folder_.read("b.jsonl"));
    const std::string replay = " --every 1 --eyes each --out ";
    ASSERT_EQ(alone("$isochron replay a.jsonl" + replay + "alone").status, 0);
    ASSERT_EQ(alone("$isochron replay b.jsonl" + replay + "again").status, 0);
    const auto expected = files_in("alone");
    EXPECT_EQ(expected.size(), 7u * 4 * 2);
    EXPECT_EQ(files_in("again"), expected);
    const ChildResult result = job(5, "$isochron replay a.jsonl" + replay + "job");
    ASSERT_EQ(result.status, 0) << result.err;
    EXPECT_EQ(files_in("job"), expected);
}

TEST_F(ClusterJobTest, ChangesOfArraysGiveThePicturesOfASingleProcess) {
    record_changing_arrays(small_cave());
    const std::string replay = "$isochron replay arrays.jsonl --stamps --eyes each --out ";
    const ChildResult one = alone(replay + "alone");
    ASSERT_EQ(one.status, 0) << one.err;
    const auto expected = files_in("alone");
    ASSERT_EQ(expected.size(), 8u * 4 * 2);
    std::set<std::string> front;
    for (const auto& [name, bytes] : expected)
        if (name.find("front_left") != name.npos)
            front.insert(bytes);
    EXPECT_EQ(front.size(), 8u) << "every step and change shows";
    const ChildResult result = job(2, replay + "job");
    ASSERT_EQ(result.status, 0) << result.err;
    EXPECT_EQ(files_in("job"), expected);
}

TEST_F(ClusterJobTest, AKilledProcessEndsTheJob) {
    // However slow mpirun is, it names the killed process before the others miss that.
    record(small_cave("\n[cluster]\ntimeout = 600.0\n"), 20000);
    const ChildResult result = job({kReplay, struck_by("KILL", kReplay), kReplay});
    EXPECT_NE(result.status, 0);
    EXPECT_THAT(result.err, HasSubstr("signal 9"));
    EXPECT_LE(lines_of(result).size(), 1u) << result.err;
}

TEST_F(ClusterJobTest, AStoppedProcessEndsTheJobWithItsName) {
    record(small_cave(), 20000);
    const ChildResult result = job({kReplay, kReplay, struck_by("STOP", kReplay)});
    expect_one_line(result, "process 2 on ", "no sign of life for ");
    const pid_t struck = std::stoi(folder_.read("struck"));
    EXPECT_TRUE(test_support::eventually([&] { return kill(struck, 0) != 0; }))
        << "nobody is left behind; mpirun may take a moment";
}

TEST_F(ClusterJobTest, AStoppedFirstProcessIsNamedByOneOfTheOthers) {
    record(small_cave(), 20000);
    const ChildResult result = job({struck_by("STOP", kReplay), kReplay, kReplay});
    expect_one_line(result, "process 0 on ", "no sign of life for ");
}

TEST_F(ClusterJobTest, AFailureOfOneProcessEndsTheJobWithItsName) {
    record(small_cave());
    // There is something else where one of its pictures belongs.
    std::filesystem::create_directories(folder_.path() / "out/stamp_00005_stamp_floor_left.png");
    const std::string replay = "$isochron replay walk.jsonl --out out --stamps --eyes each";
    expect_one_line(job(2, replay), "process 1 on ", "stamp_00005_stamp_floor_left.png");
}

TEST_F(ClusterJobTest, ProcessesThatSeeOtherDataOrConfigurationRefuseToStart) {
    record(small_cave());
    std::filesystem::create_directory(folder_.path() / "other");
    build_sphere(folder_.path() / "other", 7);
    const std::string replay = "$isochron replay walk.jsonl --stamps --out out ";
    expect_one_line(job({replay, replay, replay + "--data other/sphere.isochron"}), "process 2 on ",
                    ": another data set: 'content hash ");
    folder_.write("a.toml", small_cave());
    folder_.write("b.toml", small_cave("[emulation]\nwalk_speed = 2.5\n"));
    expect_one_line(job({replay + "--config a.toml", replay + "--config b.toml"}), "process 1 on ",
                    ": another configuration: '[emulation]', process 0 has 'its end'");
    expect_one_line(job({replay, replay + "--stereo left"}), "process 1 on ",
                    ": another start: stereo is '\"left\"', process 0 has '\"quadbuffer\"'");
    expect_one_line(job({replay, replay + "--size 32 32"}), "process 1 on ",
                    ": another installation: 'size = [32, 32]', process 0 has 'size = [64, 40]'");
    expect_one_line(job({replay, replay + "--data missing"}), "process 1 on ", ": missing");
    EXPECT_FALSE(std::filesystem::exists(folder_.path() / "out" / "stamp_00000_stamp_front.png"));
}

TEST_F(ClusterJobTest, AJobThatDoesNotFitTheInstallationIsToldWhy) {
    record(small_cave());
    expect_one_line(job(6, kReplay), "walk.jsonl", "6 processes for 5 nodes");
    expect_one_line(job(2, std::string(kReplay) + " --emulate"), "--emulate", "without mpirun");
}

TEST_F(ClusterJobTest, TheTestPatternIsTheOneOfASingleProcess) {
    record(small_cave());
    const std::string replay = "$isochron replay walk.jsonl --test-pattern --every 5 --out ";
    ASSERT_EQ(alone(replay + "alone").status, 0);
    const auto expected = files_in("alone");
    EXPECT_EQ(expected.size(), 4u * 4 * 2);
    for (const int processes : {2, 5}) {
        const std::string out = fmt::format("job{}", processes);
        const ChildResult result = job(processes, replay + out);
        ASSERT_EQ(result.status, 0) << result.err;
        EXPECT_EQ(files_in(out), expected) << processes << " processes";
    }
    expect_one_line(job({replay + "out", replay + "out --stereo left"}), "process 1 on ",
                    ": another stereo mode: 'left', process 0 has 'quadbuffer'");
    expect_one_line(job(2, replay + "out --emulate"), "--emulate", "without mpirun");
}

TEST_F(ClusterJobTest, TheLiveTestPatternEndsOnAllWallsAtOnce) {
    const test_support::VirtualDisplay screen;
    folder_.write("lab.toml", mono_cave());
    auto ended = std::async(std::launch::async, [&] {
        return job(2, "$isochron explore --test-pattern --config lab.toml");
    });
    screen.xdotool({"search", "--sync", "--onlyvisible", "--name", "Isochron.*left"});
    screen.xdotool({"search", "--sync", "--onlyvisible", "--name", "Isochron.*floor"});
    screen.close_window("Isochron: test pattern: floor"); // the second process's
    const ChildResult result = ended.get();
    EXPECT_EQ(result.status, 0) << result.err;
    EXPECT_EQ(lines_of(result).size(), 0u) << result.err;
}

TEST_F(ClusterJobTest, AProcessThatFollowsAndIsTerminatedEndsTheJobWithItsName) {
    const test_support::VirtualDisplay screen;
    folder_.write("lab.toml", mono_cave());
    const std::string explore =
        "echo $$ > pid$OMPI_COMM_WORLD_RANK; exec $isochron explore sphere.isochron --config "
        "lab.toml --no-panel";
    auto ended = std::async(std::launch::async, [&] { return job(2, explore); });
    screen.xdotool({"search", "--sync", "--onlyvisible", "--name", "Isochron.*floor"});
    ::kill(std::stoi(folder_.read("pid1")), SIGTERM);
    expect_one_line(ended.get(), "process 1 on ", "ended by SIGTERM");
}

TEST_F(ClusterJobTest, ProcessesThatShareAProcessorAreToldOnce) {
    record(small_cave());
    const std::string replay = "exec taskset -c 0 $isochron replay walk.jsonl --stamps --out out";
    const ChildResult result = job(2, replay);
    ASSERT_EQ(result.status, 0) << result.err;
    std::size_t lines = 0;
    for (std::size_t at = 0; (at = result.err.find(kProcessors, at)) != std::string::npos; ++at)
        ++lines;
    EXPECT_EQ(lines, 1u) << result.err;
    EXPECT_THAT(result.err, HasSubstr("2 processes draw in software on "));
    EXPECT_THAT(result.err, HasSubstr("2 threads on 1 processor: start no more than 1 there"));
}

TEST_F(ClusterJobTest, ADriverWithoutSwapGroupsIsNamedWhereOneIsAskedFor) {
    const test_support::VirtualDisplay screen;
    folder_.write("lab.toml", "[[windows]]\n[[windows]]\nnode = 1\n[cluster]\nswap_group = true\n");
    expect_one_line(job(2, "$isochron explore sphere.isochron --config lab.toml"),
                    "cluster.swap_group: ", "GLX_NV_swap_group");
}

TEST_F(ClusterJobTest, InWindowsEveryProcessShowsItsOwnAndAllLeaveTogether) {
    const test_support::VirtualDisplay screen;
    folder_.write("lab.toml", mono_cave());
    const std::string explore = "$isochron explore sphere.isochron --config lab.toml --no-panel "
                                "--between blend --record walk.jsonl --report timing.json";
    auto ended = std::async(std::launch::async, [&] { return job(2, explore); });
    const auto comes = [&](const std::function<bool()>& it) {
        EXPECT_TRUE(test_support::eventually(it));
    };
    const auto has = [&](const char* name) {
        return std::filesystem::exists(folder_.path() / name);
    };
    screen.xdotool({"search", "--sync", "--onlyvisible", "--name", "Isochron.*floor"});
    screen.xdotool(
        {"search", "--sync", "--onlyvisible", "--name", "Isochron.*left", "windowfocus"});
    screen.xdotool({"key", "p"});
    comes([&] { return has("isochron_0001_front.png") && has("isochron_0001_floor.png"); });
    screen.xdotool({"key", "space"}); // time runs: every frame may bring other cells
    comes([&] { return folder_.read("walk.jsonl.part").find("\"step\":3") != std::string::npos; });
    screen.close_window("Isochron: sphere.isochron: floor");
    const ChildResult result = ended.get();
    EXPECT_EQ(result.status, 0) << result.err;
    EXPECT_EQ(lines_of(result).size(), 1u) << result.err; // where the recording is
    for (const char* wall : {"front", "left", "right", "floor"})
        EXPECT_TRUE(
            std::filesystem::exists(folder_.path() / fmt::format("isochron_0001_{}.png", wall)))
            << wall;
    EXPECT_FALSE(read_recording(folder_.path() / "walk.jsonl").frames.empty());
    // Frame by frame, both have shown the same cells in the same way.
    const auto first = nlohmann::json::parse(folder_.read("timing.json"))["rows"];
    const auto second = nlohmann::json::parse(folder_.read("timing_rank1.json"))["rows"];
    ASSERT_EQ(first.size(), second.size());
    std::set<std::string> shown;
    for (std::size_t i = 0; i < first.size(); ++i) {
        for (const char* key : {"t", "asked", "shown", "pace", "footprint", "reason"})
            EXPECT_EQ(first[i][key], second[i][key]) << "frame " << i << ", " << key;
        shown.insert(first[i]["shown"].dump());
    }
    EXPECT_GE(shown.size(), 3u) << "several sets were shown";
    EXPECT_THAT(shown, testing::Contains(HasSubstr("fraction"))) << "between steps, too";
}

TEST_F(ClusterJobTest, AStillPictureEndsExactOnAllWallsInTheSameFrameThoughNoFrameHoldsIt) {
    const test_support::VirtualDisplay screen;
    folder_.write("lab.toml",
                  mono_cave("\n[quality]\nframe_budget_ms = 0.001\nstill_budget_ms = 0.001\n"));
    const std::string explore = "$isochron explore sphere.isochron --config lab.toml --no-panel "
                                "--report timing.json";
    auto ended = std::async(std::launch::async, [&] { return job(2, explore); });
    screen.xdotool({"search", "--sync", "--onlyvisible", "--name", "Isochron.*floor"});
    screen.xdotool(
        {"search", "--sync", "--onlyvisible", "--name", "Isochron.*left", "windowfocus"});
    screen.xdotool({"key", "p"}); // written once the picture is final
    for (const char* wall : {"front", "left", "right", "floor"})
        EXPECT_TRUE(test_support::eventually([&] {
            return std::filesystem::exists(folder_.path() /
                                           fmt::format("isochron_0001_{}.png", wall));
        }));
    screen.close_window("Isochron: sphere.isochron: floor");
    const ChildResult result = ended.get();
    EXPECT_EQ(result.status, 0) << result.err;
    const auto first = nlohmann::json::parse(folder_.read("timing.json"))["rows"];
    const auto second = nlohmann::json::parse(folder_.read("timing_rank1.json"))["rows"];
    ASSERT_EQ(first.size(), second.size());
    bool exact = false;
    for (std::size_t i = 0; i < first.size(); ++i) {
        for (const char* key : {"footprint", "reason"})
            EXPECT_EQ(first[i][key], second[i][key]) << "frame " << i << ", " << key;
        exact |= first[i]["footprint"] == "surface" && first[i]["reason"] == "in parts";
    }
    EXPECT_TRUE(exact);
}

} // namespace
} // namespace isochron::app
