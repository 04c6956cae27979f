// `isochron explore` with a headset, as a separate program.
#include "tests/support/child_process.h"
#include "tests/support/eventually.h"
#include "tests/support/session_fixture.h"

#include "stereo/image_file.h"
#include "tests/support/paths.h"
#include "tests/support/virtual_display.h"

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include <csignal>
#include <cstdlib>
#include <fstream>
#include <sstream>

namespace isochron::app {
namespace {

using nlohmann::json;
using testing::HasSubstr;

class HeadsetProgram : public testing::Test {
  protected:
    HeadsetProgram() {
        build_sphere(folder_.path());
        setenv("XR_RUNTIME_JSON", (test_support::binary_root() + "/played_headset.json").c_str(),
               1);
    }
    ~HeadsetProgram() override {
        for (const char* name : {"ISOCHRON_PLAYED_HEADSET", "XR_ENABLE_API_LAYERS",
                                 "XR_CORE_VALIDATION_EXPORT_TYPE", "XR_CORE_VALIDATION_FILE_NAME"})
            unsetenv(name);
    }
    std::string file(const std::string& name) const { return (folder_.path() / name).string(); }

    void play(const json& frames) {
        folder_.write("script.json", json{{"log", file("log.jsonl")}, {"frames", frames}}.dump());
        setenv("ISOCHRON_PLAYED_HEADSET", file("script.json").c_str(), 1);
    }
    /// `hmd.toml` with one line changed.
    std::string changed_config(const std::string& line, const std::string& into) const {
        std::ifstream shipped(test_support::source_root() + "/configs/hmd.toml");
        std::string text{std::istreambuf_iterator<char>(shipped), {}};
        text.replace(text.find(line), line.size(), into);
        return folder_.write("hmd.toml", text).string();
    }
    ChildResult explore(std::vector<std::string> more, const ChildOptions& how = {}) {
        std::vector<std::string> arguments{"explore", file("sphere.isochron")};
        arguments.insert(arguments.end(), more.begin(), more.end());
        return run_child(test_support::binary_root() + "/isochron", arguments, folder_.path(), how);
    }
    /// Lines of the played headset's log that have this member.
    std::vector<json> logged(const char* member) const {
        std::vector<json> found;
        std::istringstream lines(folder_.read("log.jsonl"));
        for (std::string line; std::getline(lines, line);)
            if (const json each = json::parse(line); each.contains(member))
                found.push_back(each);
        return found;
    }

    TestFolder folder_;
};

TEST_F(HeadsetProgram, ShowsTheDataWithoutAWindowUntilItsUserLeaves) {
    play({{{"at", 0}, {"head", {0, 1.6, 0, 0, 0, 0, 1}}},
          {{"at", 90}, {"picture", file("left.ppm")}},
          {{"at", 91}, {"happens", "exit"}}});
    const ChildResult result =
        explore({"--config", "hmd", "--context", "egl", "--report", file("report.json")});
    EXPECT_EQ(result.status, 0) << result.err;
    EXPECT_THAT(result.err, HasSubstr("headset running: OpenXR, Played headset"));
    EXPECT_EQ(logged("violation"), std::vector<json>());
    std::ifstream picture(file("left.ppm"), std::ios::binary);
    std::string magic;
    std::size_t width = 0, height = 0, most = 0;
    picture >> magic >> width >> height >> most;
    picture.ignore();
    std::vector<unsigned char> rgb(3 * width * height);
    picture.read(reinterpret_cast<char*>(rgb.data()), static_cast<std::streamsize>(rgb.size()));
    ASSERT_TRUE(picture && magic == "P6" && most == 255);
    int warm = 0;
    for (std::size_t i = 0; i < rgb.size(); i += 3)
        warm += rgb[i] > rgb[i + 2] + 12;
    EXPECT_GT(warm, 200) << "pixels of the surface";
}

TEST_F(HeadsetProgram, LeavesWithTheRuntimesConsentAndTellsWhatItDid) {
    play({{{"at", 60}, {"happens", "interrupt"}}});
    const ChildResult result = explore({"--config", "hmd", "--context", "egl"});
    EXPECT_EQ(result.status, 128 + SIGINT) << result.err;
    EXPECT_EQ(logged("violation"), std::vector<json>());
    EXPECT_THAT(result.err, HasSubstr("poses"));
}

TEST_F(HeadsetProgram, GoesOnWhenItsSessionIsLostAndHandsFeelTheirGrab) {
    play({{{"at", 5}, {"right", {0.2, 1.2, -0.4, 0, 0, 0, 1}}},
          {{"at", 20}, {"inputs", {{"right/squeeze/value", 1}}}},
          {{"at", 30}, {"happens", "lose_session"}},
          {{"at", 60}, {"happens", "exit"}}});
    const ChildResult result = explore({"--config", "hmd", "--context", "egl"});
    EXPECT_EQ(result.status, 0) << result.err;
    EXPECT_THAT(result.err, HasSubstr("headset not there"));
    EXPECT_EQ(logged("violation"), std::vector<json>());
    const auto frames = logged("frame");
    ASSERT_FALSE(frames.empty());
    EXPECT_EQ(frames.back().at("session"), 2);
    ASSERT_FALSE(logged("pulse").empty());
    EXPECT_EQ(logged("pulse").front().at("pulse"), "/user/hand/right");
}

TEST_F(HeadsetProgram, WithoutARuntimeItSaysSoInOneLine) {
    setenv("XR_RUNTIME_JSON", "/nowhere/runtime.json", 1);
    const std::string config = changed_config("fallback = \"wait\"", "fallback = \"none\"");
    const ChildResult result = explore({"--config", config, "--context", "egl"});
    EXPECT_EQ(result.status, 1);
    EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), 1) << result.err;
    EXPECT_THAT(result.err, HasSubstr("XR_RUNTIME_JSON=/nowhere/runtime.json"));
    EXPECT_THAT(result.err, HasSubstr("openxr.fallback"));
}

