// The commands about installations, as an engineer runs them.
#include "tests/support/session_fixture.h"

#include "interaction/recording/recording.h"
#include "tests/support/child_process.h"
#include "tests/support/paths.h"

#include <gmock/gmock.h>

namespace isochron::app {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

class InstallationCommand : public testing::Test {
  protected:
    ChildResult isochron(const std::vector<std::string>& arguments) {
        return run_child(test_support::binary_root() + "/isochron", arguments, folder.path());
    }
    TestFolder folder;
};

const std::string kPvx = "<pvx>\n<Machine Name=\"wall\" Geometry=\"800x600+0+0\" LowerLeft=\"-4 0 "
                         "-3\" LowerRight=\"4 0 -3\" UpperRight=\"4 6 -3\"/>\n</pvx>\n";

TEST_F(InstallationCommand, CheckConfigListsAndEndsWithNothingWhereNothingIsWrong) {
    const ChildResult result = isochron({"explore", "--check-config", "cave4"});
    EXPECT_EQ(result.status, 0) << result.err;
    EXPECT_EQ(result.err, "");
    EXPECT_THAT(result.out, HasSubstr("window left: 1920 x 1200 pixels"));
    EXPECT_THAT(result.out, testing::EndsWith("nothing is wrong\n"));
}

TEST_F(InstallationCommand, CheckConfigNamesWhatIsWrongAndFails) {
    folder.write("lab.toml", "[[windows]]\nfullscreen = true\nmonitor = 0\n[[windows]]\nfullscreen "
                             "= true\nmonitor = 0\n");
    ChildResult result = isochron({"explore", "--check-config", "lab.toml"});
    EXPECT_EQ(result.status, 1);
    EXPECT_EQ(result.err, "lab.toml:4: windows.monitor: window window 2 covers monitor 0, as "
                          "window window does\n"
                          "isochron: lab.toml: 1 thing is wrong\n");
    folder.write("lab.toml", "[[windows]]\nname = \"x\"\nsteroe = \"mono\"\n");
    result = isochron({"explore", "--check-config", "lab.toml"});
    EXPECT_EQ(result.status, 1);
    EXPECT_EQ(result.err, "isochron: lab.toml:3: unknown key 'steroe' in [windows]; did you mean "
                          "'stereo'?\n");
    EXPECT_EQ(isochron({"explore"}).status, 2) << "without an index there is nothing to explore";
}

TEST_F(InstallationCommand, ImportWritesAConfigurationThatIsSound) {
    folder.write("cave.pvx", kPvx);
    ChildResult result = isochron({"config", "import", "cave.pvx", "-o", "cave.toml", "--unit",
                                   "0.5", "--origin", "0", "0.4", "0"});
    ASSERT_EQ(result.status, 0) << result.err;
    EXPECT_EQ(result.err, "");
    result = isochron({"explore", "--check-config", "cave.toml"});
    EXPECT_EQ(result.status, 0) << result.err;
    EXPECT_THAT(result.out, HasSubstr("screen: 4.00 x 3.00 m"));
    EXPECT_EQ(isochron({"config", "import", "cave.pvx"}).out.substr(0, 1), "#");

    folder.write("bad.pvx", "<pvx>\n<Machine/>\n</pvx>");
    result = isochron({"config", "import", "bad.pvx", "-o", "bad.toml"});
    EXPECT_EQ(result.status, 1);
    EXPECT_EQ(result.err, "isochron: bad.pvx:2: Machine: LowerLeft is missing\n");
    EXPECT_FALSE(std::filesystem::exists(folder.path() / "bad.toml"));
    EXPECT_EQ(isochron({"config", "import", "cave.pvx", "-o", "cave.pvx"}).status, 1);
    EXPECT_EQ(folder.read("cave.pvx"), kPvx);
}

TEST_F(InstallationCommand, AReplayNamesPicturesByWindowViewportAndEye) {
    build_sphere(folder.path(), 12);
    interaction::RecordingHeader header;
    header.data = "sphere.isochron";
    interaction::RecordedFrame frame;
    frame.input = head_at_rest(0);
    frame.commands.stamps = {"now"};
    const auto record = [&](const std::string& configuration, const std::string& mode) {
        header.configuration = configuration;
        header.start = ExplorerState{}.as_commands();
        header.start.stereo = mode;
        interaction::RecordingWriter writer(folder.path() / "r.jsonl", header);
        writer.append(frame);
        writer.finish();
    };
    const auto pictures = [&](const std::string& out, const std::vector<std::string>& more) {
        std::vector<std::string> arguments{"replay", "r.jsonl", "--stamps", "--size",
                                           "32",     "32",      "--out",    out};
        arguments.insert(arguments.end(), more.begin(), more.end());
        const ChildResult result = isochron(arguments);
        EXPECT_EQ(result.status, 0) << result.err;
        std::vector<std::string> names;
        for (const auto& entry : std::filesystem::directory_iterator(folder.path() / out))
            names.push_back(entry.path().filename().string());
        std::sort(names.begin(), names.end());
        return names;
    };
    const std::string cave = read_config("cave4").text;
    record(cave, "quadbuffer");
    EXPECT_THAT(pictures("each", {"--eyes", "each"}),
                ElementsAre("stamp_00000_now_floor_left.png", "stamp_00000_now_floor_right.png",
                            "stamp_00000_now_front_left.png", "stamp_00000_now_front_right.png",
                            "stamp_00000_now_left_left.png", "stamp_00000_now_left_right.png",
                            "stamp_00000_now_right_left.png", "stamp_00000_now_right_right.png"));
    EXPECT_THAT(pictures("window", {"--stereo", "checkerboard"}),
                ElementsAre("stamp_00000_now_floor.png", "stamp_00000_now_front.png",
                            "stamp_00000_now_left.png", "stamp_00000_now_right.png"));
    EXPECT_EQ(pictures("buffers", {}).size(), 8u) << "a quad-buffered window has two pictures";
    EXPECT_THAT(pictures("room", {"--emulate"}), ElementsAre("stamp_00000_now.png"));
    record("[[windows]]\n", "side_by_side");
    EXPECT_THAT(pictures("one", {}), ElementsAre("stamp_00000_now.png"));
    EXPECT_THAT(pictures("one_each", {"--eyes", "each"}),
                ElementsAre("stamp_00000_now_left.png", "stamp_00000_now_right.png"));
}

} // namespace
} // namespace isochron::app
