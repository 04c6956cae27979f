// Several arrays in one index, from the command line: building, asking, appending, describing.
#include "app/text.h"
#include "tests/app/commands/command_line.h"

#include <nlohmann/json.hpp>

#include <string>
#include <utility>
#include <vector>

namespace isochron::app {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

/// The series in files of three arrays: `rho` as it is, `heat` its negative, and the vector `wind`,
/// of which one component is not 0.
class ArraysCommand : public CommandLine {
  protected:
    ArraysCommand() {
        for (std::size_t t = 0; t < kSteps; ++t)
            folder.write(fmt::format("t{}.vtk", t), file_of(t, {"rho", "heat", "wind"}));
    }

    std::string file_of(std::size_t step, const std::vector<std::string>& arrays) const {
        std::string text =
            fmt::format("# vtk DataFile Version 3.0\narrays\nASCII\nDATASET STRUCTURED_POINTS\n"
                        "DIMENSIONS {} {} {}\nORIGIN 0 0 0\nSPACING 1 1 1\nPOINT_DATA {}\n",
                        kX, kY, kZ, kX * kY * kZ);
        for (const std::string& array : arrays) {
            text += array == "wind"
                        ? "VECTORS wind float\n"
                        : fmt::format("SCALARS {} float 1\nLOOKUP_TABLE default\n", array);
            for (const float value : steps[step])
                text += array == "rho"    ? fmt::format("{}\n", value)
                        : array == "heat" ? fmt::format("{}\n", -value)
                                          : fmt::format("0 {} 0\n", value + 4);
        }
        return text;
    }
    std::vector<std::string> build(const std::vector<std::string>& more,
                                   const std::string& files = "t?.vtk") const {
        std::vector<std::string> all{"build", files, "-o", "a.isochron"};
        all.insert(all.end(), more.begin(), more.end());
        return all;
    }
    std::vector<std::string> names_of_arrays() {
        const auto said =
            nlohmann::json::parse(isochron({"info", "a.isochron", "--json"}).out).at("arrays");
        std::vector<std::string> names;
        for (const auto& array : said)
            names.push_back(array.at("array"));
        return names;
    }
    /// What a query finds in an array.
    std::vector<std::uint32_t> found(const std::string& array, double isovalue, std::size_t step) {
        const ChildResult result =
            isochron({"query", "a.isochron", "--array", array, "--isovalue",
                      fmt::format("{}", isovalue), "--step", std::to_string(step), "--ids", "ids"});
        EXPECT_EQ(result.status, 0) << result.err;
        return ids_in("ids");
    }
    /// Cells where the negative values are active: the other end of the interval is open.
    std::vector<std::uint32_t> active_of_negative(std::size_t step, double isovalue) const {
        return active(step, std::nextafter(-isovalue, 10.0));
    }
};

const std::vector<std::string> kThree = as_words("--array rho --array heat --array wind.1");

TEST_F(ArraysCommand, EachIsBuiltDescribedAndSearched) {
    const ChildResult made = isochron(build(kThree));
    ASSERT_EQ(made.status, 0) << made.err;
    EXPECT_THAT(made.out, HasSubstr("\nheat: f32, values"));
    EXPECT_THAT(names_of_arrays(), ElementsAre("rho", "heat", "wind.1"));
    const ChildResult told = isochron({"info", "a.isochron"});
    EXPECT_THAT(told.out, HasSubstr("arrays        rho: f32, "));
    for (const auto& [step, isovalue] : {std::pair{0u, -0.6}, {3u, 0.15}}) {
        EXPECT_EQ(found("rho", isovalue, step), active(step, isovalue));
        EXPECT_EQ(found("heat", isovalue, step), active_of_negative(step, isovalue));
    }
    EXPECT_EQ(isochron(as_words("query a.isochron --isovalue 0.15 --step 3 --ids ids")).status, 0);
    EXPECT_EQ(ids_in("ids"), active(3, 0.15)) << "the first where none is named";
    const auto info =
        nlohmann::json::parse(isochron(as_words("info a.isochron --array heat --json")).out);
    const auto all =
        nlohmann::json::parse(isochron({"info", "a.isochron", "--json"}).out).at("arrays");
    EXPECT_EQ(info.at("low"), all[1].at("low"));
    EXPECT_EQ(info.at("low").get<double>(), -all[0].at("high").get<double>());
    EXPECT_EQ(isochron({"verify", "a.isochron"}).status, 0);

    const ChildResult change = isochron(as_words("change a.isochron --array heat --json --step 1 "
                                                 "--isovalue 0.15 --to-step 2 --added added"));
    ASSERT_EQ(change.status, 0) << change.err;
    const auto before = active_of_negative(1, 0.15), after = active_of_negative(2, 0.15);
    std::vector<std::uint32_t> added;
    std::ranges::set_difference(after, before, std::back_inserter(added));
    EXPECT_EQ(ids_in("added"), added);
    expect_failure(isochron(as_words("query a.isochron --array cold --isovalue 0 --step 0")), 1,
                   "a.isochron: no array cold, expected rho, heat, wind.1");
}

TEST_F(ArraysCommand, TheSizeThatInfoSaysIsThatOfTheFile) {
    ASSERT_EQ(isochron(build({"--all-arrays"})).status, 0);
    const auto bytes = std::filesystem::file_size(folder.path() / "a.isochron");
    for (const std::vector<std::string>& more :
         std::vector<std::vector<std::string>>{{}, {"--array", "heat"}}) {
        std::vector<std::string> all{"info", "a.isochron"};
        all.insert(all.end(), more.begin(), more.end());
        EXPECT_THAT(isochron(all).out,
                    HasSubstr(fmt::format("\nfile          {}: volume ",
                                          human_bytes(static_cast<double>(bytes)))));
    }
}

TEST_F(ArraysCommand, AllThatThereAreAreTakenWithTheMagnitudeOfVectors) {
    const ChildResult made = isochron(build({"--all-arrays"}));
    ASSERT_EQ(made.status, 0) << made.err;
    EXPECT_THAT(names_of_arrays(), ElementsAre("rho", "heat", "wind.magnitude"));
    const std::string all = folder.read("a.isochron");
    ASSERT_EQ(isochron(build(as_words("--array rho --array heat --array wind.magnitude"))).status,
              0);
    EXPECT_EQ(folder.read("a.isochron"), all) << "as if they had been named";
    // An index of several arrays is read as all of them.
    ASSERT_EQ(isochron({"build", "a.isochron", "-o", "b.isochron"}).status, 0);
    std::filesystem::rename(folder.path() / "b.isochron", folder.path() / "a.isochron");
    EXPECT_THAT(names_of_arrays(), ElementsAre("rho", "heat", "wind.magnitude"));
    EXPECT_EQ(found("heat", 0.15, 3), active_of_negative(3, 0.15));
}

TEST_F(ArraysCommand, WhereNoneIsNamedTheCommandForEachIsToldAndWorks) {
    const ChildResult told = isochron(build({}));
    EXPECT_EQ(told.status, 1);
    EXPECT_THAT(told.err, HasSubstr("several arrays"));
    std::istringstream lines(told.err);
    std::size_t commands = 0;
    for (std::string line; std::getline(lines, line);) {
        if (!line.starts_with("isochron build 't?.vtk' -o a.isochron --"))
            continue;
        ++commands;
        std::vector<std::string> more;
        std::istringstream words(line.substr(line.find(" --") + 1));
        for (std::string word; words >> word;)
            more.push_back(word);
        EXPECT_EQ(isochron(build(more)).status, 0) << line;
    }
    EXPECT_EQ(commands, 4u) << told.err; // rho, heat, the magnitude of wind, and all
}

// All that may be typed before them: the part advice of each_command.py.
TEST_F(ArraysCommand, BehindTwoDashesTheCommandForEachHasItsFiles) {
    std::string vectors = file_of(0, {"wind"});
    vectors += vectors.substr(vectors.find("VECTORS")).replace(8, 4, "swirl");
    folder.write("v.vtk", vectors);
    // A component goes with one array.
    EXPECT_THAT(
        isochron(as_words("build -o a.isochron --component 1 -- v.vtk")).err,
        testing::StartsWith("isochron build -o a.isochron --component 1 --array wind -- v.vtk\n"
                            "isochron build -o a.isochron --component 1 --array swirl -- v.vtk\n"
                            "isochron: v.vtk: several arrays"));
}

TEST_F(ArraysCommand, WhatIsComputedMayBeAmongThem) {
    const ChildResult made = isochron(build(as_words(
        "--array rho --array rho.gradient --array wind.vorticity --array wind.q-criterion")));
    ASSERT_EQ(made.status, 0) << made.err;
    EXPECT_THAT(names_of_arrays(),
                ElementsAre("rho", "rho.gradient", "wind.vorticity", "wind.q-criterion"));
    EXPECT_EQ(found("rho", 0.15, 3), active(3, 0.15));
    EXPECT_GT(found("rho.gradient", 0.5, 3).size(), 10u);
}

TEST_F(ArraysCommand, AppendingGoesOnWithAllAndRefusesASourceThatLacksOne) {
    ASSERT_EQ(isochron(build(kThree, "t[01].vtk")).status, 0);
    const std::string before = folder.read("a.isochron");
    folder.write("t2.vtk", file_of(2, {"rho", "wind"}));
    expect_failure(isochron(build({"--append"})), 1, "heat");
    EXPECT_EQ(folder.read("a.isochron"), before);
    folder.write("t2.vtk", file_of(2, {"rho", "heat", "wind"}));
    expect_failure(isochron(build({"--append", "--array", "rho", "--array", "heat"})), 1,
                   "it holds the arrays rho, heat, wind.1, given are rho, heat");
    const ChildResult appended = isochron(build({"--append"}));
    ASSERT_EQ(appended.status, 0) << appended.err;
    EXPECT_THAT(names_of_arrays(), ElementsAre("rho", "heat", "wind.1"));
    EXPECT_EQ(isochron({"verify", "a.isochron"}).status, 0);
    for (const std::size_t step : {0u, 4u}) {
        EXPECT_EQ(found("rho", 0.15, step), active(step, 0.15));
        EXPECT_EQ(found("heat", 0.15, step), active_of_negative(step, 0.15));
    }
    EXPECT_THAT(isochron(build({"--append"})).out, HasSubstr("holds every step"));
}

TEST_F(ArraysCommand, TheyMayReferToTheirFiles) {
    ASSERT_EQ(isochron(build({"--refer", "--array", "rho", "--array", "heat"})).status, 0);
    EXPECT_EQ(found("heat", 0.15, 3), active_of_negative(3, 0.15));
    EXPECT_EQ(isochron({"verify", "a.isochron"}).status, 0);
}

TEST_F(ArraysCommand, OptionsOfOneArrayAreRefusedForSeveral) {
    const auto with = [&](std::vector<std::string> more) {
        more.insert(more.begin(), {"--array", "rho", "--array", "heat"});
        return isochron(build(more));
    };
    expect_failure(with({"--component", "0"}), 2, "with several arrays add it to a name");
    expect_failure(with({"--value-unit", "K"}), 2, "expected with one array only");
    expect_failure(with({"--all-arrays"}), 2, "expected one of them");
    expect_failure(isochron(build({"--array", "rho", "--array", "rho"})), 1,
                   "array rho is given twice");
}

} // namespace
} // namespace isochron::app
