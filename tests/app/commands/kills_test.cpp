// Commands that are killed at random moments: what lies on the disk is whole, the old or the new.
// ISOCHRON_KILLS in the environment says how often each is killed, 20 times otherwise.
#include "tests/app/commands/command_line.h"

#include <nlohmann/json.hpp>

#include <chrono>
#include <cstdlib>

namespace isochron::app {
namespace {

class Kills : public CommandLine {
  protected:
    static int kills() {
        const char* times = std::getenv("ISOCHRON_KILLS");
        return times ? std::atoi(times) : 20;
    }

    /// Kills the command at random moments of its run; `check` sees what each left.
    template <class Check>
    void kill(const std::vector<std::string>& command, Check check) {
        const auto begun = std::chrono::steady_clock::now();
        ASSERT_EQ(isochron(command).status, 0);
        const auto took = std::chrono::duration_cast<std::chrono::microseconds>(
                              std::chrono::steady_clock::now() - begun)
                              .count();
        std::mt19937 random(test_seed());
        int killed = 0;
        check();
        for (int i = 0; i < kills(); ++i) {
            killed +=
                isochron(command, {.dies_after = 1 + random() % std::uint64_t(took)}).status >=
                1000;
            check();
        }
        EXPECT_GT(killed, kills() / 4);
        EXPECT_EQ(isochron(command).status, 0);
    }

    int steps_now() {
        EXPECT_EQ(isochron({"verify", "a.isochron"}).status, 0);
        return nlohmann::json::parse(isochron({"info", "a.isochron", "--json"}).out)
            .at("steps")
            .get<int>();
    }
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

} // namespace
} // namespace isochron::app
