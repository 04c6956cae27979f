// A session in a window that is steered from outside, and a replay that is watched.
#include "tests/app/commands/explore_fixture.h"

#include "interaction/recording/recording.h"
#include "stereo/image_file.h"
#include "tests/support/child_process.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <fstream>

namespace isochron::app {
namespace {

class TellTest : public ExploreTest {
  protected:
    TellTest() { setenv("XDG_RUNTIME_DIR", state_.path().c_str(), 1); }

    bool listens() const {
        return test_support::eventually(
            [&] { return std::filesystem::exists(state_.path() / "isochron/control.sock"); });
    }
    ChildResult tell(std::vector<std::string> words) const {
        words.insert(words.begin(), "tell");
        return run_child(test_support::binary_root() + "/isochron", words, folder_.path());
    }
    nlohmann::json state() const { return nlohmann::json::parse(tell({"state"}).out); }
};

TEST_F(TellTest, WhatIsToldIsShownRecordedAndUndoneLikeAnyInput) {
    const auto program = explore({"--control", "--record", file("walk.jsonl")});
    ASSERT_TRUE(listens());
    EXPECT_EQ(tell({"step=2", "isovalue=8", "quality=fast"}).status, 0);
    EXPECT_EQ(state().at("step"), 2);
    EXPECT_EQ(state().at("isosurfaces")[0].at("isovalue"), 8);
    EXPECT_EQ(tell({"undo"}).status, 0);
    EXPECT_EQ(state().at("step"), 0);
    EXPECT_EQ(tell({"redo"}).status, 0);
    EXPECT_EQ(state().at("step"), 2);
    const ChildResult wrong = tell({"step=99"});
    EXPECT_EQ(wrong.status, 1);
    EXPECT_EQ(wrong.err, "isochron: step is 99, expected at most 5\n");
    EXPECT_EQ(tell({"bogus=1"}).status, 2);

    EXPECT_EQ(tell({"picture", "-o", "now.png"}).status, 0);
    const render::Image image = stereo::read_image(folder_.path() / "now.png");
    const auto middle = static_cast<std::size_t>(image.at(image.width / 2, image.height / 2)[0]);
    EXPECT_GT(middle, image.at(2, 2)[0] + 20u) << "the sphere";
    EXPECT_FALSE(stereo::read_note(folder_.path() / "now.png").empty());

    folder_.write("notes.txt", "mine");
    EXPECT_EQ(tell({"cells", "-o", "notes.txt"}).status, 1) << "replaced only with --force";
    EXPECT_EQ(folder_.read("notes.txt"), "mine");
    EXPECT_EQ(tell({"cells", "-o", "told.bin"}).status, 0);
    run_child(test_support::binary_root() + "/isochron",
              {"query", "sphere.isochron", "--isovalue", "8", "--step", "2", "--ids", "ids.bin"},
              folder_.path());
    EXPECT_FALSE(folder_.read("ids.bin").empty());
    EXPECT_EQ(folder_.read("told.bin"), folder_.read("ids.bin"));

    EXPECT_EQ(tell({"quit"}).status, 0);
    EXPECT_EQ(program->exit_status(), 0);
    std::ifstream lines(file("walk.jsonl"));
    const auto recording = interaction::read_recording(lines, "walk.jsonl");
    EXPECT_TRUE(std::ranges::any_of(recording.frames, [](const auto& frame) {
        return frame.commands.undo && frame.from_panel.undo &&
               frame.commands.instant == index::Instant(0);
    }));
    EXPECT_EQ(Program({"replay", file("walk.jsonl"), "--from-devices"}).exit_status(), 0);
    EXPECT_EQ(tell({"state"}).status, 1) << "nobody listens any more";
}

TEST_F(TellTest, AReplayIsWatchedAndNotSteered) {
    {
        const auto program = explore({"--control", "--record", file("walk.jsonl")});
        ASSERT_TRUE(listens());
        for (int i = 0; i < 40; ++i) // frames that take a while to replay
            tell({"stamps=[\"" + std::to_string(i) + "\"]"});
        tell({"quit"});
        EXPECT_EQ(program->exit_status(), 0);
    }
    EXPECT_FALSE(std::filesystem::exists(state_.path() / "isochron/control.sock"));
    const Program replay(
        {"replay", file("walk.jsonl"), "--live", "--context", "glfw", "--control"});
    ASSERT_TRUE(listens());
    const ChildResult steered = tell({"step=1"});
    EXPECT_EQ(steered.status, 1);
    EXPECT_EQ(steered.err, "isochron: a replay answers state, subscribe and picture alone\n");
    replay.signal(SIGTERM);
    replay.exit_status();
}

TEST_F(TellTest, AFileIsNoSocket) {
    EXPECT_EQ(Program({"explore", "--control", file("sphere.isochron")}).exit_status(), 1)
        << "the option takes it as its value";
    EXPECT_EQ(
        Program({"explore", file("sphere.isochron"), "--control", "0.0.0.0:4242"}).exit_status(),
        1);
}

} // namespace
} // namespace isochron::app
