// Every file call of configuration, replay, movie and explorer made to fail in turn: no crash, a
// line, and what has appeared under its name is whole.
#include "tests/app/commands/faults.h"
#include "tests/support/virtual_display.h"

#include <nlohmann/json.hpp>

namespace isochron::app {
namespace {

namespace fs = std::filesystem;

/// A small series that was explored once.
class ExploreFaults : public Faults {
  protected:
    ExploreFaults() {
        keep_state_here();
        EXPECT_EQ(isochron(build_of("t[01].raw")).status, 0);
        const ChildResult explored = isochron(explore_to("walk.jsonl"));
        EXPECT_EQ(explored.status, 0) << explored.err;
        make_twelve_frames("walk.jsonl");
    }
    static std::vector<std::string> explore_to(const std::string& recording) {
        return {"explore", "a.isochron", "--size",  "96",      "64",        "--seconds",
                "0.2",     "--record",   recording, "--force", "--session", "s.isochron-session"};
    }
    /// These alone, unless all are tried.
    static std::vector<Fault> file_faults_like(std::vector<Fault> some) {
        return test_support::tries_every_fault() ? file_faults() : some;
    }
    void clear(const std::string& name) { fs::remove_all(folder.path() / name); }
    bool has(const std::string& name) const { return fs::exists(folder.path() / name); }
    std::vector<std::string> names_in(const std::string& name) const {
        std::vector<std::string> names;
        if (has(name))
            for (const auto& entry : fs::directory_iterator(folder.path() / name))
                names.push_back(entry.path().filename());
        std::ranges::sort(names);
        return names;
    }
    /// No other files than these are left.
    void expect_nothing_beside(const std::vector<std::string>& names) {
        for (const std::string& name : folder.names())
            EXPECT_TRUE(std::ranges::find(names, name) != names.end()) << name;
    }
    bool is_json(const std::string& name) const {
        return nlohmann::json::accept(folder.read(name));
    }

    test_support::VirtualDisplay screen_;
};

TEST_F(ExploreFaults, LeaveWholePicturesOfAReplay) {
    const std::vector<std::string> command{"replay", "walk.jsonl", "--every",  "3",
                                           "--out",  "shots",      "--report", "r.json",
                                           "--size", "96",         "64"};
    ASSERT_EQ(isochron(command).status, 0);
    const std::vector<std::string> all = names_in("shots");
    ASSERT_FALSE(all.empty());
    std::vector<std::string> right;
    for (const std::string& name : all)
        right.push_back(folder.read("shots/" + name));
    int met = 0;
    for (const Fault& fault : file_faults_like(
             {{"open", "EIO"}, {"read", "EIO"}, {"read", "EINTR"}, {"write", "ENOSPC"}}))
        met += each_call(
            fault, command,
            [&] {
                clear("shots");
                clear("r.json");
            },
            [&](const ChildResult& result) {
                const std::vector<std::string> names = names_in("shots");
                for (std::size_t i = 0; i < all.size(); ++i)
                    if (std::ranges::find(names, all[i]) != names.end()) {
                        EXPECT_TRUE(folder.read("shots/" + all[i]) == right[i]) << all[i];
                    }
                EXPECT_TRUE(std::ranges::includes(all, names)) << testing::PrintToString(names);
                if (result.status == 0) {
                    EXPECT_EQ(names, all);
                    EXPECT_TRUE(is_json("r.json"));
                } else if (has("r.json")) {
                    EXPECT_TRUE(is_json("r.json"));
                }
            });
    EXPECT_GT(met, 6);
}

TEST_F(ExploreFaults, LeaveTheFramesOfAMovieOrNone) {
    const std::vector<std::string> command{"movie", "walk.jsonl", "-o", "frames", "--rate",
                                           "10",    "--size",     "96", "64"};
    ASSERT_EQ(isochron(command).status, 0);
    const std::vector<std::string> all = names_in("frames"), around = folder.names();
    int met = 0;
    for (const Fault& fault :
         file_faults_like({{"sync", "EIO"}, {"rename", "EIO"}, {"write", "short"}}))
        met += each_call(
            fault, command, [&] { clear("frames"); },
            [&](const ChildResult& result) {
                if (result.status == 0)
                    EXPECT_EQ(names_in("frames"), all);
                else
                    EXPECT_FALSE(has("frames"));
                expect_nothing_beside(around);
            });
    EXPECT_GT(met, 4);
}

TEST_F(ExploreFaults, LeaveAConfigurationOrNone) {
    folder.write("cave.pvx", "<pvx><Process Type=\"client\"/><Process Type=\"server\">"
                             "<Machine Name=\"a\" Environment=\"DISPLAY=:0\" "
                             "LowerLeft=\"-1 -1 -1\" LowerRight=\"1 -1 -1\" "
                             "UpperRight=\"1 1 -1\"/></Process></pvx>");
    const std::vector<std::string> command{"config", "import", "cave.pvx", "-o", "cave.toml"};
    const ChildResult imported = isochron(command);
    ASSERT_EQ(imported.status, 0) << imported.err;
    const std::string right = folder.read("cave.toml");
    const std::vector<std::string> around = folder.names();
    int met = 0;
    for (const Fault& fault : file_faults())
        met += each_call(
            fault, command, [&] { clear("cave.toml"); },
            [&](const ChildResult& result) {
                if (result.status == 0)
                    EXPECT_EQ(folder.read("cave.toml"), right);
                else
                    EXPECT_FALSE(has("cave.toml"));
                expect_nothing_beside(around);
            });
    EXPECT_GT(met, 8);
}

TEST_F(ExploreFaults, OfTheExplorerLeaveRecordingAndSessionWholeOrNone) {
    int met = 0;
    for (const Fault& fault : file_faults_like(
             {{"open", "EIO"}, {"write", "ENOSPC"}, {"sync", "EIO"}, {"rename", "EIO"}}))
        met += each_call(
            fault, explore_to("w.jsonl"),
            [&] {
                for (const char* name : {"w.jsonl", "w.jsonl.part", "s.isochron-session"})
                    clear(name);
            },
            [&](const ChildResult& result) {
                if (result.status == 0) {
                    EXPECT_TRUE(has("w.jsonl"));
                }
                if (has("w.jsonl")) {
                    const ChildResult replayed =
                        isochron({"replay", "w.jsonl", "--report", "r.json"});
                    EXPECT_EQ(replayed.status, 0) << replayed.err;
                }
                if (has("s.isochron-session")) {
                    EXPECT_TRUE(is_json("s.isochron-session"));
                }
                for (const std::string& name : folder.names())
                    EXPECT_FALSE(name.ends_with(".tmp")) << name;
            });
    EXPECT_GT(met, 3);
}

} // namespace
} // namespace isochron::app
