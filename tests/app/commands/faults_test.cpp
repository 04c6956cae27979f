// Every file call and every allocation of a command made to fail in turn: no crash, no file that opens and is wrong,
// nothing left behind, one line. With ISOCHRON_EVERY_FAULT in the environment all are tried, else some of each kind.
#include "tests/app/commands/command_line.h"

#include <algorithm>
#include <csignal>
#include <cstdlib>
#include <set>

namespace isochron::app {
namespace {

using testing::StartsWith;

class Faults : public CommandLine {
  protected:
    struct Fault {
        std::string kind, how;
    };
    static std::vector<Fault> file_faults() {
        std::vector<Fault> all;
        for (const char* kind : {"open", "read", "write", "sync", "rename", "size"})
            for (const char* how : {"ENOSPC", "EIO"})
                all.push_back({kind, how});
        for (const char* kind : {"read", "write"})
            for (const char* how : {"EINTR", "short"})
                all.push_back({kind, how});
        return all;
    }

    ChildResult with(const Fault& fault, long at, const std::vector<std::string>& arguments) {
        std::filesystem::remove(mark());
        return isochron(
            arguments,
            {.dies_after = 60'000'000,
             .environment = {"LD_PRELOAD=" + test_support::binary_root() + "/libfaulty_calls.so",
                             fmt::format("ISOCHRON_FAULT={}:{}:{}", fault.kind, at, fault.how),
                             "ISOCHRON_FAULT_MARK=" + mark()}});
    }
    bool was_met() const { return std::filesystem::exists(mark()); }
    std::string mark() const { return marks_.path() / "met"; }

    /// Calls `each` with the result of the command for many n, until it makes fewer calls than n.
    /// @return how often the fault was met
    template <class Prepare, class Check>
    int each_call(const Fault& fault, const std::vector<std::string>& arguments, Prepare prepare,
                  Check check) {
        const bool all = std::getenv("ISOCHRON_EVERY_FAULT") != nullptr;
        int met = 0;
        for (long at = 1;; at = all ? at + 1 : at + 1 + at / 2) {
            prepare();
            const ChildResult result = with(fault, at, arguments);
            SCOPED_TRACE(fmt::format("{} {} {}: status {}, {}", fault.kind, at, fault.how,
                                     result.status, result.err));
            if (!was_met()) {
                EXPECT_EQ(result.status, 0);
                return met;
            }
            ++met;
            if (ended_by_a_library(result)) {
                ++library_ends_;
                for (const std::string& name : folder.names())
                    if (name.ends_with(".tmp"))
                        std::filesystem::remove(folder.path() / name);
                check(result);
                continue;
            }
            EXPECT_LT(result.status, 128); // killed by no signal
            if (result.status != 0) {
                EXPECT_THAT(result.err, StartsWith("isochron: "));
                EXPECT_EQ(std::ranges::count(result.err, '\n'), 1);
            }
            // Interrupted and short transfers are no errors: the rest follows.
            if (fault.kind != "new" && (fault.how == "EINTR" || fault.how == "short")) {
                EXPECT_EQ(result.status, 0);
            }
            check(result);
            if (HasFailure())
                return met;
        }
    }

    std::string hash_of(const std::string& index) {
        const ChildResult verified = isochron({"verify", index});
        EXPECT_EQ(verified.status, 0) << verified.err;
        const std::string info = isochron({"info", index, "--json"}).out;
        const std::size_t at = info.find("\"content_hash\"");
        return info.substr(at, info.find('\n', at) - at);
    }
    void copy(const std::string& from, const std::string& to) {
        std::filesystem::copy_file(folder.path() / from, folder.path() / to,
                                   std::filesystem::copy_options::overwrite_existing);
    }

    /// nlohmann's JSON asks for memory when it is destroyed, and ends the program where there is none.
    static bool ended_by_a_library(const ChildResult& result) {
        return result.status == 1000 + SIGABRT && result.err.ends_with("what():  std::bad_alloc\n");
    }
    int library_ends() const { return library_ends_; }

