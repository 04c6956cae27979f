// The commands as a user runs them: what they print, how they end, and what they leave behind.
#include "child_process.h"
#include "tests/support/test_seed.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <cmath>
#include <cstdint>
#include <cstring>
#include <random>

namespace isochron::app {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::StartsWith;

constexpr std::size_t kX = 14, kY = 11, kZ = 9, kSteps = 5;

/// A folder with a series of raw float steps `t0.raw` ... `t4.raw`.
class CommandLine : public testing::Test {
  protected:
    CommandLine() {
        std::mt19937 random(test_seed());
        std::uniform_real_distribution<double> phase(0, 6.28);
        const double a = phase(random), b = phase(random), c = phase(random);
        for (std::size_t t = 0; t < kSteps; ++t) {
            std::vector<float> values;
            for (std::size_t z = 0; z < kZ; ++z)
                for (std::size_t y = 0; y < kY; ++y)
                    for (std::size_t x = 0; x < kX; ++x)
                        values.push_back(static_cast<float>(
                            std::sin(0.5 * double(x) + a + 0.1 * double(t)) +
                            std::cos(0.6 * double(y) + b) * std::sin(0.7 * double(z) + c)));
            folder.write(fmt::format("t{}.raw", t),
                         {reinterpret_cast<const char*>(values.data()), values.size() * 4});
            steps.push_back(std::move(values));
        }
    }

    ChildResult isochron(const std::vector<std::string>& arguments, const ChildOptions& how = {}) {
        return run_child(BINARY_ROOT "/isochron", arguments, folder.path(), how);
    }
    static std::vector<std::string> build_of(const std::string& files,
                                             const std::vector<std::string>& more = {}) {
        std::vector<std::string> all{"build", files,    "--dims", "14", "11",
                                     "9",     "--type", "f32",    "-o", "a.isochron"};
        all.insert(all.end(), more.begin(), more.end());
        return all;
    }

    /// The definition of active cells, written out.
    std::vector<std::uint32_t> active(std::size_t step, double isovalue) const {
        std::vector<std::uint32_t> ids;
        std::uint32_t id = 0;
        for (std::size_t z = 0; z + 1 < kZ; ++z)
            for (std::size_t y = 0; y + 1 < kY; ++y)
                for (std::size_t x = 0; x + 1 < kX; ++x, ++id) {
                    double low = INFINITY, high = -INFINITY;
                    for (std::size_t corner = 0; corner < 8; ++corner) {
                        const double v =
                            steps[step][((z + corner / 4) * kY + y + corner / 2 % 2) * kX + x +
                                        corner % 2];
                        low = std::min(low, v);
                        high = std::max(high, v);
                    }
                    if (low < isovalue && isovalue <= high)
                        ids.push_back(id);
                }
        return ids;
    }

    /// One line on stderr that starts with the program's name, nothing on stdout.
    static void expect_failure(const ChildResult& result, int status, const std::string& message) {
        EXPECT_EQ(result.status, status) << result.err;
        EXPECT_THAT(result.out, IsEmpty());
        EXPECT_THAT(result.err, HasSubstr(message));
        EXPECT_THAT(result.err, StartsWith("isochron: "));
        EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), 1) << result.err;
    }

    TestFolder folder;
    std::vector<std::vector<float>> steps;
};

TEST_F(CommandLine, QueryWritesTheActiveCellsOfEveryStepByTreeAndByScan) {
    for (const bool tree : {true, false}) {
        const auto more = tree ? std::vector<std::string>{"--lattice", "16"}
                               : std::vector<std::string>{"--no-tree"};
        const ChildResult built = isochron(build_of("t*.raw", more));
        ASSERT_EQ(built.status, 0) << built.err;
        EXPECT_THAT(built.out, HasSubstr("14 x 11 x 9 vertices, 5 steps, f32"));
        for (std::size_t step = 0; step < kSteps; ++step)
            for (const double isovalue : {-0.75, 0.1, double(steps[step][500]), 5.0})
                for (const bool scan : {false, true}) {
                    std::vector<std::string> query{"query",
                                                   "a.isochron",
                                                   "--json",
                                                   "--repeat",
                                                   "1",
                                                   "--ids",
                                                   "ids.bin",
                                                   "--isovalue",
                                                   fmt::format("{}", isovalue),
                                                   "--step",
                                                   std::to_string(step)};
                    if (scan)
                        query.push_back("--scan");
                    const ChildResult result = isochron(query);
                    ASSERT_EQ(result.status, 0) << result.err;
                    const std::string bytes = folder.read("ids.bin");
                    std::vector<std::uint32_t> ids(bytes.size() / 4);
                    if (!ids.empty()) // an isovalue out of range: an empty file
                        std::memcpy(ids.data(), bytes.data(), bytes.size());
                    const auto expected = active(step, isovalue);
                    EXPECT_EQ(ids, expected);
                    const auto json = nlohmann::json::parse(result.out);
                    EXPECT_EQ(json.at("active_cells"), expected.size());
                    EXPECT_EQ(json.at("method"), tree && !scan ? "tree" : "scan");
                    EXPECT_EQ(json.at("candidates").get<std::size_t>(),
                              expected.size() + json.at("false_positives").get<std::size_t>());
                    for (const char* key :
                         {"cold_search_ms", "cold_shading_ms", "search_ms", "shading_ms"})
                        EXPECT_GE(json.at(key).get<double>(), 0) << key;
                }
    }
}

