// `isochron export`: what VTK reads of the files is VTK's own surface, and what is refused leaves
// nothing.
#include "app/text.h"
#include "tests/app/commands/command_line.h"

#include <nlohmann/json.hpp>

#include <array>
#include <cstdlib>
#include <filesystem>
#include <map>

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
    expect_done(as_words("build t0.vti t1.vti --array v --color c -o a.isochron"));
    for (const std::string format : {"ply", "stl", "obj", "vtp", "glb", "glb-animation", "usda"}) {
        const std::string extension = format == "glb-animation" ? "glb" : format;
        std::vector<std::string> all{
            "export", "a.isochron", "--isovalue", "0.25", "--isovalue",
            "-0.4",   "--format",   format,       "-o",   format + "." + extension};
        if (format != "stl")
            all.insert(all.end(), {"--color-by", "c"});
        expect_done(all);
    }
    with_vtk("check");
}

TEST_F(ExportCommand, WritesTheActiveCellsAsATable) {
    build();
    expect_done(as_words("export a.isochron --isovalue 0.1 --steps 1:3:2 -o c.csv"));
    for (const std::size_t step : {1, 3}) {
        std::istringstream table(folder.read(fmt::format("c_{:04}.csv", step)));
        std::string line;
        std::getline(table, line);
        EXPECT_EQ(line, "surface,isovalue,id,x,y,z,nx,ny,nz,number,time,time_unit,length_unit");
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
            EXPECT_THAT(line, testing::EndsWith(fmt::format(",0,{},,", step)));
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

TEST_F(ExportCommand, ACroppedSurfaceIsThatOfCroppedData) {
    build();
    expect_done(
        as_words("build t*.raw --dims 14 11 9 --type f32 --crop 1:9,0:7,2:7 -o part.isochron"));
    const std::vector<std::string> how =
        as_words("--isovalue 0.1 --steps 0 -o whole.obj --no-normals");
    std::vector<std::string> whole{"export", "a.isochron", "--crop", "1:9,0:7,2:7"};
    std::vector<std::string> part{"export", "part.isochron"};
    whole.insert(whole.end(), how.begin(), how.end());
    part.insert(part.end(), how.begin(), how.end());
    *std::ranges::find(part, "whole.obj") = "part.obj";
    expect_done(whole);
    expect_done(part);
    const auto triangles = [&](const std::string& name) {
        std::istringstream file(folder.read(name));
        std::vector<std::string> places, found;
        for (std::string line; std::getline(file, line);) {
            if (line.starts_with("v "))
                places.push_back(line);
            if (!line.starts_with("f "))
                continue;
            std::array<unsigned, 3> at{};
            EXPECT_EQ(std::sscanf(line.c_str(), "f %u %u %u", &at[0], &at[1], &at[2]), 3) << line;
            found.push_back(places[at[0] - 1] + places[at[1] - 1] + places[at[2] - 1]);
        }
        std::ranges::sort(found);
        return found;
    };
    EXPECT_GT(triangles("part.obj").size(), 10u);
    EXPECT_EQ(triangles("whole.obj"), triangles("part.obj"));
}

TEST_F(ExportCommand, EveryGlbKeepsTheRulesOfItsFormat) {
    build();
    const std::vector<std::vector<std::string>> ways{
        {},
        {"--steps", "0:1", "--format", "glb-animation"},
        {"--steps", "0:3", "--format", "glb-animation", "--compress"},
        {"--steps", "0", "--quantize"},
        {"--steps", "0", "--compress"},
        {"--steps", "0", "--compress", "--quantize"},
        {"--steps", "0", "--no-normals", "--compress"},
        {"--steps", "0", "--crop", "0:1,0:1,0:1"}};
    std::string files;
    for (std::size_t i = 0; i < ways.size(); ++i) {
        const std::string name = fmt::format("way{}.glb", i);
        std::vector<std::string> all{"export",     "a.isochron", "--isovalue", "0.1",
                                     "--isovalue", "-0.3",       "-o",         name};
        all.insert(all.end(), ways[i].begin(), ways[i].end());
        expect_done(all);
    }
    const auto check = [&](const std::string& names) {
        return std::system(fmt::format("cd {} && /usr/bin/python3 "
                                       "{}/tests/app/commands/gltf_check.py {} > checked 2>&1",
                                       folder.path().string(), test_support::source_root(), names)
                               .c_str());
    };
    EXPECT_EQ(check("*.glb"), 0) << folder.read("checked");
    // What is packed is what is not.
    const auto triangles = [&](const std::string& name) {
        EXPECT_EQ(check(name), 0);
        return folder.read("checked").substr(name.size());
    };
    EXPECT_EQ(triangles("way3.glb"), triangles("way5.glb"));
    EXPECT_EQ(triangles("way4.glb"), triangles("way6.glb"));
    EXPECT_LT(fs::file_size(folder.path() / "way5.glb"),
              fs::file_size(folder.path() / "way3.glb") / 2);
    // The check sees a changed number.
    std::string damaged = folder.read("way3.glb");
    damaged[damaged.size() - 9] = '\x7f';
    folder.write("damaged.glb", damaged);
    EXPECT_NE(check("damaged.glb"), 0);
}

TEST_F(ExportCommand, AClippedSurfaceLiesOnOneSideOfItsPlane) {
    build();
    const auto places = [&](const std::string& name, const std::vector<std::string>& more) {
        std::vector<std::string> all{"export",  "a.isochron", "--isovalue", "0.1",
                                     "--steps", "0",          "-o",         name};
        all.insert(all.end(), more.begin(), more.end());
        expect_done(all);
        std::istringstream file(folder.read(name));
        std::vector<std::array<double, 3>> found;
        for (std::string line; std::getline(file, line);) {
            std::array<double, 3> at{};
            if (std::sscanf(line.c_str(), "v %lf %lf %lf", &at[0], &at[1], &at[2]) == 3)
                found.push_back(at);
        }
        return found;
    };
    const auto whole = places("whole.obj", {});
    const auto side = places("side.obj", {"--clip", "6.3", "5", "4", "2", "0", "2"});
    const auto other = places("other.obj", {"--clip", "6.3", "5", "4", "-2", "0", "-2"});
    const auto share = [&](const auto& part) { return part.size() * 100 / whole.size(); };
    EXPECT_GT(share(side), 10u);
    EXPECT_GT(share(other), 10u);
    EXPECT_LT(side.size() + other.size(), whole.size() + 1) << "none is on both sides";
    EXPECT_GT(share(side) + share(other), 50u) << "what crosses the plane alone is missing";
    for (const auto& at : side)
        EXPECT_LE(at[0] + at[2], 10.3 + 1e-5);
    for (const auto& at : other)
        EXPECT_GE(at[0] + at[2], 10.3 - 1e-5);
    expect_refused(as_words("--isovalue 0.1 -o c.obj --clip 0 0 0 0 0 0"), 2,
                   "--clip 0 0 0 0 0 0: expected a point on the plane and its normal");
}

TEST_F(ExportCommand, ASimplifiedSurfaceHasFewerTrianglesAndSaysItsError) {
    expect_done({"generate", "sphere", "--steps", "1", "-o", "s"});
    expect_done({"build", "s", "-o", "s.isochron"});
    const auto exported = [&](const std::string& name, const std::vector<std::string>& more) {
        std::vector<std::string> all{"export", "s.isochron", "--isovalue", "100",
                                     "-o",     name,         "--json"};
        all.insert(all.end(), more.begin(), more.end());
        return nlohmann::json::parse(expect_done(all).out);
    };
    const auto whole = exported("whole.ply", {});
    const auto fewer = exported("fewer.ply", {"--simplify", "0.1"});
    EXPECT_LT(fewer.at("triangles"), 0.4 * whole.at("triangles").get<double>());
    EXPECT_GT(fewer.at("triangles"), 100);
    EXPECT_LE(fewer.at("error"), 0.1);
    EXPECT_GT(fewer.at("error"), 0);
    EXPECT_EQ(fewer.at("error_cells"), fewer.at("error")) << "cells have sides of 1";
    EXPECT_EQ(fewer.at("cells"), whole.at("cells"));
    // A closed surface stays closed: Euler's number of a sphere, V - F / 2 = 2.
    EXPECT_EQ(fewer.at("vertices").get<int>() - fewer.at("triangles").get<int>() / 2, 2);
    exported("again.ply", {"--simplify", "0.1"});
    EXPECT_EQ(folder.read("again.ply"), folder.read("fewer.ply")) << "the same bytes again";
    EXPECT_THAT(
        expect_done(as_words("export s.isochron --isovalue 100 --simplify 0.1 -o about.stl")).out,
        HasSubstr("the surface has moved by at most 0."));
    // A distance in another unit than the user had in mind; nothing is left of the surface.
    const ChildResult refused = isochron(
        {"export", "s.isochron", "--isovalue", "100", "--simplify", "1e4", "-o", "none.stl"});
    EXPECT_EQ(refused.status, 1);
    EXPECT_THAT(refused.err,
                HasSubstr(fmt::format("of {} triangles at isovalue 100",
                                      grouped(whole.at("triangles").get<std::uint64_t>()))));
    EXPECT_THAT(refused.err, HasSubstr("isochron: step 0: --simplify 1e4: leaves 4 of "));
    EXPECT_THAT(refused.err, HasSubstr("a smaller distance is needed\n"));
    EXPECT_FALSE(std::filesystem::exists(folder.path() / "none.stl"));
}

TEST_F(ExportCommand, ASurfaceIsSimplifiedByADistanceInCellsOrInTheUnitOfTheFile) {
    expect_done(build_of("t*.raw", {"--spacing", "0.002", "0.004", "0.008", "--length-unit", "m"}));
    const auto error = [&](const std::vector<std::string>& more) {
        std::vector<std::string> all =
            as_words("export a.isochron --isovalue 0.1 --steps 0 -o s.ply --json --force");
        all.insert(all.end(), more.begin(), more.end());
        return nlohmann::json::parse(expect_done(all).out);
    };
    const auto cells = error({"--simplify", "0.5cells"});
    EXPECT_LE(cells.at("error_cells"), 0.5);
    EXPECT_GT(cells.at("error_cells"), 0);
    EXPECT_DOUBLE_EQ(cells.at("error"), 0.002 * cells.at("error_cells").get<double>());
    for (const auto& [distance, unit] :
         {std::pair("0.001", "m"), {"1", "mm"}, {"0.5 cells", "mm"}}) {
        const auto other = error({"--simplify", distance, "--unit", unit});
        EXPECT_EQ(other.at("triangles"), cells.at("triangles")) << distance << unit;
        EXPECT_NEAR(other.at("error_cells"), cells.at("error_cells"), 1e-5) << distance << unit;
    }
    for (const std::string wrong :
         {"0", "-1", "nan", "inf", "1e999", "0.5cell ", "5miles", "cells"})
        expect_refused({"--isovalue", "0.1", "-o", "w.ply", "--simplify=" + wrong}, 2,
                       "--simplify " + wrong + ": expected a distance above 0");
    expect_refused(as_words("--isovalue 0.1 -o w.ply --simplify 1e-12"), 1,
                   "step 0: --simplify 1e-12: a file of this precision moves vertices by up to");
}

/// Whether each format has what the table of the guide says, beside two surfaces of a step.
TEST_F(ExportCommand, EachFormatCarriesWhatTheGuideSays) {
    with_vtk("make");
    expect_done(as_words("build t0.vti t1.vti --array v --color c --length-unit mm --time-unit s "
                         "--time-step 0.5 -o a.isochron"));
    // Unit, time, number of the surface, colors, normals, values: what stands in the file for it.
    const std::map<std::string, std::array<std::string, 6>> signs{
        {"ply",
         {"coordinates in mm", "time 0.5 s", "property uchar surface", "property uchar red",
          "property float nx", "property float value"}},
        {"vtp",
         {"coordinates in mm", "format=\"ascii\">0.5<", "Name=\"surface\"", "Name=\"color\"",
          "Name=\"Normals\"", "Name=\"c\""}},
        {"glb",
         {R"("length_unit":"mm")", R"("time":0.5,"time_unit":"s")", R"("extras":{"surface":1,)",
          "COLOR_0", "NORMAL", ""}},
        {"glb-animation",
         {R"("length_unit":"mm")", R"("time":0.5,"time_unit":"s")", R"("extras":{"surface":1,)",
          "COLOR_0", "NORMAL", ""}},
        {"usda",
         {"lengthUnit = \"mm\"", "times = [0.5]", "int surface = 1\n", "primvars:displayColor",
          "normal3f[] normals", "primvars:value"}},
        {"obj", {"coordinates in mm", "time 0.5 s", "# surface 1: v -0.4", "", "\nvn ", ""}},
        {"stl", {"unit=mm", "", "", "", "", ""}},
        {"csv", {",mm\n", ",1,0.5,s,", ",number,", "", ",nx,ny,nz,", ""}},
    };
    std::map<std::string, std::vector<std::string>> said; // rows of the guide's table
    std::istringstream guide(folder.read(test_support::source_root() + "/docs/guide/export.md"));
    for (std::string line; std::getline(guide, line);)
        if (line.starts_with("| `")) {
            std::vector<std::string> cells;
            std::istringstream row(line.substr(1));
            for (std::string cell; std::getline(row, cell, '|');)
                cells.push_back(cell.substr(
                    cell.find_first_not_of(' ') == std::string::npos ? cell.size() : 1));
            said[cells[0].substr(1, cells[0].find('`', 1) - 1)] = cells;
        }
    ASSERT_EQ(said.size(), signs.size());
    for (const auto& [format, of] : signs) {
        std::vector<std::string> all{"export",     "a.isochron", "--isovalue", "0.25",
                                     "--isovalue", "-0.4",       "--steps",    "1",
                                     "--format",   format,       "-o",         format + "/"};
        if (format != "stl" && format != "csv")
            all.insert(all.end(), {"--color-by", "c"});
        expect_done(all);
        std::string file;
        for (const auto& entry : fs::directory_iterator(folder.path() / format))
            file += folder.read(entry.path());
        ASSERT_TRUE(said.contains(format)) << format;
        for (std::size_t i = 0; i < of.size(); ++i) {
            bool has = !of[i].empty();
            EXPECT_THAT(file, HasSubstr(of[i])) << format;
            if (format == "obj" && i == 3) { // after the coordinates
                const std::size_t at = file.find("\nv ") + 1;
                const std::string line = file.substr(at, file.find('\n', at) - at);
                has = std::ranges::count(line, ' ') == 6;
            }
            if (format == "stl" && i == 2) // a file for each
                has = fs::exists(folder.path() / "stl/a_surface2.stl");
            EXPECT_EQ(has, !said[format].at(i + 2).empty())
                << format << ", column " << i + 2 << " of the table: " << said[format][i + 2];
        }
    }
}

TEST_F(ExportCommand, CountsTheCellsThatAreLeftByCuts) {
    build();
    const auto count = [&](const std::vector<std::string>& more) {
        std::vector<std::string> all =
            as_words("export a.isochron --isovalue 0.1 --steps 0 -o c.ply --json --force");
        all.insert(all.end(), more.begin(), more.end());
        return nlohmann::json::parse(expect_done(all).out).at("cells").get<std::size_t>();
    };
    const auto cells = [&](auto&& has) {
        return static_cast<std::size_t>(
            std::ranges::count_if(active(0, 0.1), [&](std::uint32_t id) {
                return has(id % (kX - 1), id / (kX - 1) % (kY - 1), id / (kX - 1) / (kY - 1));
            }));
    };
    EXPECT_EQ(count({}), active(0, 0.1).size());
    const std::size_t within = cells([](std::size_t x, std::size_t y, std::size_t z) {
        return x >= 2 && x < 9 && y >= 1 && y < 7 && z >= 2 && z < 6;
    });
    EXPECT_EQ(count({"--crop", "2:9,1:7,2:6"}), within);
    // A plane through cells leaves those before it, and those with a triangle before it.
    const auto before = [&](std::size_t end) {
        return cells([&](std::size_t x, std::size_t, std::size_t) { return x < end; });
    };
    const std::size_t clipped = count({"--clip", "6.5", "0", "0", "1", "0", "0"});
    EXPECT_GE(clipped, before(6));
    EXPECT_LE(clipped, before(7));
    EXPECT_EQ(count(as_words("--crop 2:9,1:7,2:6 --clip 9 0 0 1 0 0")), within);
}

TEST_F(ExportCommand, AQuantizedSurfaceIsWhereTheOtherOneIs) {
    build();
    const auto document = [&](const std::string& name, std::string& binary) {
        const std::string bytes = folder.read(name);
        std::uint32_t size = 0;
        std::memcpy(&size, bytes.data() + 12, sizeof size);
        binary = bytes.substr(20 + size + 8);
        return nlohmann::json::parse(bytes.substr(20, size));
    };
    for (const bool quantized : {false, true}) {
        std::vector<std::string> all =
            as_words("export a.isochron --isovalue 0.1 --steps 0 -o plain.glb");
        if (quantized) {
            all.back() = "small.glb";
            all.emplace_back("--quantize");
        }
        expect_done(all);
    }
    std::string plain_bytes, small_bytes;
    const auto plain = document("plain.glb", plain_bytes),
               small = document("small.glb", small_bytes);
    EXPECT_EQ(small.at("extensionsRequired"), nlohmann::json({"KHR_mesh_quantization"}));
    EXPECT_FALSE(plain.contains("extensionsRequired"));
    const auto& node = small.at("nodes")[1];
    const double scale = node.at("scale")[0];
    const std::size_t count = small.at("accessors")[0].at("count");
    EXPECT_EQ(plain.at("accessors")[0].at("count"), count);
    for (std::size_t i = 0; i < count; ++i) {
        double squared = 0;
        for (std::size_t axis = 0; axis < 3; ++axis) {
            float there = 0;
            std::uint16_t number = 0;
            std::memcpy(&there, plain_bytes.data() + 12 * i + 4 * axis, sizeof there);
            std::memcpy(&number, small_bytes.data() + 8 * i + 2 * axis, sizeof number);
            const double here = node.at("translation")[axis].get<double>() + scale * number / 65535;
            ASSERT_NEAR(here, there, 0.51 * scale / 65535 + 1e-6) << i;
            squared += (here - there) * (here - there);
        }
        ASSERT_LE(std::sqrt(squared), scale / 75000 + 1e-6) << i << ": as the help says";
    }
    EXPECT_LT(small_bytes.size(), 0.75 * static_cast<double>(plain_bytes.size()));
    expect_refused({"--isovalue", "0", "-o", "q.ply", "--quantize"}, 2, "is for glb");
    expect_refused(as_words("--isovalue 0 -o q.csv --crop 0:1,0:1,0:1"), 2, "holds cells");
    expect_refused(as_words("--isovalue 0 -o q.ply --crop 0:1,0:1"), 2, "X0:X1,Y0:Y1,Z0:Z1");
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
    const std::vector<std::string> command =
        as_words("export a.isochron --isovalue 0.1 --steps 0 -o");
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

/// Wide grids of thin layers, as of weather: what the note says is what a vertex moves at most.
TEST_F(ExportCommand, WhatSinglePrecisionMovesIsSaidWhereItIsMuchOfACell) {
    const auto coordinates = [&](const std::string& file, std::size_t bytes) {
        const std::string text = folder.read(file);
        const std::size_t header = text.find("end_header\n");
        const std::size_t at = text.find("element vertex ") + 15;
        std::vector<double> all;
        const std::size_t count = std::stoul(text.substr(at));
        for (std::size_t i = 0; i < count; ++i)
            for (std::size_t axis = 0; axis < 3; ++axis) {
                const std::size_t stride = 3 * bytes; // without normals
                const char* const from = text.data() + header + 11 + i * (stride + 4) +
                                         axis * bytes; // and a color, a number
                double wide = 0;
                float narrow = 0;
                std::memcpy(bytes == 8 ? static_cast<void*>(&wide) : &narrow, from, bytes);
                all.push_back(bytes == 8 ? wide : narrow);
            }
        return all;
    };
    for (const auto& [spacing, said] : {std::pair{"300000", true}, {"3000", true}, {"3", false}}) {
        expect_done(build_of(
            "t*.raw", {"--spacing", spacing, spacing, "1", "--length-unit", "m", "--force"}));
        const std::vector<std::string> command =
            as_words("export a.isochron --isovalue 0.1 --steps 0 --no-normals --force -o");
        const auto with = [&](const std::vector<std::string>& more) {
            std::vector<std::string> all = command;
            all.insert(all.end(), more.begin(), more.end());
            return expect_done(all);
        };
        const std::string note = with({"single.ply"}).err;
        EXPECT_THAT(with({"double.ply", "--precision", "double"}).err,
                    Not(HasSubstr("single precision")));
        const auto single = coordinates("single.ply", 4), exact = coordinates("double.ply", 8);
        ASSERT_EQ(single.size(), exact.size());
        double most = 0;
        for (std::size_t i = 0; i + 2 < exact.size(); i += 3)
            most = std::max(most, std::hypot(single[i] - exact[i], single[i + 1] - exact[i + 1],
                                             single[i + 2] - exact[i + 2]));
        ASSERT_EQ(note.find("off by up to ") != note.npos, said) << note;
        if (!said) {
            EXPECT_LE(most, 1e-3) << "of a cell's shortest side";
            continue;
        }
        const double bound = std::stod(note.substr(note.find("off by up to ") + 13));
        EXPECT_LE(most, bound);
        EXPECT_GT(most, 0.2 * bound);
        EXPECT_THAT(note, HasSubstr("--precision double keeps them"));
    }
}

TEST_F(ExportCommand, WhereNoCellHasTheIsovalueFilesAreEmptyAndThatIsSaid) {
    build();
    for (const std::string format :
         {"ply", "stl", "obj", "vtp", "glb", "glb-animation", "usda", "csv"}) {
        const ChildResult result =
            expect_done({"export", "a.isochron", "--isovalue", "5", "--steps", "0:1", "--format",
                         format, "-o", format + "/"});
        EXPECT_THAT(result.err, HasSubstr("isovalue 5 lies beyond the data"));
        EXPECT_THAT(
            result.err,
            HasSubstr("2 of 2 steps have no surface at this isovalue, the first is step 0"));
        EXPECT_THAT(result.out,
                    HasSubstr(format == "csv" ? "0 cells" : "0 cells, 0 vertices, 0 triangles"));
    }
    const auto json = nlohmann::json::parse(
        expect_done(as_words("export a.isochron --isovalue 5 --steps 0:1 -o none.ply --json")).out);
    EXPECT_EQ(json.at("files"), nlohmann::json({"none_0000.ply", "none_0001.ply"}));
    EXPECT_EQ(json.at("empty_steps"), nlohmann::json({0, 1}));
}

TEST_F(ExportCommand, WhatItCannotDoItRefusesInALine) {
    build();
    const std::vector<std::pair<std::vector<std::string>, std::string>> wrong{
        {{"--isovalue", "0", "-o", "a.step"}, "expected a name that ends in .ply"},
        {{"--isovalue", "0", "-o", "out/"}, "or a folder and --format, got out/"},
        {{"--isovalue", "0", "-o", "a.glb", "--precision", "double"},
         "--precision double: is for ply, obj, vtp, csv, not glb"},
        {{"--isovalue", "0", "-o", "a.csv", "--color-by", "t"},
         "--color-by: is for ply, obj, vtp, glb, glb-animation, usda, not csv"},
        {{"--isovalue", "0", "-o", "a.stl", "--color-by", "t"}, "usda, not stl"},
        {{"--isovalue", "0", "-o", "a.ply", "--range", "0", "1"},
         "--color-range requires --color-by"},
        {{"--isovalue", "0", "-o", "a.csv", "--no-normals"}, "--no-normals: is for ply, obj"},
        {{"--isovalue", "0", "-o", "a.glb", "--rate", "5"},
         "--rate: is for glb-animation, usda, not glb"},
        {{"--isovalue", "0", "-o", "a.ply", "--steps", "0:5"},
         "--steps 0:5: expected steps 0 to 4"},
        {{"--isovalue", "0", "-o", "a.ply", "--steps", "3:1"}, "the first not after the last"},
        {{"--isovalue", "0", "-o", "a.ply", "--steps", "0:4:0"}, "a stride above 0"},
        {{"--isovalue", "0", "-o", "a.ply", "--steps", "1-3"}, "FIRST:LAST:STRIDE"},
        {{"--isovalue", "0", "-o", "a.ply", "--steps", ":3"}, "FIRST:LAST:STRIDE"},
        {{"--isovalue", "0", "-o", "a.ply", "--unit", "mm"}, "the data have no unit of length"},
        {{"--isovalue", "0", "-o", "a.ply", "--unit", "furlong"}, "expected m, km, cm"},
        {{"--isovalue", "nan", "-o", "a.ply"}, "--isovalue: expected a finite number"},
        {{"--isovalue", "0", "-o", "a.ply", "--color-map", "mauve", "--color-by", "t"},
         "to color by"},
    };
    for (const auto& [arguments, said] : wrong)
        expect_refused(arguments, said == "to color by" ? 1 : 2, said);
    expect_refused(as_words("--isovalue 0 -o a.ply --array none"), 1, "no array none");
    std::vector<std::string> many{"-o", "a.ply"};
    for (int i = 0; i < 9; ++i)
        many.insert(many.end(), {"--isovalue", std::to_string(i)});
    expect_refused(many, 2, "--isovalue: expected at most 8 of them, got 9");
    expect_refused(as_words("--isovalue 0.1 -o a.ply --simplify 1e-9"), 1,
                   "a file of this precision moves vertices by up to");
}

} // namespace
} // namespace isochron::app