  private:
    TestFolder marks_;
    int library_ends_ = 0;
};

TEST_F(Faults, OfFilesLeaveABuildUndoneOrDone) {
    ASSERT_EQ(isochron(build_of("t0.raw")).status, 0);
    const std::string old = hash_of("a.isochron");
    copy("a.isochron", "old");
    ASSERT_EQ(isochron(build_of("t*.raw")).status, 0);
    const std::string built = hash_of("a.isochron");
    ASSERT_NE(old, built);
    copy("old", "a.isochron");
    const std::vector<std::string> names = folder.names();
    int met = 0;
    for (const Fault& fault : file_faults())
        met += each_call(
            fault, build_of("t*.raw", {"--quiet"}), [&] { copy("old", "a.isochron"); },
            [&](const ChildResult& result) {
                EXPECT_EQ(hash_of("a.isochron"), result.status == 0 ? built : old);
                EXPECT_EQ(folder.names(), names);
            });
    EXPECT_GT(met, 40);
}

TEST_F(Faults, OfFilesLeaveTheOldIndexOrTheAppendedOne) {
    ASSERT_EQ(isochron(build_of("t[012].raw")).status, 0);
    const std::string old = hash_of("a.isochron");
    copy("a.isochron", "old");
    ASSERT_EQ(isochron(build_of("t*.raw", {"--append"})).status, 0);
    const std::string appended = hash_of("a.isochron");
    ASSERT_NE(old, appended);
    const std::vector<std::string> names = folder.names();
    int met = 0;
    for (const Fault& fault : file_faults())
        met += each_call(
            fault, build_of("t*.raw", {"--append", "--quiet"}), [&] { copy("old", "a.isochron"); },
            [&](const ChildResult& result) {
                const std::string now = hash_of("a.isochron");
                // A flush that fails after the new header was written may leave either.
                EXPECT_TRUE(now == appended || (result.status != 0 && now == old)) << now;
                EXPECT_EQ(folder.names(), names);
            });
    EXPECT_GT(met, 30);
}

TEST_F(Faults, OfFilesGiveAQueryTheRightIdsOrNone) {
    ASSERT_EQ(isochron(build_of("t*.raw")).status, 0);
    const std::vector<std::uint32_t> expected = active(2, 0.1);
    int met = 0;
    for (const Fault& fault : file_faults())
        met += each_call(
            fault,
            {"query", "a.isochron", "--isovalue", "0.1", "--step", "2", "--repeat", "0", "--ids",
             "ids.bin"},
            [&] { std::filesystem::remove(folder.path() / "ids.bin"); },
            [&](const ChildResult& result) {
                if (result.status == 0)
                    EXPECT_EQ(ids_in("ids.bin"), expected);
                else
                    EXPECT_FALSE(std::filesystem::exists(folder.path() / "ids.bin"));
            });
    EXPECT_GT(met, 20);
}

TEST_F(Faults, OfMemoryLeaveBuildAppendAndQueryUndoneOrDone) {
    ASSERT_EQ(isochron(build_of("t[012].raw")).status, 0);
    const std::string old = hash_of("a.isochron");
    copy("a.isochron", "old");
    ASSERT_EQ(isochron(build_of("t*.raw")).status, 0);
    const std::string built = hash_of("a.isochron");
    copy("old", "a.isochron");
    const std::vector<std::string> names = folder.names();
    const Fault once{"new", "short"};
    int met = 0;
    for (const std::vector<std::string>& more :
         {std::vector<std::string>{"--quiet"}, {"--quiet", "--append"}})
        met += each_call(
            once, build_of("t*.raw", more), [&] { copy("old", "a.isochron"); },
            [&](const ChildResult& result) {
                const std::string now = hash_of("a.isochron");
                EXPECT_TRUE(now == built || (result.status != 0 && now == old)) << now;
                EXPECT_EQ(folder.names(), names);
            });
    met += each_call(
        once, {"query", "a.isochron", "--isovalue", "0.1", "--step", "2", "--repeat", "0"}, [] {},
        [](const ChildResult&) {});
    EXPECT_GT(met, 30);
    EXPECT_LE(library_ends(), met / 15);
}

} // namespace
} // namespace isochron::app
