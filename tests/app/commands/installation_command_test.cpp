// The commands on installations, as an engineer runs them.
#include "tests/support/session_fixture.h"

#include "interaction/recording/recording.h"
#include "tests/support/child_process.h"
#include "tests/support/paths.h"

#include <gmock/gmock.h>

#include <sys/stat.h>

#include <algorithm>

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
    const std::string wrong = "lab.toml:4: windows.monitor: window window 2 covers monitor 0, as "
                              "window window does\n";
    EXPECT_EQ(result.err, "isochron: " + wrong);
    EXPECT_THAT(result.out, testing::EndsWith(wrong));
    folder.write("lab.toml", "[[windows]]\nname = \"x\"\nsteroe = \"mono\"\n");
    result = isochron({"explore", "--check-config", "lab.toml"});
    EXPECT_EQ(result.status, 1);
    EXPECT_EQ(result.err, "isochron: lab.toml:3: unknown key 'steroe' in [windows]; did you mean "
                          "'stereo'?\n");
    unsetenv("DISPLAY");
    unsetenv("WAYLAND_DISPLAY");
    result = isochron({"explore"});
    EXPECT_EQ(result.status, 1)
        << "without an index there is a window to choose one, or no display";
    EXPECT_THAT(result.err, testing::HasSubstr("no display"));
}

TEST_F(InstallationCommand, CheckConfigDrawsTheRoomAndReplacesOnlyItsOwnPictures) {
    folder.write("notes.png", "mine");
    const std::vector<std::string> draw{"explore", "--check-config", "cave4", "--picture"};
    const auto into = [&](const std::string& file, const std::vector<std::string>& more = {}) {
        std::vector<std::string> arguments = draw;
        arguments.push_back(file);
        arguments.insert(arguments.end(), more.begin(), more.end());
        return isochron(arguments);
    };
    for (int i = 0; i < 2; ++i) // again, over its own
        EXPECT_EQ(into("room.png").status, 0);
    EXPECT_EQ(folder.read("room.png").substr(1, 3), "PNG");
    ChildResult result = into("notes.png");
    EXPECT_EQ(result.status, 1);
    EXPECT_THAT(result.err, HasSubstr("notes.png: exists and is not a picture that this program"));
    EXPECT_EQ(folder.read("notes.png"), "mine");
    EXPECT_EQ(into("notes.png", {"--force"}).status, 0);
    EXPECT_EQ(into("room.txt").status, 2);
    EXPECT_EQ(isochron({"explore", "--picture", "room.png"}).status, 2);

    // What is wrong is drawn, too.
    folder.write("lab.toml", "[[windows]]\n[[windows.viewports]]\n[windows.viewports.projection]\n"
                             "lower_left = [1, 1, -1]\nupper_left = [1, 3, -1]\nupper_right = [-1, "
                             "3, -1]\n");
    result = isochron({"explore", "--check-config", "lab.toml", "--picture", "lab.png"});
    EXPECT_EQ(result.status, 1);
    EXPECT_EQ(folder.read("lab.png").substr(1, 3), "PNG");
    result = isochron({"explore", "--check-config", "lab.toml", "--picture", "lab.toml"});
    EXPECT_NE(result.status, 0);
    EXPECT_THAT(folder.read("lab.toml"), testing::StartsWith("[[windows]]"));
}

TEST_F(InstallationCommand, AShippedNameMeansTheShippedConfigurationWhateverLiesThere) {
    std::filesystem::create_directory(folder.path() / "hmd");
    folder.write("cave4", "[[windows]]\nname = \"mine\"\n");
    ChildResult result = isochron({"explore", "--check-config", "hmd"});
    EXPECT_EQ(result.status, 0) << result.err;
    EXPECT_THAT(result.out, HasSubstr("openxr: "));
    result = isochron({"explore", "--check-config", "cave4"});
    EXPECT_THAT(result.out, HasSubstr("window left: "));
    result = isochron({"explore", "--check-config", "./cave4"});
    EXPECT_THAT(result.out, HasSubstr("window mine: "));
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

    // Without any corner it is a window on a desktop; some of them are a mistake.
    folder.write("bad.pvx", "<pvx>\n<Machine LowerLeft=\"0 0 0\"/>\n</pvx>");
    result = isochron({"config", "import", "bad.pvx", "-o", "bad.toml"});
    EXPECT_EQ(result.status, 1);
    EXPECT_EQ(result.err, "isochron: bad.pvx:2: Machine: LowerRight is missing\n");
    EXPECT_FALSE(std::filesystem::exists(folder.path() / "bad.toml"));
    EXPECT_EQ(isochron({"config", "import", "cave.pvx", "-o", "cave.pvx"}).status, 1);
    EXPECT_EQ(folder.read("cave.pvx"), kPvx);
}