TEST_F(HeadsetProgram, TheWindowsAreShownWhereThatIsConfigured) {
    test_support::VirtualDisplay screen;
    setenv("XR_RUNTIME_JSON", "/nowhere/runtime.json", 1);
    const std::string config = changed_config("fallback = \"wait\"", "fallback = \"window\"");
    const ChildResult result =
        explore({"--config", config, "--size", "320", "160", "--seconds", "0.1"});
    EXPECT_EQ(result.status, 0) << result.err;
    EXPECT_THAT(result.err, HasSubstr("the windows are shown instead"));
}

TEST_F(HeadsetProgram, AMissingRuntimeIsLookedForAndTheWindowShowsTheScene) {
    test_support::VirtualDisplay screen;
    setenv("XR_RUNTIME_JSON", "/nowhere/runtime.json", 1);
    const std::string told = "headset not there, looking for it: OpenXR: no runtime";
    const ChildResult result =
        explore({"--config", "hmd", "--size", "320", "160", "--isovalue", "8"},
                {.interrupt_after = told, .dies_after = test_support::kPatience});
    EXPECT_EQ(result.status, 128 + SIGINT) << result.err;
    EXPECT_THAT(result.err, HasSubstr(told));
    EXPECT_EQ(result.err.find("Error ["), std::string::npos) << "the loader's own messages";
}

class HeadsetBesideAWindow : public HeadsetProgram,
                             public testing::WithParamInterface<const char*> {
  protected:
    test_support::VirtualDisplay screen_;
    ChildResult explore_beside_window() {
        const std::string config =
            changed_config("binding = \"auto\"", std::string("binding = \"") + GetParam() + "\"");
        return explore({"--config", config, "--size", "320", "200"});
    }
};

TEST_P(HeadsetBesideAWindow, MirrorsWhatItShows) {
    play({{{"at", 40}, {"happens", "exit"}}});
    const ChildResult result = explore_beside_window();
    EXPECT_EQ(result.status, 0) << result.err;
    EXPECT_EQ(logged("violation"), std::vector<json>());
    ASSERT_FALSE(logged("frame").empty());
    EXPECT_TRUE(logged("frame").at(20).at("depth"));
}

INSTANTIATE_TEST_SUITE_P(, HeadsetBesideAWindow, testing::Values("xlib", "egl"),
                         [](const auto& each) { return std::string(each.param); });

/// The layer of OpenXR 1.0.20 takes a session without a binding that it knows for one without any,
/// and it does not know XR_MNDX_egl_enable (OpenXR-SDK-Source, issue 570): so GLX it is.
using HeadsetUnderValidation = HeadsetBesideAWindow;

TEST_P(HeadsetUnderValidation, TheCoreValidationLayerFindsNothing) {
    play({{{"at", 5}, {"right", {0.2, 1.2, -0.4, 0, 0, 0, 1}}},
          {{"at", 20}, {"inputs", {{"right/squeeze/value", 1}}}},
          {{"at", 30}, {"happens", "lose_session"}},
          {{"at", 60}, {"happens", "exit"}}});
    setenv("XR_ENABLE_API_LAYERS", "XR_APILAYER_LUNARG_core_validation", 1);
    setenv("XR_CORE_VALIDATION_EXPORT_TYPE", "text", 1);
    setenv("XR_CORE_VALIDATION_FILE_NAME", file("validation.txt").c_str(), 1);
    const ChildResult result = explore_beside_window();
    EXPECT_EQ(result.status, 0) << result.err;
    EXPECT_EQ(logged("violation"), std::vector<json>());
    EXPECT_THAT(result.err, HasSubstr("Core Validation output type: text"));
    std::istringstream findings(folder_.read("validation.txt")); // written with the first finding
    for (std::string line; std::getline(findings, line);)        // 1.1 says when it begins and ends
        EXPECT_THAT(line, HasSubstr("[VALID_DEBUG "));
}

INSTANTIATE_TEST_SUITE_P(, HeadsetUnderValidation, testing::Values("xlib"),
                         [](const auto& each) { return std::string(each.param); });

} // namespace
} // namespace isochron::app
