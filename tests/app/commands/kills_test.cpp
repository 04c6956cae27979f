// Commands that are killed at random calls: what lies on the disk is whole, the old or the new.
// ISOCHRON_KILLS in the environment says how often each is killed, 20 times otherwise.
#include "tests/app/commands/command_line.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <map>

namespace isochron::app {
namespace {

class Kills : public CommandLine {
  protected:
    static int kills() {
        const char* times = std::getenv("ISOCHRON_KILLS");
        return times ? std::atoi(times) : 20;
    }

    /// Kills the command at the last calls by which it changes files, which give them their names,
    /// and at random ones; `check` sees what each left.
    template <class Check>
    void kill(const std::vector<std::string>& command, Check check) {
        std::filesystem::remove(state_.path() / "log");
        ASSERT_EQ(run(command, 0).status, 0);
        const std::string log = state_.read("log");
        const auto calls = static_cast<unsigned>(std::count(log.begin(), log.end(), '\n'));
        ASSERT_GT(calls, 0u);
        check();
        std::mt19937 random(test_seed());
        int killed = 0;
        for (int i = 0; i < kills(); ++i) {
            constexpr unsigned kLast = 5;
            const auto which = static_cast<unsigned>(i);
            const ChildResult result =
                run(command, which < std::min(kLast, calls)
                                 ? calls - which
                                 : static_cast<unsigned>(1 + random() % calls));
            killed += result.status == 1000 + SIGKILL;
            EXPECT_TRUE(result.status == 0 || result.status == 1000 + SIGKILL) << result.err;
            check();
        }
        EXPECT_GT(killed, kills() / 4); // what an earlier one left behind may save some calls
        expect_nothing_left_later();
        EXPECT_EQ(isochron(command).status, 0);
    }

    /// Kills a command that writes new files: each is whole, byte for byte, or is not there.
    void kill_writer(const std::vector<std::string>& command,
                     const std::vector<std::string>& outputs) {
        std::map<std::string, std::string> whole;
        ASSERT_EQ(isochron(command).status, 0);
        for (const std::string& output : outputs) {
            whole[output] = folder.read(output);
            EXPECT_FALSE(whole[output].empty()) << output;
        }
        const auto clear = [&] {
            for (const std::string& output : outputs)
                std::filesystem::remove(folder.path() / output);
        };
        clear();
        kill(command, [&] {
            for (const std::string& output : outputs)
                if (std::filesystem::exists(folder.path() / output)) {
                    EXPECT_EQ(folder.read(output), whole[output]) << output;
                }
            clear();
        });
    }

    /// What killed commands have left goes when any command, here one that only reads, runs in the
    /// folder a minute later.
    void expect_nothing_left_later() {
        for (const auto& entry : std::filesystem::directory_iterator(folder.path()))
            std::filesystem::last_write_time(entry.path(),
                                             std::filesystem::file_time_type::clock::now() -
                                                 std::chrono::minutes(2));
        EXPECT_EQ(isochron({"info", "t0.raw", "--dims", "14", "11", "9", "--type", "f32"}).status,
                  0);
        for (const std::string& name : folder.names())
            EXPECT_FALSE(name.starts_with('.')) << name;
    }

    /// @param at the call at which it is killed; 0: none
    ChildResult run(const std::vector<std::string>& command, unsigned at) {
        return isochron(
            command,
            {.environment = {"LD_PRELOAD=" + test_support::binary_root() + "/libfaulty_calls.so",
                             fmt::format("ISOCHRON_CALL_LOG={}/log", state_.path().string()),
                             fmt::format("ISOCHRON_KILL_AT={}", at)}});
    }

    int steps_now() {
        EXPECT_EQ(isochron({"verify", "a.isochron"}).status, 0);
        return nlohmann::json::parse(isochron({"info", "a.isochron", "--json"}).out)
            .at("steps")
            .get<int>();
    }

    TestFolder state_;
};

TEST_F(Kills, OfABuildLeaveTheOldIndexOrTheNewOne) {
    ASSERT_EQ(isochron(build_of("t[01].raw")).status, 0);
    const std::string held = folder.read("a.isochron");
    kill(build_of("t*.raw", {"--quiet"}), [&] {
        const int now = steps_now();
        EXPECT_TRUE(now == 2 || now == 5) << now;
        folder.write("a.isochron", held);
    });
}

TEST_F(Kills, OfAppendingLeaveTheOldIndexOrTheNewOne) {
    ASSERT_EQ(isochron(build_of("t[01].raw")).status, 0);
    const std::string held = folder.read("a.isochron");
    kill(build_of("t*.raw", {"--append", "--quiet"}), [&] {
        const int now = steps_now();
        EXPECT_TRUE(now == 2 || now == 5) << now;
        if (now == 5) // what a kill leaves behind is kept until then
            folder.write("a.isochron", held);
    });
}

TEST_F(Kills, OfABuildOfANewNameLeaveNothing) {
    kill(build_of("t*.raw", {"--quiet"}), [&] {
        for (const std::string& name : folder.names())
            EXPECT_FALSE(name.starts_with('.')) << name;
        std::filesystem::remove(folder.path() / "a.isochron");
    });
}

TEST_F(Kills, OfAQueryLeaveAllIdsOrNone) {
    ASSERT_EQ(isochron(build_of("t*.raw")).status, 0);
    const std::vector<std::uint32_t> expected = active(3, 0.1);
    kill({"query", "a.isochron", "--isovalue", "0.1", "--step", "3", "--repeat", "0", "--ids",
          "ids.bin"},
         [&] {
             if (std::filesystem::exists(folder.path() / "ids.bin")) {
                 EXPECT_EQ(ids_in("ids.bin"), expected);
             }
             std::filesystem::remove(folder.path() / "ids.bin");
         });
}

TEST_F(Kills, OfAChangeLeaveWholeListsOrNone) {
    ASSERT_EQ(isochron(build_of("t*.raw")).status, 0);
    kill_writer({"change", "a.isochron", "--isovalue", "0.1", "--step", "0", "--to-step", "3",
                 "--added", "come.bin", "--removed", "gone.bin"},
                {"come.bin", "gone.bin"});
}

TEST_F(Kills, OfAnExportLeaveWholeSurfacesOrNone) {
    ASSERT_EQ(isochron(build_of("t*.raw")).status, 0);
    for (const std::string format : {"ply", "obj", "csv"})
        kill_writer(
            {"export", "a.isochron", "--isovalue", "0.1", "--steps", "0:2:2", "-o", "s." + format},
            {"s_0000." + format, "s_0002." + format});
    kill_writer(
        {"export", "a.isochron", "--isovalue", "0.1", "-o", "all.glb", "--format", "glb-animation"},
        {"all.glb"});
    kill_writer({"export", "a.isochron", "--isovalue", "0.1", "--steps", "0:1", "-o", "s.vtp"},
                {"s_0000.vtp", "s_0001.vtp", "s.pvd"});
}

TEST_F(Kills, OfAGeneratorLeaveWholeFilesOrNone) {
    kill_writer({"generate", "sphere", "--out", "made", "--steps", "2", "--force"},
                {"made/sphere.pvd", "made/sphere.json"});
}

} // namespace
} // namespace isochron::app
