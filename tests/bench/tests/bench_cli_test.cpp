// `isochron-bench` as a user runs it.
#include "tests/bench/tests/bench_commands.h"

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include <cmath>

namespace isochron::app {
namespace {

using testing::HasSubstr;
using testing::IsEmpty;

class BenchCommand : public BenchCommands {};

/// What must hold of every row.
void expect_sound(const nlohmann::json& row) {
    SCOPED_TRACE(row.dump());
    const bool candidates = row.at("structure").get<std::string>().starts_with("thi");
    EXPECT_EQ(row.at("false_negatives"), 0);
    EXPECT_EQ(row.at("false_positives") > 0, candidates);
    EXPECT_EQ(row.at("l").is_null(), !candidates);
    for (const char* time : {"search_ids_us", "search_full_us", "sweep_ms", "scan_us", "tbon_us",
                             "flying_edges_us", "flying_edges_normals_us", "memcpy_us"})
        EXPECT_GT(row.at(time), 0.0) << time;
    EXPECT_EQ(row.at("incremental_full_us").is_null(), row.at("structure") != "thi");
    EXPECT_EQ(row.at("bytes") == 0, row.at("structure") == "scan");
    EXPECT_EQ(row.at("build_mcs_per_s").is_null(), row.at("structure") == "scan");
    EXPECT_LT(row.at("memcpy_us"), row.at("search_ids_us"));
}

TEST_F(BenchCommand, MeasuresEveryStructureOnTheSphere) {
    const ChildResult result = bench({"index", "--quick", "--work", ".", "--json", "a.json"});
    ASSERT_EQ(result.status, 0) << result.err;
    EXPECT_THAT(result.out, HasSubstr("sphere u8, 5 steps, isovalue 112.5: 373"));
    EXPECT_THAT(result.out, HasSubstr("thi-compact-lists    L 64 MV 2"));
    EXPECT_THAT(folder.names(), testing::ElementsAre("a.json")) << "nothing else is left behind";
    const auto j = nlohmann::json::parse(folder.read("a.json"));
    EXPECT_FALSE(j.at("header").at("processor").get<std::string>().empty());
    EXPECT_FALSE(j.at("header").at("commit").get<std::string>().empty());
    ASSERT_EQ(j.at("rows").size(), 7u);
    for (const auto& row : j.at("rows")) {
        expect_sound(row);
        EXPECT_EQ(row.at("steps"), 5);
        EXPECT_NEAR(row.at("active"), 3733, 20);
        // 60 x 49 x 59 cells, 61 x 50 x 60 vertices of a byte.
        const double raw = 5.0 * 173460 * 24;
        EXPECT_NEAR(row.at("percent_of_raw"), 100 * double(row.at("bytes")) / raw, 0.01);
        EXPECT_NEAR(row.at("percent_with_volume"),
                    100 * (double(row.at("bytes")) + 5.0 * 183000) / raw, 0.01);
    }
}

TEST_F(BenchCommand, MeasuresAGivenIndex) {
    std::vector<float> values;
    for (int z = 0; z < 12; ++z)
        for (int y = 0; y < 13; ++y)
            for (int x = 0; x < 14; ++x)
                values.push_back(static_cast<float>(std::hypot(x - 7, y - 6, z - 5)));
    for (const char* name : {"t0.raw", "t1.raw"})
        folder.write(name, {reinterpret_cast<const char*>(values.data()), values.size() * 4});
    ASSERT_EQ(isochron({"build", "t*.raw", "--dims", "14", "13", "12", "--type", "f32", "-o",
                        "balls.isochron"})
                  .status,
              0);
    const ChildResult result =
        bench({"index", "balls.isochron", "--isovalue", "4.5", "--repeat", "1", "--isovalues", "5",
               "--lattice", "16,32", "--max-variation", "1", "--json", "a.json"});
    ASSERT_EQ(result.status, 0) << result.err;
    const auto j = nlohmann::json::parse(folder.read("a.json"));
    ASSERT_EQ(j.at("rows").size(), 11u);
    for (const auto& row : j.at("rows")) {
        EXPECT_EQ(row.at("data"), "balls");
        EXPECT_EQ(row.at("type"), "f32");
        EXPECT_EQ(row.at("isovalue"), 4.5);
        EXPECT_EQ(row.at("delta_ids"), 0.0) << "both steps are the same";
        EXPECT_EQ(row.at("false_negatives"), 0);
    }
}

TEST_F(BenchCommand, SaysWhatIsWrong) {
    for (const auto& [arguments, status, what] :
         std::vector<std::tuple<std::vector<std::string>, int, std::string>>{
             {{"no_command"},
              2,
              "expected index, render, artifacts, between, building, change, motion, "
              "scale"},
             {{"index", "no.isochron"}, 1, "no.isochron"},
             {{"index", "--data", "cube"}, 2, "cube"},
             {{"index", "--lattice", "0"}, 2, "lattice"}}) {
        const ChildResult result = bench(arguments);
        EXPECT_EQ(result.status, status) << result.err;
        EXPECT_THAT(result.err, HasSubstr(what));
        EXPECT_THAT(result.out, IsEmpty());
    }
}

TEST_F(BenchCommand, CanBeInterruptedAndLeavesNothing) {
    const ChildResult result =
        bench({"index", "--data", "sphere-25", "--work", ".", "--json", "a.json"},
              {.interrupt_after = "counting errors"});
    EXPECT_EQ(result.status, 130) << result.err;
    EXPECT_THAT(folder.names(), IsEmpty());
}

} // namespace
} // namespace isochron::app
