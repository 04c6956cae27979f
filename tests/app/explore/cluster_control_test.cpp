// A job of several processes that is steered from outside: the first one listens, and all obey.
#include "tests/app/explore/small_cave.h"
#include "tests/support/child_process.h"
#include "tests/support/eventually.h"
#include "tests/support/paths.h"
#include "tests/support/session_fixture.h"
#include "tests/support/virtual_display.h"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <filesystem>
#include <future>
#include <vector>

namespace isochron::app {
namespace {

class ClusterControlTest : public testing::Test {
  protected:
    ClusterControlTest() {
        build_sphere(folder_.path(), 12);
        folder_.write("lab.toml", mono_cave());
    }

    /// Two processes, each with some of the walls.
    ChildResult job() const {
        const std::string explore =
            fmt::format("exec {}/isochron explore sphere.isochron --config lab.toml --no-panel "
                        "--control {} --record walk.jsonl --report timing.json",
                        test_support::binary_root(), socket());
        return run_child("/usr/bin/env", of_processes(2, {"/bin/sh", "-c", explore}),
                         folder_.path());
    }
    ChildResult tell(std::vector<std::string> words) const {
        words.insert(words.begin(), {"tell", "--socket", socket()});
        return run_child(test_support::binary_root() + "/isochron", words, folder_.path());
    }
    std::string socket() const { return (folder_.path() / "control.sock").string(); }

    TestFolder folder_;
};

TEST_F(ClusterControlTest, TheFirstProcessListensAndAllObey) {
    const test_support::VirtualDisplay screen;
    auto ended = std::async(std::launch::async, [this] { return job(); });
    ASSERT_TRUE(test_support::eventually([this] { return std::filesystem::exists(socket()); }));
    EXPECT_EQ(tell({"step=2", "isovalue=6"}).status, 0);
    const auto state = nlohmann::json::parse(tell({"state"}).out);
    EXPECT_EQ(state.at("step"), 2);
    EXPECT_EQ(state.at("isosurfaces")[0].at("isovalue"), 6);
    EXPECT_EQ(tell({"step=99"}).status, 1) << "refused, and the job goes on";
    EXPECT_EQ(tell({"picture", "-o", "now.png"}).status, 0);
    EXPECT_TRUE(std::filesystem::exists(folder_.path() / "now.png"));
    EXPECT_EQ(tell({"cells", "-o", "told.bin"}).status, 0);
    EXPECT_EQ(tell({"quit"}).status, 0);
    const ChildResult result = ended.get();
    EXPECT_EQ(result.status, 0) << result.err;
    EXPECT_FALSE(std::filesystem::exists(socket()));

    run_child(test_support::binary_root() + "/isochron",
              {"query", "sphere.isochron", "--isovalue", "6", "--step", "2", "--ids", "ids.bin"},
              folder_.path());
    EXPECT_FALSE(folder_.read("ids.bin").empty());
    EXPECT_EQ(folder_.read("told.bin"), folder_.read("ids.bin"));
    // What was told is in the recording, and the process that follows has shown it, too.
    EXPECT_FALSE(folder_.read("walk.jsonl").empty());
    bool shown = false;
    const auto first = nlohmann::json::parse(folder_.read("timing.json"))["rows"];
    const auto second = nlohmann::json::parse(folder_.read("timing_rank1.json"))["rows"];
    ASSERT_EQ(first.size(), second.size());
    for (std::size_t i = 0; i < first.size(); ++i) {
        EXPECT_EQ(first[i]["shown"], second[i]["shown"]) << "frame " << i;
        shown = shown || second[i]["shown"] == nlohmann::json{{"step", 2}, {"isovalue", 6.0}};
    }
    EXPECT_TRUE(shown);
}

} // namespace
} // namespace isochron::app
