// Building, appending, referring: what the commands leave behind, and what changes between queries.
#include "command_line.h"

#include <nlohmann/json.hpp>

namespace isochron::app {
namespace {

using testing::HasSubstr;

TEST_F(CommandLine, APatternAndAListOfFilesGiveTheSameBytes) {
    ASSERT_EQ(isochron(build_of("t?.raw")).status, 0);
    const std::string by_pattern = folder.read("a.isochron");
    std::filesystem::remove(folder.path() / "a.isochron");
    ASSERT_EQ(isochron({"build", "t3.raw", "t0.raw", "t4.raw", "t2.raw", "t1.raw", "--type", "f32",
                        "--dims", "14", "11", "9", "--out", "a.isochron"})
                  .status,
              0);
    EXPECT_EQ(folder.read("a.isochron"), by_pattern);
}

TEST_F(CommandLine, QuietPrintsNothing) {
    const ChildResult result = isochron(build_of("t*.raw", {"--quiet"}));
    EXPECT_EQ(result.status, 0);
    EXPECT_EQ(result.out + result.err, "");
}

TEST_F(CommandLine, ChangeWritesWhatTwoSetsDoNotShare) {
    for (const std::string tiers : {"bricks", "cells"}) {
        ASSERT_EQ(isochron(build_of("t*.raw", {"--tiers", tiers})).status, 0);
        for (const auto& [step, isovalue] : {std::pair{3, 0.1}, {2, 0.4}, {4, 0.4}, {2, 9.0}}) {
            const ChildResult result =
                isochron({"change", "a.isochron", "--json", "--step", "2", "--isovalue", "0.1",
                          "--to-step", std::to_string(step), "--to-isovalue",
                          fmt::format("{}", isovalue), "--added", "added", "--removed", "removed"});
            ASSERT_EQ(result.status, 0) << result.err;
            const auto before = active(2, 0.1), after = active(std::size_t(step), isovalue);
            std::vector<std::uint32_t> added, removed;
            std::ranges::set_difference(after, before, std::back_inserter(added));
            std::ranges::set_difference(before, after, std::back_inserter(removed));
            EXPECT_EQ(ids_in("added"), added);
            EXPECT_EQ(ids_in("removed"), removed);
            EXPECT_EQ(nlohmann::json::parse(result.out).at("removed"), removed.size());
        }
    }
    expect_failure(
        isochron({"change", "a.isochron", "--step", "2", "--isovalue", "0", "--to-step", "5"}), 1,
        "step 5, expected 0 to 4");
}

TEST_F(CommandLine, AppendingGivesTheBytesOfBuildingAnew) {
    ASSERT_EQ(isochron(build_of("t*.raw")).status, 0);
    const std::string whole = folder.read("a.isochron");
    for (const std::string first : {"t[01].raw", "t[0123].raw"}) {
        std::filesystem::remove(folder.path() / "a.isochron");
        ASSERT_EQ(isochron(build_of(first)).status, 0);
        EXPECT_NE(folder.read("a.isochron"), whole);
        const ChildResult appended = isochron(build_of("t*.raw", {"--append"}));
        EXPECT_EQ(appended.status, 0) << appended.err;
        EXPECT_EQ(folder.read("a.isochron"), whole);
    }
    const ChildResult again = isochron(build_of("t*.raw", {"--append"}));
    EXPECT_EQ(again.status, 0);
    EXPECT_THAT(again.out, HasSubstr("a.isochron: holds every step of these files already"));
    EXPECT_EQ(folder.read("a.isochron"), whole);
}

TEST_F(CommandLine, AnIndexThatRefersToItsSourcesAnswersAsOneThatCarriesThem) {
    ASSERT_EQ(isochron(build_of("t*.raw", {"--refer"})).status, 0);
    EXPECT_LT(folder.read("a.isochron").size(), kSteps * kX * kY * kZ * 4);
    const std::vector<std::string> query{"query",  "a.isochron", "--isovalue", "0.1",
                                         "--step", "3",          "--ids",      "ids.bin"};
    const auto answer = [&] {
        const ChildResult result = isochron(query);
        EXPECT_EQ(result.status, 0) << result.err;
        return folder.read("ids.bin");
    };
    const std::string referred = answer();
    EXPECT_EQ(isochron({"verify", "a.isochron"}).status, 0);
    // Seen from elsewhere, too.
    EXPECT_EQ(run_child(BINARY_ROOT "/isochron",
                        {"verify", (folder.path() / "a.isochron").string()}, "/", {})
                  .status,
              0);
    std::filesystem::rename(folder.path() / "a.isochron", folder.path() / "b.isochron");
    ASSERT_EQ(isochron(build_of("t*.raw")).status, 0);
    EXPECT_EQ(answer(), referred);
    ASSERT_FALSE(referred.empty());

    std::string changed = folder.read("t3.raw");
    changed[1000] = char(changed[1000] ^ 1);
    folder.write("t3.raw", changed);
    expect_failure(isochron({"query", "b.isochron", "--isovalue", "0.1", "--step", "3"}), 1,
                   "b.isochron: its source t3.raw has changed since it was built (step 3)");
    std::filesystem::remove(folder.path() / "t2.raw");
    expect_failure(isochron({"query", "b.isochron", "--isovalue", "0.1", "--step", "1"}), 1,
                   "t2.raw");
}

TEST_F(CommandLine, AFullDiskDuringABuildLeavesTheOldIndexAlone) {
    ASSERT_EQ(isochron(build_of("t*.raw", {"--lattice", "8"})).status, 0);
    const std::string old = folder.read("a.isochron");
    const auto before = folder.names();
    for (const std::uint64_t limit : {std::uint64_t{6000}, std::uint64_t{30'000}}) {
        const ChildResult result =
            isochron(build_of("t*.raw", {"--quiet"}), {.largest_file = limit});
        expect_failure(result, 1, "a.isochron: cannot be written: File too large");
        EXPECT_EQ(folder.names(), before);
        EXPECT_EQ(folder.read("a.isochron"), old);
    }
}

TEST_F(CommandLine, AnInterruptedBuildEndsWithStatus130AndLeavesTheOldIndexAlone) {
    ASSERT_EQ(isochron(build_of("t*.raw")).status, 0);
    const std::string old = folder.read("a.isochron");
    // Noise has the largest trees: building takes long enough to be interrupted.
    std::mt19937 random(1);
    std::string noise(100 * 100 * 100, '\0');
    for (std::size_t t = 0; t < 6; ++t) {
        for (char& c : noise)
            c = char(random());
        folder.write(fmt::format("noise{}.raw", t), noise);
    }
    const auto before = folder.names();
    const std::vector<std::string> build{"build", "noise*.raw", "--dims", "100", "100",
                                         "100",   "--type",     "u8",     "-o",  "a.isochron"};
    for (const char* phase : {"reading", "counting", "bricks", "indexing"}) {
        const ChildResult result =
            isochron(build, {.interrupt_after = phase}); // as soon as it is printed
        EXPECT_EQ(result.status, 130);
        EXPECT_THAT(result.err, HasSubstr("isochron: cancelled\n"));
        EXPECT_EQ(folder.names(), before);
        EXPECT_EQ(folder.read("a.isochron"), old);
    }
}

} // namespace
} // namespace isochron::app
