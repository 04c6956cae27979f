// The wings of each floor stand in an order, and each includes only what stands behind it.
#include "tests/house/source_tree.h"

#include <gtest/gtest.h>

#include <map>
#include <set>
#include <string>
#include <vector>

namespace isochron::house {
namespace {

namespace fs = std::filesystem;

/// A wing is a folder of its floor, a folder within `readers`, or a file at the floor's root by its
/// name without extension; `.` is every other file at the root. Wings of one step do not include each other.
using Steps = std::vector<std::vector<std::string>>;

/// From the front to the back: a wing may include those of the steps that come after its own.
const std::map<std::string, Steps> kOrder{
    {"app",
     {{"main", "python", "web"},
      {"commands"},
      {"explore"},
      {"loop"},
      {"session", "indexing", "generate"},
      {"choice", "kept"},
      {"panel", "output"},
      {"scene", "cluster", "control", "serve"},
      {"quality"},
      {"frame"},
      {"config", "command_line"},
      {"csv_field", "end_in_time", "telling"},
      {"safe_text", "text", "version"}}},
    {"index",
     {{"extraction", "indexing", "export"},
      {"measure", "detail"},
      {"search"},
      {"surface"},
      {"file"},
      {"paper", "scan", "readers/decoders"},
      {"readers/formats"},
      {"readers/process"},
      {"volume", "system"},
      {"missing_file"},
      {"json_mistake"},
      {"error", "interrupted", "lower_case", "name_pattern", "progress", "shell_word", "trimmed",
       "utf8"}}},
    {"interaction",
     {{"trackers", "recording"}, {"controls"}, {"tools"}, {"navigation"}, {"input"}, {"."}}},
    {"render", {{"drawing"}, {"culling"}, {"cells", "passes"}, {"gl"}}},
    {"stereo", {{"openxr"}, {"."}, {"context", "image_module"}}},
};

/// Wings that stand apart, and the only places that may include them. Tests may include all.
const std::map<std::string, std::set<std::string>> kApart{
    // A program of its own makes demo series; the main program has their options.
    {"app/generate", {"app/commands/command_generate"}},
    // The Python module: the interpreter loads it.
    {"app/python", {}},
    // What is asked on the command line is obeyed elsewhere.
    {"app/command_line",
     {"app/main", "app/commands", "app/explore", "app/indexing", "app/generate", "app/python"}},
    // The readers: programs of their own.
    {"index/readers/decoders", {"stereo/image_module"}},
    // The module is loaded when a picture is read or written; nobody else knows it.
    {"stereo/image_module", {"stereo/image_file"}},
};

constexpr int kNowhere = -1;

/// The wing of a file within its floor, and its step.
struct Place {
    std::string floor, wing, stem; ///< `app`, `session`, `app/session/session`
    int step = kNowhere;
};

int step_of(const Steps& steps, const std::string& wing) {
    for (int step = 0; step < static_cast<int>(steps.size()); ++step)
        for (const std::string& one : steps[step])
            if (one == wing)
                return step;
    return kNowhere;
}

Place place_of(const std::string& file) {
    const fs::path path(file);
    Place place{.floor = path.begin()->string(), .wing = {}, .stem = {}};
    const auto floor = kOrder.find(place.floor);
    if (floor == kOrder.end())
        return place;
    place.stem = (path.parent_path() / path.stem()).generic_string();
    const bool at_root = path.parent_path() == place.floor;
    place.wing = at_root ? path.stem().string() : std::next(path.begin())->string();
    if (place.wing == "readers")
        place.wing += "/" + std::next(path.begin(), 2)->string();
    place.step = step_of(floor->second, place.wing);
    if (at_root && place.step == kNowhere) {
        place.wing = ".";
        place.step = step_of(floor->second, place.wing);
    }
    return place;
}

bool may_include(const Place& from, const Place& to) {
    if (from.floor == to.floor && from.wing == to.wing)
        return true;
    if (const auto apart = kApart.find(to.floor + "/" + to.wing); apart != kApart.end())
        return apart->second.contains(from.stem) ||
               apart->second.contains(from.floor + "/" + from.wing);
    return from.floor != to.floor || from.step < to.step;
}

/// Every violation as `file:line includes what`, and every file that stands in no wing.
std::vector<std::string> includes_against_the_order(const fs::path& root) {
    std::vector<std::string> found;
    for (const char* floor : kFloors)
        for (const std::string& file : sources(root, floor)) {
            const Place from = place_of(file);
            if (from.step == kNowhere)
                found.push_back(file + " stands in no wing of the order");
            for (const Include& include : includes_of(root / file)) {
                const Place to = place_of(include.path);
                if (to.step != kNowhere && !may_include(from, to))
                    found.push_back(file + ":" + std::to_string(include.line) + " includes " +
                                    include.path);
            }
        }
    return found;
}

using Found = std::vector<std::string>;

TEST(Wings, EachIncludesOnlyWhatStandsBehindIt) {
    EXPECT_EQ(includes_against_the_order(checkout()), Found{});
}

TEST(Wings, AllOfTheOrderAreThere) {
    for (const auto& [floor, steps] : kOrder)
        for (const auto& step : steps)
            for (const std::string& wing : step) {
                const fs::path place = checkout() / floor / wing;
                EXPECT_TRUE(fs::is_directory(place) || fs::exists(place.string() + ".h") ||
                            fs::exists(place.string() + ".cpp"))
                    << place;
            }
}

TEST(Wings, WhatBreaksTheOrderIsFound) {
    const PlantedTree tree;
    // What stands in front, and a neighbor.
    tree.plant("app/config/bad.h", "#pragma once\n#include \"app/frame/frame_log.h\"\n");
    tree.plant("app/text.cpp", "#include \"app/text.h\"\n#include \"app/panel/panel.h\"\n");
    tree.plant("index/scan/good.cpp", "#include \"index/scan/bricks.h\"\n"
                                      "#include \"index/volume/grid.h\"\n");
    tree.plant("render/cells/bad.cpp", "#include \"render/passes/line_pass.h\"\n");
    // What stands apart.
    tree.plant("app/commands/command_generate.cpp", "#include \"app/generate/demo_series.h\"\n");
    tree.plant("app/session/bad.cpp", "#include \"app/generate/demo_series.h\"\n");
    tree.plant("stereo/image_file.cpp", "#include \"stereo/image_module/image_module.h\"\n");
    tree.plant("stereo/screen.cpp", "#include \"stereo/image_module/image_module.h\"\n");
    tree.plant("app/attic/box.h", "#pragma once\n");
    EXPECT_EQ(includes_against_the_order(tree.root()),
              (Found{"render/cells/bad.cpp:1 includes render/passes/line_pass.h",
                     "stereo/screen.cpp:1 includes stereo/image_module/image_module.h",
                     "app/attic/box.h stands in no wing of the order",
                     "app/config/bad.h:2 includes app/frame/frame_log.h",
                     "app/session/bad.cpp:1 includes app/generate/demo_series.h",
                     "app/text.cpp:2 includes app/panel/panel.h"}));
}

} // namespace
} // namespace isochron::house
