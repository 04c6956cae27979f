// `isochron measure`: rows of numbers, and the same numbers as VTK's and scipy's.
#include "tests/app/commands/command_line.h"

#include <nlohmann/json.hpp>

#include <sstream>

namespace isochron::app {
namespace {

using testing::HasSubstr;

class MeasureCommand : public CommandLine {
  protected:
    ChildResult measure(const std::vector<std::string>& more) {
        std::vector<std::string> all{"measure", "a.isochron"};
        all.insert(all.end(), more.begin(), more.end());
        return isochron(all);
    }
    void build() {
        ASSERT_EQ(isochron(build_of("t*.raw", {"--length-unit", "mm", "--time-step", "0.5",
                                               "--time-unit", "s"}))
                      .status,
                  0);
    }
};

TEST_F(MeasureCommand, AgreesWithVtkAndScipy) {
    const std::string command = fmt::format("PYTHONDONTWRITEBYTECODE=1 /usr/bin/python3 "
                                            "{}/tests/app/commands/measured_with_vtk.py "
                                            "{}/isochron >{}/said",
                                            test_support::source_root(),
                                            test_support::binary_root(), folder.path().string());
    EXPECT_EQ(std::system(command.c_str()), 0) << folder.read("said");
}

TEST_F(MeasureCommand, PrintsARowForEachStepAndIsovalue) {
    build();
    const ChildResult json = measure(as_words("--isovalue 0.1 --isovalue 0.3 --json"));
    ASSERT_EQ(json.status, 0) << json.err;
    const auto found = nlohmann::json::parse(json.out);
    EXPECT_EQ(found.at("units").at("area"), "mm^2");
    EXPECT_EQ(found.at("units").at("volume"), "mm^3");
    EXPECT_EQ(found.at("units").at("time"), "s");
    const auto& rows = found.at("rows");
    ASSERT_EQ(rows.size(), 2 * kSteps);
    for (std::size_t i = 0; i < rows.size(); ++i) {
        EXPECT_EQ(rows[i].at("step"), i / 2);
        EXPECT_EQ(rows[i].at("time"), 0.5 * static_cast<double>(i / 2));
        EXPECT_EQ(rows[i].at("isovalue"), i % 2 ? 0.3 : 0.1);
        EXPECT_NEAR(rows[i].at("volume").get<double>() + rows[i].at("volume-below").get<double>(),
                    double((kX - 1) * (kY - 1) * (kZ - 1)), 1e-9);
        EXPECT_FALSE(rows[i].contains("mean"));
    }
    const ChildResult table = measure(as_words("--isovalue 0.1 --steps 3 --measure area"));
    EXPECT_THAT(table.out, HasSubstr("area [mm^2]"));
    const ChildResult csv =
        measure(as_words("--isovalue 0.1 --steps 1:4:3 --measure area --measure pieces --csv"));
    std::istringstream lines(csv.out);
    std::string line;
    std::getline(lines, line);
    EXPECT_EQ(line, "step,fraction,time,isovalue,area,pieces");
    std::getline(lines, line);
    EXPECT_EQ(line, fmt::format("1,0,0.5,0.1,{},{}", rows[2].at("area").dump(),
                                rows[2].at("pieces").dump()));
}

TEST_F(MeasureCommand, MeasuresBothSidesOfAPlane) {
    build();
    const auto found = [&](const std::vector<std::string>& clip) {
        std::vector<std::string> all{"--isovalue", "0.1", "--steps", "2", "--json"};
        all.insert(all.end(), clip.begin(), clip.end());
        return nlohmann::json::parse(measure(all).out).at("rows")[0];
    };
    const auto whole = found({}), left = found({"--clip", "3", "3", "3", "1", "-2", "0.5"}),
               right = found({"--clip", "3", "3", "3", "-1", "2", "-0.5"});
    for (const char* const name : {"area", "volume", "volume-below"}) {
        EXPECT_GT(left.at(name).get<double>(), 0) << name;
        EXPECT_NEAR(left.at(name).get<double>() + right.at(name).get<double>(),
                    whole.at(name).get<double>(), 1e-9 * whole.at(name).get<double>())
            << name;
    }
    const ChildResult wrong = measure(as_words("--isovalue 0.1 --clip 3 3 3 0 0 0"));
    EXPECT_NE(wrong.status, 0);
    EXPECT_THAT(wrong.err, HasSubstr("--clip 3 3 3 0 0 0: expected a point on the plane"));
}

TEST_F(MeasureCommand, MeasuresTheDistanceFromAPlace) {
    build();
    const auto rows = [&](const char* more) {
        const ChildResult run = measure(as_words(std::string("--isovalue 0.1 --json ") + more));
        EXPECT_EQ(run.status, 0) << run.err;
        return nlohmann::json::parse(run.out);
    };
    const auto far = rows("--measure distance --from 100 3 3");
    EXPECT_EQ(far.at("rows").size(), kSteps);
    EXPECT_EQ(far.at("rows")[0].size(), 5u) << "beside step, fraction, time and isovalue";
    for (const auto& row : far.at("rows"))
        EXPECT_GT(row.at("distance").get<double>(), 80);
    EXPECT_FALSE(rows("").at("rows")[0].contains("distance"));
    const ChildResult wrong = measure(as_words("--isovalue 0.1 --measure distance"));
    EXPECT_NE(wrong.status, 0);
    EXPECT_THAT(wrong.err, HasSubstr("--measure distance: needs --from X Y Z"));
}

TEST_F(MeasureCommand, PiecesAddUpToTheSurface) {
    build();
    const auto rows_of = [&](const std::vector<std::string>& more) {
        std::vector<std::string> all{"--isovalue", "0.1", "--steps", "2", "--json"};
        all.insert(all.end(), more.begin(), more.end());
        return nlohmann::json::parse(measure(all).out).at("rows");
    };
    const auto whole = rows_of({})[0], pieces = rows_of({"--pieces"});
    EXPECT_EQ(pieces.size(), whole.at("pieces").get<std::size_t>());
    double area = 0;
    std::int64_t euler = 0;
    for (const auto& piece : pieces) {
        area += piece.at("area").get<double>();
        euler += piece.at("euler").get<std::int64_t>();
        EXPECT_EQ(piece.at("closed") == 1, piece.at("volume").is_number());
        EXPECT_LE(piece.at("x-least"), piece.at("x"));
        EXPECT_LE(piece.at("x"), piece.at("x-greatest"));
    }
    EXPECT_NEAR(area, whole.at("area").get<double>(), 1e-9 * area);
    EXPECT_EQ(euler, whole.at("euler").get<std::int64_t>());
    const std::int64_t dust = pieces[0].at("cells").get<std::int64_t>();
    nlohmann::json large = nlohmann::json::array();
    for (const auto& piece : pieces)
        if (piece.at("cells") >= dust)
            large.push_back(piece);
    EXPECT_LT(large.size(), pieces.size());
    const std::string least = std::to_string(dust);
    EXPECT_EQ(rows_of({"--pieces", "--dust", least}), large);
    EXPECT_EQ(rows_of({"--dust", least})[0].at("pieces"), large.size());
    EXPECT_TRUE(rows_of({"--dust", least})[0].at("bodies").is_null());
}

TEST_F(MeasureCommand, RefusesWhatItCannotMeasure) {
    build();
    for (const auto& [more, said] : std::vector<std::pair<std::vector<std::string>, std::string>>{
             {{"--isovalue", "0.1", "--steps", "5"}, "expected steps 0 to 4"},
             {{"--isovalue", "0.1", "--measure", "mass"}, "mass"},
             {{"--isovalue", "0.1", "--measure", "mean"}, "--on-surface"},
             {{"--isovalue", "0.1", "--on-surface", "p"}, "no array p"},
             {{"--isovalue", "0.1", "-o", "t0.raw"}, "t0.raw"},
             {{}, "--isovalue"}}) {
        const ChildResult refused = measure(more);
        EXPECT_NE(refused.status, 0);
        EXPECT_EQ(refused.out, "");
        EXPECT_THAT(refused.err, HasSubstr(said));
    }
}

} // namespace
} // namespace isochron::app
