// Building, appending and referring: the files that the commands leave, and changes between
// queries.
#include "index/volume/volume_series.h"
#include "tests/app/commands/command_line.h"
#include "tests/support/index_repair.h"
#include "tests/support/paths.h"

#include <nlohmann/json.hpp>

#include <chrono>
#include <span>

namespace isochron::app {
namespace {

using testing::HasSubstr;

TEST_F(CommandLine, APatternAndAListOfFilesGiveTheSameBytes) {
    ASSERT_EQ(isochron(build_of("t?.raw")).status, 0);
    const std::string by_pattern = folder.read("a.isochron");
    std::filesystem::remove(folder.path() / "a.isochron");
    ASSERT_EQ(
        isochron(as_words("build t3.raw t0.raw t4.raw t2.raw t1.raw --type f32 --dims 14 11 9 "
                          "--out a.isochron"))
            .status,
        0);
    EXPECT_EQ(folder.read("a.isochron"), by_pattern);
}

TEST_F(CommandLine, AppendingSaysThatFilesWereReadOtherwise) {
    ASSERT_EQ(isochron(build_of("t[0-2].raw")).status, 0);
    std::string index = folder.read("a.isochron");
    const std::string key = "\"reading_number\":";
    char& number = index[index.rfind(key) + key.size()];
    ASSERT_EQ(number--, static_cast<char>('0' + index::kReading));
    index::repair_checksums(std::as_writable_bytes(std::span(index)));
    folder.write("a.isochron", index);
    const ChildResult first = isochron(build_of("t*.raw", {"--append"}));
    ASSERT_EQ(first.status, 0) << first.err;
    EXPECT_THAT(first.err, HasSubstr(fmt::format(
                               "built with reading {} of the files, this program has {}: the "
                               "sources of its 3 steps were read again, and are the same",
                               index::kReading - 1, index::kReading)));
    const ChildResult again = isochron(build_of("t*.raw", {"--append"}));
    EXPECT_EQ(again.status, 0);
    EXPECT_THAT(again.err, testing::Not(HasSubstr("read again")));
}

TEST_F(CommandLine, QuietPrintsNothing) {
    const ChildResult result = isochron(build_of("t*.raw", {"--quiet"}));
    EXPECT_EQ(result.status, 0);
    EXPECT_EQ(result.out + result.err, "");
}

TEST_F(CommandLine, ChangeWritesWhatTwoSetsDoNotShare) {
    for (const std::string tiers : {"bricks", "none"}) {
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
    expect_failure(isochron(as_words("change a.isochron --step 2 --isovalue 0 --to-step 5")), 1,
                   "step 5, expected 0 to 4");
}

/// What an index says of its data, less where it lies and how large it is.
nlohmann::json description(const std::string& info) {
    auto j = nlohmann::json::parse(info);
    for (const char* key : {"file", "file_bytes", "volume_bytes", "percent_of_raw", "plan"})
        j.erase(key);
    return j;
}

TEST_F(CommandLine, AppendingGivesTheContentOfBuildingAnew) {
    const auto described = [&] {
        return description(isochron({"info", "a.isochron", "--json"}).out);
    };
    ASSERT_EQ(isochron(build_of("t*.raw")).status, 0);
    const auto whole = described();
    for (const std::string first : {"t[01].raw", "t[0123].raw"}) {
        std::filesystem::remove(folder.path() / "a.isochron");
        ASSERT_EQ(isochron(build_of(first)).status, 0);
        EXPECT_NE(described(), whole);
        const std::string held = folder.read("a.isochron");
        const ChildResult appended = isochron(build_of("t*.raw", {"--append"}));
        EXPECT_EQ(appended.status, 0) << appended.err;
        EXPECT_EQ(described(), whole);
        EXPECT_EQ(isochron({"verify", "a.isochron"}).status, 0);
        // What it held is where it was.
        EXPECT_EQ(folder.read("a.isochron").substr(8192, held.size() - 8192), held.substr(8192));
    }
    const std::string bytes = folder.read("a.isochron");
    const ChildResult again = isochron(build_of("t*.raw", {"--append"}));
    EXPECT_EQ(again.status, 0);
    EXPECT_THAT(again.out, HasSubstr("a.isochron: holds every step of these files already"));
    EXPECT_EQ(folder.read("a.isochron"), bytes);
}

TEST_F(CommandLine, AppendingKeepsWhatTheIndexWasBuiltWith) {
    const auto described = [&] {
        return description(isochron({"info", "a.isochron", "--json"}).out);
    };
    for (const std::vector<std::string>& options :
         {std::vector<std::string>{"--tiers", "bricks", "--codec", "none"},
          {"--refer"},
          {"--lattice", "16", "--codec", "lz4"}}) {
        ASSERT_EQ(isochron(build_of("t*.raw", options)).status, 0);
        const auto whole = described();
        std::filesystem::remove(folder.path() / "a.isochron");
        ASSERT_EQ(isochron(build_of("t[01].raw", options)).status, 0);
        const ChildResult appended = isochron(build_of("t*.raw", {"--append"}));
        EXPECT_EQ(appended.status, 0) << appended.err;
        EXPECT_EQ(described(), whole) << options.front();
        EXPECT_EQ(isochron({"verify", "a.isochron"}).status, 0);
        const bool anew = options.front() == "--lattice";
        EXPECT_EQ(appended.err.find("written anew: the paper's tree spans all steps") !=
                      std::string::npos,
                  anew);
        std::filesystem::remove(folder.path() / "a.isochron");
    }
}

TEST_F(CommandLine, AppendingReadsFilesAsTheFirstOnesWereRead) {
    const auto described = [&] {
        return description(isochron({"info", "a.isochron", "--json"}).out);
    };
    const std::vector<std::string> options =
        as_words("--spacing 1 2 0.5 --origin 3 0 -1 --length-unit mm --time-step 0.25");
    ASSERT_EQ(isochron(build_of("t*.raw", options)).status, 0);
    const auto whole = described();
    std::filesystem::remove(folder.path() / "a.isochron");
    ASSERT_EQ(isochron(build_of("t[01].raw", options)).status, 0);
    for (const char* files : {"t[0123].raw", "t*.raw"}) { // what was filled in is kept, too
        const ChildResult appended = isochron({"build", files, "-o", "a.isochron", "--append"});
        ASSERT_EQ(appended.status, 0) << appended.err;
    }
    EXPECT_EQ(described(), whole);
    expect_failure(isochron(as_words("build t*.raw -o a.isochron --append --type u8")), 1,
                   "a.isochron: cannot be appended to: the files differ from it in grid, type");
}

TEST_F(CommandLine, AppendingSaysWhereItIsToldOtherwise) {
    for (const auto& [options, told] : {std::pair<std::vector<std::string>, std::string>{
                                            {"--tiers", "none"}, "tiers none instead of bricks"},
                                        {{"--codec", "zstd"}, "codec zstd instead of fitting"},
                                        {{"--refer"}, "it refers to its files from now on"}}) {
        ASSERT_EQ(isochron(build_of("t[01].raw")).status, 0);
        std::vector<std::string> more = options;
        more.push_back("--append");
        const ChildResult appended = isochron(build_of("t*.raw", more));
        EXPECT_EQ(appended.status, 0) << appended.err;
        EXPECT_THAT(appended.err, HasSubstr("isochron: note: written anew: " + told));
        EXPECT_EQ(isochron({"verify", "a.isochron"}).status, 0);
        std::filesystem::remove(folder.path() / "a.isochron");
    }
}

TEST_F(CommandLine, ASourceThatWasTouchedIsReadAgainAndOneThatHasChangedIsRefused) {
    ASSERT_EQ(isochron(build_of("t[0123].raw")).status, 0);
    const std::string held = folder.read("a.isochron");
    folder.write("t1.raw", folder.read("t1.raw")); // only its time is new
    ASSERT_EQ(isochron(build_of("t*.raw", {"--append"})).status, 0);
    folder.write("a.isochron", held);
    std::string changed = folder.read("t1.raw");
    changed[100] = char(changed[100] ^ 1);
    folder.write("t1.raw", changed);
    expect_failure(isochron(build_of("t*.raw", {"--append"})), 1,
                   "a.isochron: cannot be appended to: its source t1.raw has changed under step 1");
    EXPECT_EQ(folder.read("a.isochron"), held);
}

TEST_F(CommandLine, AnIndexThatRefersToItsSourcesAnswersAsOneThatCarriesThem) {
    ASSERT_EQ(isochron(build_of("t*.raw", {"--refer"})).status, 0);
    EXPECT_LT(folder.read("a.isochron").size(), kSteps * kX * kY * kZ * 4);
    const std::vector<std::string> query =
        as_words("query a.isochron --isovalue 0.1 --step 3 --ids ids.bin");
    const auto answer = [&] {
        const ChildResult result = isochron(query);
        EXPECT_EQ(result.status, 0) << result.err;
        return folder.read("ids.bin");
    };
    const std::string referred = answer();
    EXPECT_EQ(isochron({"verify", "a.isochron"}).status, 0);
    // Seen from elsewhere, too.
    EXPECT_EQ(run_child(test_support::binary_root() + "/isochron",
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
    expect_failure(isochron(as_words("query b.isochron --isovalue 0.1 --step 3")), 1,
                   "b.isochron: its source t3.raw has changed since it was built (step 3)");
    std::filesystem::remove(folder.path() / "t2.raw");
    expect_failure(isochron(as_words("query b.isochron --isovalue 0.1 --step 1")), 1, "t2.raw");
}

TEST_F(CommandLine, AnIndexRefersToWhatIsResampledAndConverted) {
    std::string points, values;
    for (int k = 0; k < 4; ++k)
        for (int j = 0; j < 5; ++j)
            for (int i = 0; i < 6; ++i) {
                points += fmt::format("{} {} {}\n", i + 0.1 * j, j, k);
                values += fmt::format("{}\n", i + j + k);
            }
    folder.write("curved.vtk",
                 "# vtk DataFile Version 3.0\nc\nASCII\nDATASET STRUCTURED_GRID\nDIMENSIONS 6 5 4\n"
                 "POINTS 120 float\n" +
                     points + "POINT_DATA 120\nSCALARS s float 1\nLOOKUP_TABLE default\n" + values);
    const auto answer = [&](const std::vector<std::string>& more) {
        std::vector<std::string> build =
            as_words("build curved.vtk -o a.isochron --resample 7 8 9");
        build.insert(build.end(), more.begin(), more.end());
        EXPECT_EQ(isochron(build).status, 0);
        EXPECT_EQ(isochron({"verify", "a.isochron"}).err, "");
        EXPECT_EQ(
            isochron(as_words("query a.isochron --isovalue 4.5 --step 0 --ids ids.bin")).status, 0);
        return folder.read("ids.bin");
    };
    const std::string carried = answer({});
    ASSERT_FALSE(carried.empty());
    EXPECT_EQ(answer({"--refer"}), carried);
    EXPECT_EQ(answer({"--refer", "--type", "f64"}), carried);
}

TEST_F(CommandLine, AnIndexRefersToNamesThatAreNoText) {
    const std::string name = "t\xff\xfe 1.raw"; // bytes that are not UTF-8
    std::filesystem::rename(folder.path() / "t1.raw", folder.path() / name);
    ASSERT_EQ(isochron(build_of(name, {"--refer"})).status, 0);
    const ChildResult verified = isochron({"verify", "a.isochron"});
    EXPECT_EQ(verified.status, 0) << verified.err;
    ASSERT_EQ(isochron(build_of(name)).status, 0);
    std::filesystem::copy(folder.path() / "t2.raw", folder.path() / "t\xff\xfe 2.raw");
    const ChildResult appended = isochron(build_of("t\xff*.raw", {"--append"}));
    EXPECT_EQ(appended.status, 0) << appended.err;
    EXPECT_TRUE(nlohmann::json::accept(isochron({"info", "a.isochron", "--json"}).out));
    std::filesystem::rename(folder.path() / "a.isochron", folder.path() / "\xff.isochron");
    const ChildResult changes = isochron({"change", "\xff.isochron", "--json", "--step", "0",
                                          "--isovalue", "0", "--to-isovalue", "0.1"});
    EXPECT_EQ(changes.status, 0) << changes.err;
    EXPECT_TRUE(nlohmann::json::accept(changes.out));
}

TEST_F(CommandLine, DataThatAreLeftOverAreAllowedWhereTheUserSaysSo) {
    const std::string header = "NRRD0004\ntype: uchar\ndimension: 3\nsizes: 2 2 2\n"
                               "encoding: raw\n\n";
    folder.write("more.nrrd", header + "12345678" + "abc");
    expect_failure(isochron({"build", "more.nrrd", "-o", "a.isochron"}), 1,
                   "more.nrrd: 3 bytes follow the values of the 1 step that the header has");
    EXPECT_FALSE(std::filesystem::exists(folder.path() / "a.isochron"));
    for (const char* how : {"--quiet", "--refer"}) {
        ASSERT_EQ(
            isochron({"build", "more.nrrd", "-o", "a.isochron", "--allow-surplus", how}).status, 0);
        const ChildResult verified = isochron({"verify", "a.isochron"});
        EXPECT_EQ(verified.status, 0) << verified.err;
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
    const std::vector<std::string> build =
        as_words("build noise*.raw --dims 100 100 100 --type u8 -o a.isochron --lattice 64");
    for (const char* phase : {"reading", "dividing span space"}) {
        const ChildResult result =
            isochron(build, {.interrupt_after = phase}); // as soon as it is printed
        EXPECT_EQ(result.status, 130);
        EXPECT_THAT(result.err, HasSubstr("isochron: canceled\n"));
        EXPECT_EQ(folder.names(), before);
        EXPECT_EQ(folder.read("a.isochron"), old);
    }
}

/// Steps of two arrays, `speed` and `heat`, as ascii legacy files `s0.vtk` ...
void write_two_arrays(const test_support::TestFolder& folder, int steps) {
    for (int t = 0; t < steps; ++t) {
        std::string text = "# vtk DataFile Version 3.0\ntwo arrays\nASCII\n"
                           "DATASET STRUCTURED_POINTS\nDIMENSIONS 6 5 4\nORIGIN 0 0 0\n"
                           "SPACING 1 1 1\nPOINT_DATA 120\n";
        for (const auto& [name, factor] : {std::pair{"speed", 1}, {"heat", -3}}) {
            text += fmt::format("SCALARS {} float 1\nLOOKUP_TABLE default\n", name);
            for (int i = 0; i < 120; ++i)
                text += fmt::format("{}\n", factor * (i % 7 + t));
        }
        folder.write(fmt::format("s{}.vtk", t), text);
    }
}

TEST_F(CommandLine, ColorCarriesASecondArrayThatInfoShowsAndVerifyChecks) {
    write_two_arrays(folder, 3);
    for (const bool refer : {false, true}) {
        std::vector<std::string> build =
            as_words("build s?.vtk --array speed --color heat -o c.isochron --color-unit K");
        if (refer)
            build.push_back("--refer");
        const ChildResult built = isochron(build);
        ASSERT_EQ(built.status, 0) << built.err;
        const auto info = nlohmann::json::parse(isochron({"info", "c.isochron", "--json"}).out);
        EXPECT_EQ(info.at("array"), "speed");
        EXPECT_EQ(info.at("color").at("array"), "heat");
        EXPECT_EQ(info.at("color").at("value_unit"), "K");
        EXPECT_EQ(info.at("color").at("low"), -24);
        EXPECT_EQ(info.at("color").at("high"), 0);
        EXPECT_EQ(isochron({"verify", "c.isochron"}).status, 0);
        EXPECT_THAT(isochron({"info", "c.isochron"}).out, HasSubstr("heat, f32, -24 to 0 K"));
    }
    // Where an index refers to its files, verify reads the colors there.
    std::string changed = folder.read("s1.vtk");
    changed.replace(changed.rfind("-3"), 2, "-4");
    folder.write("s1.vtk", changed);
    expect_failure(isochron({"verify", "c.isochron"}), 1, "s1.vtk has changed");
}

TEST_F(CommandLine, FlagsInTheirOldSpellingDoTheSame) {
    write_two_arrays(folder, 2);
    const std::vector<std::string> now = as_words(
        "build s?.vtk --array speed --color heat --color-component 0 --color-unit K -o c.isochron");
    ASSERT_EQ(isochron(now).status, 0);
    const std::string whole = folder.read("c.isochron");
    std::vector<std::string> old = now;
    for (const std::string flag : {"--color", "--color-component", "--color-unit"})
        std::ranges::replace(old, flag, "--colour" + flag.substr(7));
    std::filesystem::remove(folder.path() / "c.isochron");
    const ChildResult result = isochron(old);
    EXPECT_EQ(result.status, 0) << result.err;
    EXPECT_EQ(folder.read("c.isochron"), whole);
}

TEST_F(CommandLine, ColorsAreAppendedWithTheRest) {
    write_two_arrays(folder, 4);
    const auto build = [&](const std::string& files, const std::vector<std::string>& more) {
        std::vector<std::string> all{"build", files, "--array", "speed", "-o", "c.isochron"};
        all.insert(all.end(), more.begin(), more.end());
        return isochron(all);
    };
    ASSERT_EQ(build("s?.vtk", {"--color", "heat"}).status, 0);
    const auto described = [&] {
        return description(isochron({"info", "c.isochron", "--json"}).out);
    };
    const auto whole = described();
    std::filesystem::remove(folder.path() / "c.isochron");
    ASSERT_EQ(build("s[01].vtk", {"--color", "heat"}).status, 0);
    expect_failure(build("s?.vtk", {"--append", "--color", "speed"}), 1,
                   "it holds the colors heat, the colors speed given");
    const ChildResult appended = build("s?.vtk", {"--append"});
    EXPECT_EQ(appended.status, 0) << appended.err;
    EXPECT_EQ(described(), whole);
    EXPECT_EQ(isochron({"verify", "c.isochron"}).status, 0);
    expect_failure(build("s?.vtk", {"--color", "cold"}), 1, "cold");
}

} // namespace
} // namespace isochron::app
