// `isochron export`: what VTK reads of the files is VTK's own surface, and what is refused leaves
// nothing.
#include "tests/app/commands/command_line.h"

#include <nlohmann/json.hpp>

#include <cstdlib>
#include <filesystem>

namespace isochron::app {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

class ExportCommand : public CommandLine {
  protected:
    void build() { expect_done(build_of("t*.raw")); }
    ChildResult expect_done(const std::vector<std::string>& arguments) {
        ChildResult result = isochron(arguments);
        EXPECT_EQ(result.status, 0) << result.err;
        return result;
    }
    void expect_refused(const std::vector<std::string>& more, int status, const std::string& said) {
        std::vector<std::string> all{"export", "a.isochron"};
        all.insert(all.end(), more.begin(), more.end());
        const std::size_t before = files();
        const ChildResult result = isochron(all);
        EXPECT_EQ(result.status, status) << result.err;
        EXPECT_THAT(result.err, HasSubstr(said));
        EXPECT_EQ(files(), before) << "something was written";
    }
    std::size_t files() const {
        return static_cast<std::size_t>(
            std::distance(fs::recursive_directory_iterator(folder.path()), {}));
    }
    void with_vtk(const std::string& what) {
        const std::string command =
            fmt::format("PYTHONDONTWRITEBYTECODE=1 /usr/bin/python3 "
                        "{}/tests/app/commands/exported_with_vtk.py {} {}",
                        test_support::source_root(), what, folder.path().string());
        ASSERT_EQ(std::system(command.c_str()), 0) << what;
    }
};

TEST_F(ExportCommand, EveryFormatHoldsTheSurfacesOfVtk) {
    with_vtk("make");
    expect_done({"build", "t0.vti", "t1.vti", "--array", "v", "--color", "c", "-o", "a.isochron"});
    for (const std::string format : {"ply", "stl", "obj", "vtp", "glb", "glb-animation", "usda"}) {
        const std::string extension = format == "glb-animation" ? "glb" : format;
        expect_done({"export", "a.isochron", "--isovalue", "0.25", "--isovalue", "-0.4",
                     "--color-by", "c", "--format", format, "-o", format + "." + extension});
    }
    with_vtk("check");
}

TEST_F(ExportCommand, WritesTheActiveCellsAsATable) {
    build();
    expect_done({"export", "a.isochron", "--isovalue", "0.1", "--steps", "1:3:2", "-o", "c.csv"});
    for (const std::size_t step : {1, 3}) {
        std::istringstream table(folder.read(fmt::format("c_{:04}.csv", step)));
        std::string line;
        std::getline(table, line);
        EXPECT_EQ(line, "surface,isovalue,id,x,y,z,nx,ny,nz");
        std::vector<std::uint32_t> ids;
        while (std::getline(table, line)) {
            unsigned surface = 0;
            std::uint32_t id = 0;
            double isovalue = 0, x = 0, y = 0, z = 0;
            ASSERT_EQ(std::sscanf(line.c_str(), "%u,%lf,%u,%lf,%lf,%lf", &surface, &isovalue, &id,
                                  &x, &y, &z),
                      6)
                << line;
            EXPECT_EQ(surface, 1u);
            EXPECT_EQ(isovalue, 0.1);
            EXPECT_EQ(x, id % (kX - 1) + 0.5);
            EXPECT_EQ(y, id / (kX - 1) % (kY - 1) + 0.5);
            EXPECT_EQ(z, id / (kX - 1) / (kY - 1) + 0.5);
            ids.push_back(id);
        }
        EXPECT_EQ(ids, active(step, 0.1));
    }
    EXPECT_FALSE(fs::exists(folder.path() / "c_0002.csv"));
}

TEST_F(ExportCommand, TheBytesAreTheSameOnOneProcessor) {
    build();
    for (const std::string format : {"ply", "vtp", "glb-animation", "usda"}) {
        expect_done({"export", "a.isochron", "--isovalue", "0.1", "--format", format, "-o",
                     format + "-all/"});
        const ChildResult one =
            run_child("/usr/bin/taskset",
                      {"-c", "0", test_support::binary_root() + "/isochron", "export", "a.isochron",
                       "--isovalue", "0.1", "--format", format, "-o", format + "-one/"},
                      folder.path());
        ASSERT_EQ(one.status, 0) << one.err;
        for (const auto& entry : fs::directory_iterator(folder.path() / (format + "-all"))) {
            const std::string name = entry.path().filename().string();
            EXPECT_TRUE(folder.read(format + "-all/" + name) ==
                        folder.read(format + "-one/" + name))
                << name;
        }
    }
}

TEST_F(ExportCommand, FarFromTheOriginPlacesKeepTheirShape) {
    expect_done(build_of("t*.raw", {"--origin", "500000", "4000000", "0", "--length-unit", "m"}));
    const auto first_x = [&](const std::string& file, bool wide) {
        const std::string bytes = folder.read(file);
        const std::size_t at = bytes.find("end_header\n") + 11;
        if (wide) {
            double x = 0;
            std::memcpy(&x, bytes.data() + at, sizeof x);
            return x;
        }
        float x = 0;
        std::memcpy(&x, bytes.data() + at, sizeof x);
        return double(x);
    };
    const std::vector<std::string> command{"export",  "a.isochron", "--isovalue", "0.1",
                                           "--steps", "0",          "-o"};
    const auto with = [&](const std::vector<std::string>& more) {
        std::vector<std::string> all = command;
        all.insert(all.end(), more.begin(), more.end());
        expect_done(all);
    };
    with({"single.ply"});
    with({"double.ply", "--precision", "double"});
    with({"km.ply", "--unit", "km"});
    EXPECT_THAT(folder.read("single.ply"),
                HasSubstr("coordinates in m, less origin 500000 4000000 0"));
    EXPECT_THAT(folder.read("double.ply"), HasSubstr("coordinates in m, less origin 0 0 0"));
    EXPECT_THAT(folder.read("km.ply"), HasSubstr("coordinates in km, less origin 500 4000 0"));
    const double x = first_x("single.ply", false);
    EXPECT_NEAR(first_x("double.ply", true), 500000 + x, 1e-5);
    EXPECT_NEAR(first_x("km.ply", false), x / 1000, 1e-8);
}

TEST_F(ExportCommand, WhereNoCellHasTheIsovalueFilesAreEmptyAndThatIsSaid) {
    build();
    for (const std::string format :
         {"ply", "stl", "obj", "vtp", "glb", "glb-animation", "usda", "csv"}) {
        const ChildResult result =
            expect_done({"export", "a.isochron", "--isovalue", "5", "--steps", "0:1", "--format",
                         format, "-o", format + "/"});
        EXPECT_THAT(result.err, HasSubstr("isovalue 5 lies beyond the data"));
        EXPECT_THAT(result.err,
                    HasSubstr("no cell has the isovalue in 2 of 2 steps, the first is 0"));
        EXPECT_THAT(result.out, HasSubstr("0 cells, 0 vertices, 0 triangles"));
    }
    const auto json =
        nlohmann::json::parse(expect_done({"export", "a.isochron", "--isovalue", "5", "--steps",
                                           "0:1", "-o", "none.ply", "--json"})
                                  .out);
    EXPECT_EQ(json.at("files"), nlohmann::json({"none_0000.ply", "none_0001.ply"}));
    EXPECT_EQ(json.at("empty_steps"), nlohmann::json({0, 1}));
}

TEST_F(ExportCommand, WhatItCannotDoItRefusesInALine) {
    build();
    const std::vector<std::pair<std::vector<std::string>, std::string>> wrong{
        {{"--isovalue", "0", "-o", "a.step"}, "expected a name that ends in .ply"},
        {{"--isovalue", "0", "-o", "out/"}, "or a folder and --format, got out/"},
        {{"--isovalue", "0", "-o", "a.glb", "--precision", "double"}, "glb has single precision"},
        {{"--isovalue", "0", "-o", "a.ply", "--steps", "0:5"},
         "--steps 0:5: expected steps 0 to 4"},
        {{"--isovalue", "0", "-o", "a.ply", "--steps", "3:1"}, "the first not after the last"},
        {{"--isovalue", "0", "-o", "a.ply", "--steps", "0:4:0"}, "a stride above 0"},
        {{"--isovalue", "0", "-o", "a.ply", "--steps", "1-3"}, "FIRST:LAST:STRIDE"},
        {{"--isovalue", "0", "-o", "a.ply", "--steps", ":3"}, "FIRST:LAST:STRIDE"},
        {{"--isovalue", "0", "-o", "a.ply", "--unit", "mm"}, "the data have no unit of length"},
        {{"--isovalue", "0", "-o", "a.ply", "--unit", "furlong"}, "expected m, km, cm"},
        {{"--isovalue", "nan", "-o", "a.ply"}, "--isovalue: expected a number"},
        {{"--isovalue", "0", "-o", "a.ply", "--color-map", "mauve", "--color-by", "t"},
         "to color by"},
    };
    for (const auto& [arguments, said] : wrong)
        expect_refused(arguments, said == "to color by" ? 1 : 2, said);
    expect_refused({"--isovalue", "0", "-o", "a.ply", "--array", "none"}, 1, "no array none");
    folder.write("s_0003.ply", "somebody's\n");
    expect_refused({"--isovalue", "0", "-o", "s.ply"}, 1, "s_0003.ply: exists already; --force");
    EXPECT_EQ(folder.read("s_0003.ply"), "somebody's\n");
    expect_done({"export", "a.isochron", "--isovalue", "0", "-o", "s.ply", "--force"});
    EXPECT_TRUE(folder.read("s_0003.ply").starts_with("ply\n"));
}

} // namespace
} // namespace isochron::app
