// The commands as a user runs them: their output, their exit status, and the files that they leave.
#include "app/indexing/open_index.h"
#include "index/error.h"
#include "interaction/recording/recording.h"
#include "tests/app/commands/command_line.h"
#include "tests/support/huge_index.h"
#include "tests/support/paths.h"

#include <nlohmann/json.hpp>

#include <sys/stat.h>

namespace isochron::app {
namespace {

using testing::HasSubstr;

TEST_F(CommandLine, QueryWritesTheActiveCellsByEveryMethod) {
    const ChildResult built =
        isochron(build_of("t*.raw", {"--tiers", "bricks", "--lattice", "16"}));
    ASSERT_EQ(built.status, 0) << built.err;
    EXPECT_THAT(built.out, HasSubstr("14 x 11 x 9 vertices, 5 steps, f32"));
    for (const std::size_t step : {0, 3})
        for (const double isovalue : {0.1, double(steps[step][500]), 5.0})
            for (const std::string method : {"", "bricks", "tree", "scan"}) {
                std::vector<std::string> query = as_words(
                    fmt::format("query a.isochron --json --repeat 1 --ids ids.bin --isovalue "
                                "{} --step {}",
                                isovalue, step));
                if (!method.empty())
                    query.insert(query.end(), {"--method", method});
                const ChildResult result = isochron(query);
                ASSERT_EQ(result.status, 0) << result.err;
                const auto expected = active(step, isovalue);
                EXPECT_EQ(ids_in("ids.bin"), expected) << "none for one out of range";
                const auto json = nlohmann::json::parse(result.out);
                EXPECT_EQ(json.at("active_cells"), expected.size());
                EXPECT_EQ(json.at("method"), method.empty() ? "bricks" : method);
                EXPECT_EQ(json.at("repeated_method"), method.empty() ? "bricks" : method);
                EXPECT_EQ(json.at("candidates").get<std::size_t>(),
                          expected.size() + json.at("false_positives").get<std::size_t>());
                for (const char* key :
                     {"cold_search_ms", "cold_shading_ms", "search_ms", "shading_ms"})
                    EXPECT_GE(json.at(key).get<double>(), 0) << key;
            }
}

TEST_F(CommandLine, TiersOfEarlierVersionsAreTakenWithANote) {
    const ChildResult built = isochron(build_of("t[0-2].raw", {"--tiers", "bricks,cells,deltas"}));
    EXPECT_EQ(built.status, 0);
    EXPECT_THAT(built.err, HasSubstr("isochron: --tiers bricks,cells,deltas: cells is no longer "
                                     "built; bricks take its place\n"));
    const ChildResult appended =
        isochron(build_of("t*.raw", {"--append", "--tiers", "bricks,cells"}));
    EXPECT_EQ(appended.status, 0);
    EXPECT_THAT(appended.out, testing::Not(HasSubstr("written anew")));
    const ChildResult found = isochron(
        {"query", "a.isochron", "--isovalue", "0.1", "--step", "1", "--method", "cells", "--json"});
    EXPECT_EQ(found.status, 0);
    EXPECT_EQ(found.err, "isochron: --method cells: no longer there; searched by bricks\n");
    const auto json = nlohmann::json::parse(found.out);
    EXPECT_EQ(json.at("method"), "bricks");
    EXPECT_EQ(json.at("active_cells"), active(1, 0.1).size());
}

TEST_F(CommandLine, AnIndexWithNothingButFormerTiersIsScannedAndSaysSo) {
    std::filesystem::copy_file(test_support::test_data() + "/old/former_alone.isochron",
                               folder.path() / "old.isochron");
    const ChildResult found =
        isochron(as_words("query old.isochron --isovalue 100 --step 1 --json"));
    EXPECT_EQ(found.status, 0);
    EXPECT_EQ(
        found.err,
        "isochron: old.isochron: the search structures that it holds are no longer used, so "
        "each search scans a whole step; isochron build old.isochron -o NEW.isochron gives it "
        "bricks\n");
    EXPECT_EQ(nlohmann::json::parse(found.out).at("method"), "scan");
    const ChildResult told = isochron({"info", "old.isochron", "--json"});
    EXPECT_GT(nlohmann::json::parse(told.out).at("unused_bytes"), 1000);
    EXPECT_EQ(isochron({"build", "old.isochron", "-o", "new.isochron"}).status, 0);
    const ChildResult anew =
        isochron(as_words("query new.isochron --isovalue 100 --step 1 --json"));
    EXPECT_EQ(anew.err, "");
    EXPECT_EQ(nlohmann::json::parse(anew.out).at("active_cells"),
              nlohmann::json::parse(found.out).at("active_cells"));
}

TEST_F(CommandLine, InfoTellsWhatWasBuilt) {
    ASSERT_EQ(
        isochron(build_of("t*.raw", {"--spacing", "0.5", "1", "2", "--origin", "-1", "0", "3",
                                     "--time-step", "0.25", "--length-unit", "mm", "--time-unit",
                                     "ms", "--value-unit", "K", "--lattice", "64"}))
            .status,
        0);
    const ChildResult result = isochron({"info", "a.isochron", "--json", "--tree"});
    ASSERT_EQ(result.status, 0) << result.err;
    const auto json = nlohmann::json::parse(result.out);
    EXPECT_EQ(json.at("vertices"), nlohmann::json({14, 11, 9}));
    EXPECT_EQ(json.at("cells"), nlohmann::json({13, 10, 8}));
    EXPECT_EQ(json.at("spacing"), nlohmann::json({0.5, 1.0, 2.0}));
    EXPECT_EQ(json.at("origin"), nlohmann::json({-1.0, 0.0, 3.0}));
    EXPECT_EQ(json.at("physical_size"), nlohmann::json({6.5, 10.0, 16.0}));
    EXPECT_EQ(json.at("times"), nlohmann::json({0.0, 0.25, 0.5, 0.75, 1.0}));
    EXPECT_EQ(json.at("uniform_time"), true);
    EXPECT_EQ(json.at("handedness"), "right");
    EXPECT_EQ(json.at("length_unit"), "mm");
    EXPECT_EQ(json.at("time_unit"), "ms");
    EXPECT_EQ(json.at("value_unit"), "K");
    EXPECT_EQ(json.at("type"), "f32");
    EXPECT_EQ(json.at("nan_values"), 0);
    EXPECT_EQ(json.at("tiers"), nlohmann::json({"bricks", "tree"}));
    EXPECT_EQ(json.at("lossless"), false);
    EXPECT_EQ(json.at("raw_bytes"), 5.0 * 13 * 10 * 8 * 24);
    std::uint64_t entries = 0;
    for (const auto& node : json.at("tree"))
        entries += node.at("cells").get<std::uint64_t>();
    EXPECT_EQ(json.at("tree_entries"), entries);
    EXPECT_DOUBLE_EQ(json.at("coherence"), double(entries) / (5 * 13 * 10 * 8));
    EXPECT_EQ(json.at("tree").at(0).at("last_step"), 4);

    const ChildResult text = isochron({"info", "a.isochron", "--tree"});
    for (const char* part : {"0.5 x 1 x 2 mm", "6.5 x 10 x 16 mm", "times 0 to 1 ms, uniform",
                             "handedness    right", " K\n", "[0,4] ", "\n  [0,3] "})
        EXPECT_THAT(text.out, HasSubstr(part));
}

TEST_F(CommandLine, AnIsovalueBeyondTheDataIsToldWithTheirRange) {
    ASSERT_EQ(isochron(build_of("t*.raw")).status, 0);
    const ChildResult beyond =
        isochron(as_words("query a.isochron --isovalue 50 --step 0 --repeat 0"));
    EXPECT_EQ(beyond.status, 0);
    EXPECT_THAT(beyond.err, HasSubstr("isochron: isovalue 50 lies beyond the data, -"));
    EXPECT_EQ(isochron(as_words("query a.isochron --isovalue 0 --step 0 --repeat 0")).err, "");
    const auto change = [&](const std::string& from, const std::string& to) {
        return isochron(
                   {"change", "a.isochron", "--isovalue", from, "--step", "0", "--to-isovalue", to})
            .err;
    };
    EXPECT_THAT(change("0", "50"), HasSubstr("isochron: isovalue 50 lies beyond the data, -"));
    EXPECT_THAT(change("-50", "0"), HasSubstr("isochron: isovalue -50 lies beyond the data, -"));
    EXPECT_EQ(change("0", "0.5"), "");
}

/// Whatever takes a number says the same where it is not finite, before anything else is wrong.
TEST_F(CommandLine, NumbersThatAreNotFiniteAreRefusedInOneLineByEveryOption) {
    std::array<std::string, 3> numbers{"nan", "inf", "1e999"}; // each command gets one of them
    for (const std::string command : {"query --isovalue N",
                                      "change --isovalue N",
                                      "change --to-isovalue N",
                                      "export --isovalue N",
                                      "export --color-range N N",
                                      "export --clip N N N N N N",
                                      "export --rate N",
                                      "measure --isovalue N",
                                      "movie --isovalue N",
                                      "movie --rate N",
                                      "movie --dpi N",
                                      "explore --isovalue N",
                                      "explore --seconds N",
                                      "explore --patience N",
                                      "build --spacing N N N",
                                      "build --origin N N N",
                                      "build --time-step N",
                                      "build --timeout N",
                                      "info --spacing N N N",
                                      "config import --unit N",
                                      "config import --origin N N N"}) {
        std::rotate(numbers.begin(), numbers.begin() + 1, numbers.end());
        std::vector<std::string> all = as_words(command);
        std::ranges::replace(all, "N", numbers[0]);
        expect_failure(isochron(all), 2,
                       as_words(command.substr(command.find("--")))[0] +
                           ": expected a finite number, got " + numbers[0]);
    }
}

TEST_F(CommandLine, WhereNoFileCanBeTheErrorSaysThatTheFolderTakesNone) {
    ASSERT_EQ(isochron(build_of("t*.raw")).status, 0);
    std::vector<std::string> build = build_of("t*.raw");
    build.back() = "/proc/a.isochron";
    for (const auto& [arguments, message] :
         std::vector<std::pair<std::vector<std::string>, std::string>>{
             {build, "/proc/a.isochron: cannot be written: its folder takes nothing new"},
             {{"query", "a.isochron", "--isovalue", "0", "--step", "0", "--ids", "/proc/ids.bin"},
              "/proc/ids.bin: cannot be written: its folder takes nothing new"},
             {{"generate", "sphere", "--out", "/proc/no"}, "/proc/no: cannot be made: its folder"},
             {{"explore", "a.isochron", "--record", "/proc/walk.jsonl"},
              "/proc/walk.jsonl: cannot be written: its folder"},
             {{"explore", "a.isochron", "--session", "/proc/no/a.isochron-session"},
              "/proc/no: cannot be made: its folder"},
             {{"explore", "a.isochron", "--screenshots", "/proc/no"},
              "/proc/no: cannot be made: its folder"}})
        expect_failure(isochron(arguments), 1, message);
}

TEST_F(CommandLine, WhatIsNoRecordingIsToldAsSuch) {
    ASSERT_EQ(isochron(build_of("t*.raw")).status, 0);
    const std::string message = ": not a recording, which `isochron explore --record`";
    expect_failure(isochron({"replay", "a.isochron"}), 1, "a.isochron" + message);
    expect_failure(isochron({"movie", "t0.raw", "-o", "a.mp4"}), 1, "t0.raw" + message);
}

TEST_F(CommandLine, TimesAreTextWithoutTheDigitsOfRounding) {
    ASSERT_EQ(isochron(build_of("t*.raw", {"--time-step", "0.1", "--time-unit", "s"})).status, 0);
    const ChildResult query =
        isochron(as_words("query a.isochron --isovalue 0 --step 3 --repeat 0"));
    EXPECT_THAT(query.out, HasSubstr("(time 0.3 s)"));
    EXPECT_THAT(isochron({"info", "a.isochron"}).out, HasSubstr("times 0 to 0.4 s, uniform"));
}

TEST_F(CommandLine, BadInputIsOneLineAndLeavesNothingBehind) {
    ASSERT_EQ(isochron(build_of("t*.raw")).status, 0);
    const auto before = folder.names();
    const std::string index = folder.read("a.isochron");
    const auto fails = [&](const std::vector<std::string>& arguments, const std::string& message) {
        SCOPED_TRACE(arguments.front() + " " + arguments[1]);
        expect_failure(isochron(arguments), 1, message);
        EXPECT_EQ(folder.names(), before);
        EXPECT_EQ(folder.read("a.isochron"), index);
    };
    fails(build_of("none*.raw"), "none*.raw: no file matches");
    fails(build_of("none.raw"), "none.raw");
    fails({"build", "t0.raw", "-o", "a.isochron"}, "t0.raw");
    fails(as_words("build t0.raw --dims 14 11 9 --type f32 -o t0.raw"), "t0.raw: is an input");
    fails(as_words("build t0.raw --dims 14 11 9 --type f32 -o no/a.isochron"),
          "there is no folder no");
    fails(as_words("build t0.raw --dims 14 11 9 --type f32 -o t1.raw"),
          "t1.raw: exists and is not an isochron index");
    fails(as_words("query a.isochron --isovalue 0 --step 5"), "step 5, expected 0 to 4");
    fails(as_words("query a.isochron --isovalue 0 --step -1"), "step -1, expected 0 to 4");
    fails(as_words("query t0.raw --isovalue 0 --step 0"), "not an isochron index");
    fails(as_words("query a.isochron --isovalue 0 --step 0 --ids no/ids.bin"),
          "no/ids.bin: cannot be written");
    fails(as_words("query a.isochron --isovalue 0 --step 0 --ids a.isochron"),
          "a.isochron: is an input");
    fails(as_words("query a.isochron --isovalue 0 --step 0 --method tree"),
          "a.isochron: has no search structure tree; isochron info lists those it has");
    fails({"explore", "t0.raw", "--no-panel"},
          "t0.raw: raw values need --dims NX NY NZ and --type");
    fails(build_of("t[01].raw", {"--append"}), "must begin with the 5 steps that it holds");
    fails({"info", "none.isochron"}, "none.isochron: there is no such file");
    fails({"info", "."}, ".: a folder without a file of values");
}

TEST_F(CommandLine, BadUsageIsStatus2) {
    expect_failure(isochron({"build", "t0.raw"}), 2, "--out");
    expect_failure(isochron({"query", "a.isochron", "--step", "1"}), 2, "--isovalue");
    expect_failure(isochron({"info", "a.isochron", "--unknown"}), 2, "--unknown");
    expect_failure(isochron(build_of("t*.raw", {"--lattice", "0"})), 2, "--lattice");
    expect_failure(isochron(build_of("t*.raw", {"--tiers", "bricks,cubes"})), 2,
                   "cubes: expected none, or some of bricks,tree");
    expect_failure(isochron(build_of("t*.raw", {"--time-step", "0"})), 2,
                   "expected a positive number, got 0");
    expect_failure(isochron(build_of("t*.raw", {"--time-step", "nan"})), 2, "got nan");
    expect_failure(isochron({"xyzzy"}), 2, "xyzzy: unknown, expected info, build");
    for (const char* file : {"a.isochron", "walk.jsonl", "picture.png", "my data.raw"})
        folder.write(file, "?");
    for (const auto& [arguments, message] :
         std::vector<std::pair<std::vector<std::string>, std::string>>{
             {{"bild"}, "isochron: bild: unknown, did you mean build? (see isochron --help)\n"},
             {{"exlpore", "a.isochron"}, "exlpore: unknown, did you mean explore? (see"},
             {{"walk.jsonl"}, "did you mean `isochron replay walk.jsonl`?"},
             {{"walk.jsonl", "--stamps", "--out", "my pictures"},
              "did you mean `isochron replay walk.jsonl --stamps --out 'my pictures'`?"},
             {{"picture.png"}, "did you mean `isochron reproduce picture.png`?"},
             {{"explore", "--isovlaue", "3", "a.isochron"},
              "--isovlaue: unknown option, did you mean --isovalue? (see isochron explore --help)"},
             {{"--quiet", "walk.jsonl", "--stamps"},
              "did you mean `isochron replay --quiet walk.jsonl --stamps`?"},
             {{"build", "--ouput=b", "t0.raw", "-o", "b"}, "--ouput: unknown option, did you mean"},
             {{"verify", "a.isochron", "b.isochron"}, "b.isochron: one argument too many"},
             {{"query", "a.isochron", "--isovalue", "x", "--step", "1"},
              "--isovalue: expected a number, got x"},
             {{"query", "a.isochron", "--isovalue", "", "--step", "1"},
              "--isovalue: expected a number, got nothing"},
             {{"query", "a.isochron", "--isovalue", "1", "--step", ""},
              "--step: expected a number, got nothing"},
             {{"build", "a.raw", "-o", "b.isochron", "--crop", ""}, "--crop , expected"},
             {{"build", "a.raw", "-o", "b.isochron", "--stride", ""}, "--stride , expected"},
             {{"build", "a.raw", "-o", "b.isochron", "--steps", ""}, "--steps , expected"},
             {{"measure", "a.isochron", "--isovalue", "1", "--dust", "-1"},
              "--dust: expected a whole number from 0, got -1"},
             {{"explore", "a.isochron", "--quality", "fsat"},
              "--quality: expected one of auto, fast, quality, paper, got fsat, did you mean "
              "fast?"}})
        expect_failure(isochron(arguments), 2, message);
    expect_failure(isochron(as_words("change a.isochron --isovalue 0 --step 1")), 2,
                   "--to-step or --to-isovalue is missing");
    expect_failure(isochron({"query", "my data.raw", "--isovalue", "0", "--step", "1"}), 1,
                   "`isochron build 'my data.raw' -o 'my data.isochron'` makes an index");
    expect_failure(isochron({"generate", "cubes"}), 2,
                   "cubes: unknown, expected sphere, vorticity");
    expect_failure(isochron({"replay", "walk.jsonl", "--out", "pictures"}), 2,
                   "--every N or --stamps");
}

TEST(GridsToShow, MayHave2To35VerticesAndNotMore) {
    index::Grid grid;
    grid.vertices = {4096, 4096, 2048};
    EXPECT_NO_THROW(check_can_be_shown(grid, "a"));
    grid.vertices = {4096, 4096, 2049};
    try {
        check_can_be_shown(grid, "large.isochron");
        ADD_FAILURE() << "not refused";
    } catch (const index::Error& error) {
        EXPECT_STREQ(error.what(),
                     "large.isochron: 34376515584 vertices, expected at most 2^35 to show; "
                     "isochron query finds the active cells of an isovalue");
    }
}

TEST_F(CommandLine, AChangeOfAStepOf2To32CellsIsRefused) {
    index::Grid grid;
    grid.vertices = {257, 257, 65537};
    ASSERT_TRUE(index::has_wide_ids(grid));
    index::HugeIndex(grid, {}).write_without_records(folder.path() / "huge.isochron");
    expect_failure(
        isochron(as_words(
            "change huge.isochron --isovalue 150 --step 0 --to-isovalue 160 --added added.bin")),
        1, "huge.isochron: 4294967296 cells, expected fewer than 2^32 to compare");
    EXPECT_FALSE(std::filesystem::exists(folder.path() / "added.bin"));
    EXPECT_EQ(isochron({"info", "huge.isochron"}).status, 0);
}

TEST_F(CommandLine, VerifyFindsDamageThatOpeningDoesNotTouch) {
    ASSERT_EQ(isochron(build_of("t*.raw")).status, 0);
    std::string bytes = folder.read("a.isochron");
    bytes[9000] = char(bytes[9000] ^ 4); // in the volume
    folder.write("b.isochron", bytes);
    EXPECT_EQ(isochron({"info", "b.isochron"}).status, 0);
    EXPECT_EQ(isochron({"verify", "a.isochron"}).out, "a.isochron: every checksum matches\n");
    expect_failure(isochron({"verify", "b.isochron"}), 1, "b.isochron: damaged: volume, step ");
}

TEST_F(CommandLine, ALimitOfFilesIsOneLineAndLeavesNothing) {
    ASSERT_EQ(isochron(build_of("t*.raw")).status, 0);
    const auto before = folder.names();
    const auto limited = [&](const std::string& command) {
        return run_child("/bin/sh",
                         {"-c", fmt::format("ulimit -f 1; exec {}/isochron {}",
                                            test_support::binary_root(), command)},
                         folder.path());
    };
    const ChildResult built = limited("build t0.raw --dims 14 11 9 --type f32 -o new.isochron");
    EXPECT_EQ(built.status, 1);
    EXPECT_THAT(built.err, // after the phases of the work
                testing::EndsWith("isochron: new.isochron: cannot be written: File too large\n"));
    expect_failure(limited("query a.isochron --isovalue 0.1 --step 0 --ids ids.bin"), 1,
                   "ids.bin: cannot be written: File too large");
    EXPECT_EQ(folder.names(), before);
}

TEST_F(CommandLine, VerifySaysOnceWhatIsLost) {
    ASSERT_EQ(isochron(build_of("t[01].raw")).status, 0);
    ASSERT_EQ(isochron(build_of("t*.raw", {"--append"})).status, 0);
    // The newer of the two headers is damaged.
    std::string bytes = folder.read("a.isochron");
    for (const std::size_t at : {std::size_t{100}, std::size_t{4096 + 100}}) {
        std::string damaged = bytes;
        damaged[at] = char(damaged[at] ^ 1);
        folder.write("b.isochron", damaged);
        const ChildResult result = isochron({"verify", "b.isochron"});
        if (result.err.find("a newer state") != std::string::npos)
            expect_failure(result, 1, "b.isochron: the header of a newer state is damaged");
    }
}

TEST_F(CommandLine, MeasuresBeyondWhatCanBeShownAreRefused) {
    for (const char* option : {"--spacing", "--origin"}) {
        std::vector<std::string> command = build_of("t0.raw");
        command.insert(command.end(), {option, "1", "1", "1e308"});
        expect_failure(isochron(command), 1, option);
    }
    std::vector<std::string> command = build_of("t*.raw");
    command.insert(command.end(), {"--time-step", "1e308"});
    expect_failure(isochron(command), 1, "--time-step");
}

TEST_F(CommandLine, TheTimesOfSourcesAreInNoBytesButThoseThatThePageNames) {
    ASSERT_EQ(isochron(build_of("t*.raw")).status, 0);
    const std::string first = folder.read("a.isochron");
    for (std::size_t t = 0; t < steps.size(); ++t)
        std::filesystem::last_write_time(folder.path() / fmt::format("t{}.raw", t),
                                         std::filesystem::file_time_type::clock::now() -
                                             std::chrono::hours(1 + t));
    ASSERT_EQ(isochron(build_of("t*.raw")).status, 0);
    const std::string second = folder.read("a.isochron");
    ASSERT_EQ(first.size(), second.size());
    std::size_t differ = 0;
    for (std::size_t i = 0; i < first.size(); ++i)
        differ += first[i] != second[i] ? 1 : 0;
    EXPECT_GT(differ, 0u);
    EXPECT_LE(differ, 8 * steps.size() + 8 + 8);
}

TEST_F(CommandLine, AnOutputThatCannotBeWrittenIsAFailure) {
    ASSERT_EQ(isochron(build_of("t*.raw")).status, 0);
    for (const std::vector<std::string>& words : std::vector<std::vector<std::string>>{
             {"info", "a.isochron"}, {"info", "a.isochron", "--json"}, {"--version"}, {"--help"}}) {
        const ChildResult result = isochron(words, {.out = "/dev/full"});
        EXPECT_EQ(result.status, 1) << words[0];
        EXPECT_THAT(result.err, HasSubstr("the output cannot be written"));
    }
}

TEST_F(CommandLine, WithoutStandardStreamsNothingThatIsPrintedComesIntoAFile) {
    const std::string source = test_support::test_data() + "/vti/raw_plain64.vti"; // by a reader
    const std::vector<std::string> build{"build", source, "-o", "a.isochron"};
    ASSERT_EQ(isochron(build).status, 0);
    const std::string whole = folder.read("a.isochron");
    for (const std::vector<int>& closed : {std::vector<int>{2}, {1, 2}, {0, 1, 2}}) {
        const ChildResult result = isochron(build, {.closed = closed});
        EXPECT_EQ(result.status, closed.size() == 1 ? 0 : 1); // progress is not needed, a report is
        EXPECT_TRUE(folder.read("a.isochron") == whole) << closed.size();
    }
}

TEST_F(CommandLine, NoCommandWaitsForAPipeThatIsGivenAsAFile) {
    for (const char* name : {"p.jsonl", "p.png", "p.pdf", "p.toml", "p.isochron", "p.vti"})
        ASSERT_EQ(::mkfifo((folder.path() / name).c_str(), 0600), 0);
    for (const std::vector<std::string>& words :
         std::vector<std::vector<std::string>>{{"table", "p.jsonl"},
                                               {"replay", "p.jsonl"},
                                               {"reproduce", "p.png"},
                                               {"reproduce", "p.pdf"},
                                               {"figure", "p.toml", "-o", "f.pdf"},
                                               {"explore", "--check-config", "p.toml"},
                                               {"config", "import", "p.toml"},
                                               {"verify", "p.isochron"},
                                               {"info", "p.vti"}}) {
        const ChildResult result = isochron(words, {.dies_after = std::chrono::seconds(20)});
        EXPECT_EQ(result.status, 1) << words[0];
        EXPECT_THAT(result.err, HasSubstr("not a regular file")) << words[0];
    }
}

} // namespace
} // namespace isochron::app