TEST_F(CommandLine, InfoTellsWhatWasBuilt) {
    ASSERT_EQ(isochron(build_of("t*.raw", {"--spacing", "0.5", "1", "2", "--origin", "-1", "0", "3",
                                           "--time-step", "0.25", "--length-unit", "mm",
                                           "--time-unit", "ms", "--value-unit", "K"}))
                  .status,
              0);
    const ChildResult result = isochron({"info", "a.isochron", "--json", "--tree", "--verify"});
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
    EXPECT_EQ(json.at("verified"), true);
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

TEST_F(CommandLine, TimesAreTextWithoutTheDigitsOfRounding) {
    ASSERT_EQ(isochron(build_of("t*.raw", {"--time-step", "0.1", "--time-unit", "s"})).status, 0);
    const ChildResult query =
        isochron({"query", "a.isochron", "--isovalue", "0", "--step", "3", "--repeat", "0"});
    EXPECT_THAT(query.out, HasSubstr("(time 0.3 s)"));
    EXPECT_THAT(isochron({"info", "a.isochron"}).out, HasSubstr("times 0 to 0.4 s, uniform"));
}

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
    fails({"build", "t0.raw", "--dims", "14", "11", "9", "--type", "f32", "-o", "t0.raw"},
          "t0.raw: is an input");
    fails({"build", "t0.raw", "--dims", "14", "11", "9", "--type", "f32", "-o", "no/a.isochron"},
          "there is no folder no");
    fails({"build", "t0.raw", "--dims", "14", "11", "9", "--type", "f32", "-o", "t1.raw"},
          "t1.raw: exists and is not an isochron index");
    fails({"query", "a.isochron", "--isovalue", "0", "--step", "5"}, "step 5, expected 0 to 4");
    fails({"query", "a.isochron", "--isovalue", "0", "--step", "-1"}, "step -1, expected 0 to 4");
    fails({"query", "t0.raw", "--isovalue", "0", "--step", "0"}, "not an isochron index");
    fails({"query", "a.isochron", "--isovalue", "0", "--step", "0", "--ids", "no/ids.bin"},
          "no/ids.bin: cannot be written");
    fails({"query", "a.isochron", "--isovalue", "0", "--step", "0", "--ids", "a.isochron"},
          "a.isochron: is an input");
    fails({"info", "none.isochron"}, "none.isochron: cannot be opened: No such file");
    fails({"info", "."}, "not a regular file");
}

TEST_F(CommandLine, BadUsageIsStatus2) {
    expect_failure(isochron({"build", "t0.raw"}), 2, "--out");
    expect_failure(isochron({"query", "a.isochron", "--step", "1"}), 2, "--isovalue");
    expect_failure(isochron({"query", "a.isochron", "--isovalue", "x", "--step", "1"}), 2, "x");
    expect_failure(isochron({"info", "a.isochron", "--unknown"}), 2, "--unknown");
    expect_failure(isochron(build_of("t*.raw", {"--lattice", "0"})), 2, "--lattice");
    expect_failure(isochron(build_of("t*.raw", {"--time-step", "0"})), 2,
                   "expected a positive number, got 0");
    expect_failure(isochron(build_of("t*.raw", {"--time-step", "nan"})), 2, "got nan");
    expect_failure(isochron({}), 2, "expected build, query");
    expect_failure(isochron({"bild"}), 2, "bild: unknown, expected build, query");
    expect_failure(isochron({"generate", "cube"}), 2, "cube: unknown, expected sphere, vorticity");
    expect_failure(isochron({"replay", "walk.jsonl", "--out", "pictures"}), 2,
                   "--every N or --stamps");
}

TEST_F(CommandLine, HelpOfEveryCommandNamesItsOptions) {
    for (const auto& [command, options] :
         std::vector<std::pair<std::string, std::vector<std::string>>>{
             {"build",
              {"--array", "--component", "--dims", "--type", "--spacing", "--origin", "--time-step",
               "--length-unit", "--time-unit", "--value-unit", "--big-endian", "--header-bytes",
               "--lattice", "--max-variation", "--no-tree", "--quiet"}},
             {"query", {"--isovalue", "--step", "--ids", "--json", "--scan"}},
             {"info", {"--json", "--tree", "--verify"}}}) {
        const ChildResult result = isochron({command, "--help"});
        EXPECT_EQ(result.status, 0);
        for (const std::string& option : options)
            EXPECT_THAT(result.out, HasSubstr(option)) << command;
    }
}

TEST_F(CommandLine, VerifyFindsDamageThatOpeningDoesNotTouch) {
    ASSERT_EQ(isochron(build_of("t*.raw")).status, 0);
    std::string bytes = folder.read("a.isochron");
    bytes[5000] = char(bytes[5000] ^ 4); // in the volume
    folder.write("b.isochron", bytes);
    EXPECT_EQ(isochron({"info", "b.isochron"}).status, 0);
    expect_failure(isochron({"info", "b.isochron", "--verify"}), 1,
                   "b.isochron: damaged: the checksum of section volume does not match");
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
    for (const char* phase : {"reading", "counting"}) {
        const ChildResult result =
            isochron(build, {.interrupt_after = phase}); // as soon as it is printed
        EXPECT_EQ(result.status, 130);
        EXPECT_THAT(result.err, HasSubstr("isochron: cancelled\n"));
        EXPECT_EQ(folder.names(), before);
        EXPECT_EQ(folder.read("a.isochron"), old);
    }
}

TEST_F(CommandLine, AnOutputThatCannotBeWrittenIsAFailure) {
    ASSERT_EQ(isochron(build_of("t*.raw")).status, 0);
    const ChildResult result = isochron({"info", "a.isochron"}, {.out = "/dev/full"});
    EXPECT_EQ(result.status, 1);
    EXPECT_THAT(result.err, HasSubstr("the output cannot be written"));
}

} // namespace
} // namespace isochron::app
