// What a loss of power may leave: a file gets its name only after all its bytes were flushed, so
// under that name lies the old one or the whole new one. (Appending, which writes in place, is
// tested with every order of its writes: index_append_test.)
#include "tests/app/commands/faults.h"
#include "tests/support/virtual_display.h"

#include <map>
#include <sstream>

namespace isochron::app {
namespace {

class PowerLoss : public Faults {
  protected:
    PowerLoss() {
        keep_state_here();
        folder.write("cave.pvx", "<pvx><Process Type=\"client\"/><Process Type=\"server\">"
                                 "<Machine Name=\"a\" Environment=\"DISPLAY=:0\" "
                                 "LowerLeft=\"-1 -1 -1\" LowerRight=\"1 -1 -1\" "
                                 "UpperRight=\"1 1 -1\"/></Process></pvx>");
    }

    static std::vector<std::string> exported(const std::string& to,
                                             const std::vector<std::string>& more = {}) {
        std::vector<std::string> all{"export", "a.isochron", "--isovalue", "0.1", "-o", to};
        all.insert(all.end(), more.begin(), more.end());
        return all;
    }

    /// Runs the command. @return the files that it gave their names, and complaints
    std::vector<std::string> named_by(const std::vector<std::string>& command,
                                      std::vector<std::string>& unflushed) {
        const std::string log = log_.path() / "log";
        std::filesystem::remove(log);
        const ChildResult result = isochron(
            command,
            {.environment = {"LD_PRELOAD=" + test_support::binary_root() + "/libfaulty_calls.so",
                             "ISOCHRON_CALL_LOG=" + log}});
        EXPECT_EQ(result.status, 0) << result.err;
        std::map<std::string, std::string> path_of;    // by the file's number
        std::map<std::string, bool> changed_and_whole; // by path: whether flushed since
        std::vector<std::string> named;
        std::istringstream lines(log_.read("log"));
        for (std::string kind, first, second; lines >> kind >> first;) {
            if (kind == "open") {
                lines >> second;
                path_of[first] = second;
                changed_and_whole[second] = false;
            } else if (kind == "write" || kind == "size") {
                changed_and_whole[path_of[first]] = false;
            } else if (kind == "sync") {
                changed_and_whole[path_of[first]] = true;
            } else if (kind == "rename") {
                lines >> second;
                named.push_back(second);
                const auto file = changed_and_whole.find(first);
                if (file != changed_and_whole.end() && !file->second)
                    unflushed.push_back(first + " -> " + second);
            }
        }
        return named;
    }

    TestFolder log_;
    test_support::VirtualDisplay screen_;
};

TEST_F(PowerLoss, NothingGetsItsNameBeforeItIsFlushed) {
    struct Run {
        std::vector<std::string> command;
        std::size_t files; ///< that get their names, at least
    };
    const std::vector<Run> runs{
        {build_of("t[01].raw"), 1},
        {{"query", "a.isochron", "--isovalue", "0.1", "--step", "1", "--ids", "ids.bin"}, 1},
        {{"change", "a.isochron", "--isovalue", "0.1", "--step", "0", "--to-step", "1", "--added",
          "added.bin", "--removed", "removed.bin"},
         2},
        {build_of("t[0-2].raw", {"--append"}), 0}, // in place: index_append_test has its order
        {exported("a.ply"), 1},
        {exported("a.stl"), 1},
        {exported("a.obj"), 1},
        {exported("a.vtp"), 1},
        {exported("a.glb"), 1},
        {exported("a.usda"), 1},
        {exported("a.csv"), 1},
        {exported("all.vtp", {"--steps", "0:1"}), 3}, // two steps and their .pvd
        {{"generate", "sphere", "--steps", "2", "--out", "g"}, 3},
        {{"manual", "pages"}, 2},
        {{"config", "import", "cave.pvx", "-o", "cave.toml"}, 1},
        {{"explore", "a.isochron", "--size", "96", "64", "--seconds", "0.1", "--record",
          "walk.jsonl", "--session", "s.isochron-session", "--report", "r.json"},
         3},
        {{"replay", "walk.jsonl", "--every", "2", "--out", "shots", "--report", "r.json"}, 2},
        {{"table", "walk.jsonl", "-o", "walk.csv"}, 1},
        {{"table", "walk.jsonl", "--json", "-o", "walk.json"}, 1},
        {{"movie", "walk.jsonl", "-o", "frames", "--rate", "10", "--size", "96", "64"}, 2},
        {{"movie", "walk.jsonl", "-o", "walk.gif", "--rate", "10", "--size", "96", "64"}, 1}};
    for (const Run& run : runs) {
        SCOPED_TRACE(run.command.front());
        std::vector<std::string> unflushed;
        EXPECT_GE(named_by(run.command, unflushed).size(), run.files);
        EXPECT_EQ(unflushed, std::vector<std::string>());
        if (run.command.front() == "explore")
            make_twelve_frames("walk.jsonl");
    }
}

} // namespace
} // namespace isochron::app
