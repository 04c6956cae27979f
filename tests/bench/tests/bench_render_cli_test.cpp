// `isochron-bench render` as a user runs it.
#include "tests/bench/tests/bench_commands.h"

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <set>

namespace isochron::app {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

class BenchRenderCommand : public BenchCommands {};

TEST_F(BenchRenderCommand, MeasuresEveryRowOfATinySeries) {
    const ChildResult result = bench({"render", "--quick", "--work", ".", "--json", "a.json"});
    ASSERT_EQ(result.status, 0) << result.err;
    EXPECT_THAT(result.out, HasSubstr("series       footprint picture"));
    EXPECT_THAT(folder.names(), ElementsAre("a.json")) << "nothing else is left behind";
    const auto j = nlohmann::json::parse(folder.read("a.json"));
    EXPECT_FALSE(j.at("header").at("processor").get<std::string>().empty());
    std::set<std::string> kinds;
    for (const auto& row : j.at("rows")) {
        SCOPED_TRACE(row.dump());
        kinds.insert(row.at("footprint").get<std::string>() + " " + row.at("eyes").dump() + " " +
                     row.at("threads").dump());
        EXPECT_EQ(row.at("data"), "sphere");
        EXPECT_EQ(row.at("context"), "egl");
        EXPECT_NEAR(row.at("cells"), 3733, 20);
        for (const char* figure : {"fps", "vtk_fps", "p99_over_static", "extract_ms", "upload_ms",
                                   "draw_ms", "frame_cpu_ms", "vtk_cpu_ms"})
            EXPECT_GT(row.at(figure), 0.0) << figure;
        EXPECT_EQ(row.at("order_ms") > 0.0, row.at("footprint") == "gaussian");
    }
    EXPECT_THAT(kinds, testing::IsSupersetOf({"quad 1 1", "quad 1 2", "quad 2 1", "quad 2 2",
                                              "gaussian 1 1", "gaussian 1 2", "gaussian 2 1",
                                              "gaussian 2 2"}));
    EXPECT_EQ(j.at("rows").size(), kinds.size());
}

TEST_F(BenchRenderCommand, SaysHowFarFootprintsAgreeWithTheExactSurface) {
    const ChildResult result =
        bench({"render", "--quick", "--agreement-only", "--work", ".", "--json", "c.json"});
    ASSERT_EQ(result.status, 0) << result.err;
    const auto j = nlohmann::json::parse(folder.read("c.json"));
    ASSERT_EQ(j.at("rows").size(), 4u) << "two footprints of two shapes";
    for (std::size_t i = 0; i < 4; i += 2) {
        const auto &voxel = j.at("rows").at(i), &plane = j.at("rows").at(i + 1);
        SCOPED_TRACE(voxel.dump() + plane.dump());
        EXPECT_EQ(voxel.at("shape"), "voxel");
        EXPECT_EQ(plane.at("shape"), "plane");
        EXPECT_EQ(voxel.at("footprint"), plane.at("footprint"));
        EXPECT_LT(plane.at("extra_percent"), 0.5 * voxel.at("extra_percent").get<double>());
        EXPECT_LT(plane.at("missed_percent"), 1.0);
        EXPECT_LT(plane.at("offset"), 0.5 * voxel.at("offset").get<double>());
        EXPECT_GT(plane.at("luminance_percent"), 0.0);
        EXPECT_GT(plane.at("exact_percent"), 4.0);
    }
}

TEST_F(BenchRenderCommand, MeasuresAGivenIndexAndContext) {
    std::string values;
    for (int i = 0; i < 12 * 12 * 12; ++i)
        values.push_back(static_cast<char>(i / 144 * 20));
    folder.write("t0.raw", values);
    folder.write("t1.raw", values);
    ASSERT_EQ(isochron({"build", "t*.raw", "--dims", "12", "12", "12", "--type", "u8", "-o",
                        "slope.isochron"})
                  .status,
              0);
    const auto measure = [&](std::vector<std::string> more) {
        std::vector<std::string> arguments{
            "render",    "slope.isochron", "--repeat", "1",         "--footprints",
            "quad",      "--pictures",     "40",       "--threads", "1",
            "--context", "osmesa",         "--json",   "b.json"};
        arguments.insert(arguments.end(), more.begin(), more.end());
        const ChildResult result = bench(arguments);
        EXPECT_EQ(result.status, 0) << result.err;
        return nlohmann::json::parse(folder.read("b.json")).at("rows");
    };
    auto rows = measure({"--isovalue", "90"});
    ASSERT_EQ(rows.size(), 1u);
    EXPECT_EQ(rows[0].at("data"), "slope");
    EXPECT_EQ(rows[0].at("context"), "osmesa");
    EXPECT_EQ(rows[0].at("cells"), 121.0);
    EXPECT_TRUE(rows[0].at("vtk_fps").is_null());
    rows = measure({}); // an isovalue of its own
    ASSERT_EQ(rows.size(), 1u);
    EXPECT_EQ(rows[0].at("cells"), 121.0);
}

TEST_F(BenchRenderCommand, RefusesWhatItCannotDraw) {
    for (const auto& [arguments, complaint] :
         {std::pair{std::vector<std::string>{"--pictures", "512,3x40"},
                    "3x40: expected 16 to 8192"},
          std::pair{std::vector<std::string>{"--footprints", "blob"}, "blob"},
          std::pair{std::vector<std::string>{"none.isochron"}, "none.isochron"}}) {
        std::vector<std::string> all{"render"};
        all.insert(all.end(), arguments.begin(), arguments.end());
        const ChildResult result = bench(all);
        EXPECT_EQ(result.status, 2);
        EXPECT_THAT(result.err, HasSubstr(complaint));
    }
}

TEST_F(BenchRenderCommand, CountsArtifactsAndShowsThem) {
    const ChildResult result = bench({"artifacts", "--data", "sphere-25", "--steps", "5", "--every",
                                      "2", "--lattice", "32", "--max-variation", "3", "--size",
                                      "80", "--work", ".", "--out", ".", "--json", "c.json"});
    ASSERT_EQ(result.status, 0) << result.err;
    EXPECT_THAT(folder.names(), ElementsAre("c.json", "sphere_false_positives.png",
                                            "sphere_kept_normals.png", "sphere_quality_fast.png"));
    const auto rows = nlohmann::json::parse(folder.read("c.json")).at("rows");
    ASSERT_GE(rows.size(), 2u) << "one for each footprint";
    double most_changed = 0;
    for (const auto& row : rows) {
        for (const char* figure : {"cells", "angle_mean", "normals_mean", "false_positive_percent"})
            EXPECT_GT(row.at(figure), 0.0) << figure;
        most_changed = std::max(most_changed, row.at("false_changed_percent").get<double>());
    }
    // Quads may show none of them: no plane passes through cells without a surface.
    EXPECT_GT(most_changed, 0.0);
}

TEST_F(BenchRenderCommand, CanceledItLeavesNothingBehind) {
    const ChildResult result =
        bench({"render", "--data", "sphere-25", "--work", ".", "--repeat", "1000"},
              {.interrupt_after = "quad"});
    EXPECT_EQ(result.status, 130);
    EXPECT_THAT(result.err, HasSubstr("canceled"));
    EXPECT_THAT(folder.names(), IsEmpty());
}

} // namespace
} // namespace isochron::app
