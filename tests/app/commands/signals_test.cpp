// Ctrl-C and SIGTERM while a call on a file never returns, as on a disk that stalls: every command ends,
// in whatever phase it is, says so in a line, and leaves no temporary file.
#include "tests/app/commands/faults.h"

namespace isochron::app {
namespace {

class Signals : public Faults {
  protected:
    /// Runs the command on the index of now, with the n-th call of each kind hanging, for some n.
    /// @return how many calls hung
    int end(const std::vector<std::string>& command) {
        const std::string index = folder.read("a.isochron");
        int met = 0;
        for (const char* kind : {"open", "read", "write", "sync", "rename", "size"}) {
            test_support::FaultyCalls calls([](long at) { return 6 * at; });
            for (long at = calls.next();; at = calls.next()) {
                const bool asked = (at + met) % 2 == 0;
                const int signal = asked ? SIGTERM : SIGINT;
                folder.write("a.isochron", index);
                const ChildResult result = with({kind, asked ? "SIGTERM" : "SIGINT"}, at, command);
                if (!was_met())
                    break;
                ++met;
                SCOPED_TRACE(fmt::format("{}: {} {}: status {}, {}", command.front(), kind, at,
                                         result.status, result.err));
                // Without a handler the system ends it; an alarm would be another signal.
                EXPECT_TRUE(result.status == 128 + signal || result.status == 1000 + signal);
                if (result.status == 128 + signal) {
                    EXPECT_THAT(result.err, testing::EndsWith("isochron: canceled\n"));
                }
                for (const std::string& name : folder.names())
                    EXPECT_FALSE(name.ends_with(".tmp")) << name;
                if (folder.read("a.isochron") != index) {
                    EXPECT_EQ(isochron({"verify", "a.isochron"}).status, 0);
                }
            }
        }
        folder.write("a.isochron", index);
        return met;
    }
};

TEST_F(Signals, EndWhatReadsAndWritesAnIndexWhereverACallHangs) {
    ASSERT_EQ(isochron(build_of("t[01].raw")).status, 0);
    EXPECT_GT(end(build_of("t*.raw")), 6);
    EXPECT_GT(end(build_of("t*.raw", {"--append"})), 6);
    EXPECT_GT(end({"verify", "a.isochron"}), 1);
    EXPECT_GT(end({"info", "a.isochron"}), 1);
}

TEST_F(Signals, EndWhatSearchesAnIndexWhereverACallHangs) {
    ASSERT_EQ(isochron(build_of("t*.raw")).status, 0);
    const std::vector<std::string> asked{"a.isochron", "--isovalue", "0.1"};
    const auto with_more = [&](const char* command, const std::vector<std::string>& more) {
        std::vector<std::string> all{command};
        all.insert(all.end(), asked.begin(), asked.end());
        all.insert(all.end(), more.begin(), more.end());
        return all;
    };
    EXPECT_GT(end(with_more("query", {"--step", "2", "--ids", "ids.bin"})), 3);
    EXPECT_GT(end(with_more("change", {"--step", "1", "--to-step", "2", "--added", "added.bin"})),
              3);
    EXPECT_GT(end(with_more("measure", {"--output", "measures.csv"})), 1);
    EXPECT_GT(end(with_more("export", {"--steps", "1", "-o", "surface.ply"})), 2);
}

} // namespace
} // namespace isochron::app