TEST_F(InstallationCommand, AnImportOfTwoViewersSaysThatTheirTrackersAreMissing) {
    const std::string corners =
        "LowerLeft=\"-1 -1 -2\" LowerRight=\"1 -1 -2\" UpperRight=\"1 1 -2\"/>\n";
    folder.write("two.pvx", "<pvx>\n<Machine Name=\"a\" ViewerId=\"0\" Geometry=\"300x300+0+0\" " +
                                corners +
                                "<Machine Name=\"b\" ViewerId=\"1\" Geometry=\"300x300+300+0\" " +
                                corners + "</pvx>");
    ChildResult result = isochron({"config", "import", "two.pvx", "-o", "two.toml"});
    EXPECT_EQ(result.status, 0) << result.err;
    EXPECT_THAT(result.err, HasSubstr("note: two.pvx: no tracker provides device head 2"));
    result = isochron({"explore", "--check-config", "two.toml"});
    EXPECT_EQ(result.status, 1) << "until they are added";
}

TEST_F(InstallationCommand, AnImportThatItsOwnCheckRejectsIsNotWritten) {
    // A corner that is not square, and one that no room holds.
    for (const auto& [corner, what] :
         {std::pair<std::string, std::string>{"3.5 0 -3", "has 94.8 degrees, expected 90"},
          {"4 9223372036854775808 -3", "LowerRight: expected corners within 1000000"}}) {
        std::string text = kPvx;
        text.replace(text.find("4 0 -3\" Upper"), 6, corner);
        folder.write("bad.pvx", text);
        for (const std::vector<std::string>& out :
             {std::vector<std::string>{}, {"-o", "bad.toml"}}) {
            std::vector<std::string> import{"config", "import", "bad.pvx"};
            import.insert(import.end(), out.begin(), out.end());
            const ChildResult result = isochron(import);
            EXPECT_EQ(result.status, 1);
            EXPECT_EQ(result.out, "");
            EXPECT_THAT(result.err, testing::StartsWith("isochron: bad.pvx"));
            EXPECT_THAT(result.err, HasSubstr(what));
            EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), 1) << result.err;
        }
        EXPECT_THAT(folder.names(), ElementsAre("bad.pvx"));
    }
}

TEST_F(InstallationCommand, OnlyRegularFilesAreRead) {
    ASSERT_EQ(::mkfifo((folder.path() / "pipe").c_str(), 0600), 0);
    for (const std::string file : {"pipe", "/dev/zero"})
        for (const std::vector<std::string>& arguments :
             std::vector<std::vector<std::string>>{{"explore", "--check-config", file},
                                                   {"explore", "--list-devices", "--config", file},
                                                   {"config", "import", file},
                                                   {"replay", file, "--out", ".", "--stamps"},
                                                   {"info", file},
                                                   {"build", file, "-o", "a.isochron"}}) {
            const ChildResult result = isochron(arguments);
            EXPECT_EQ(result.status, 1) << arguments[0];
            EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), 1) << result.err;
            EXPECT_THAT(result.err, HasSubstr(file + ": not a regular file"));
        }
}

TEST_F(InstallationCommand, AMessageIsOneLineWhateverItQuotes) {
    folder.write("lab.toml", "\"a\\nb\\u001b[31m" + std::string(100'000, 'x') + "\" = 1\n");
    const ChildResult result = isochron({"explore", "--check-config", "lab.toml"});
    EXPECT_EQ(result.status, 1);
    EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), 1) << result.err;
    EXPECT_THAT(result.err, HasSubstr("unknown key 'a\\nb\\x1b[31mxxx"));
    EXPECT_LT(result.err.size(), 3000u);
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
