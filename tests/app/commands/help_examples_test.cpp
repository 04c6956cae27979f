// Examples of help and commands of the guide work as they are written; what every command prints where.
#include "tests/app/commands/explore_fixture.h"

#include "tests/support/child_process.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <memory>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

namespace isochron::app {
namespace {

/// The program beside a stand-in for ffmpeg, in a folder with what the examples speak of: a small
/// series, a recording and a description of ParaView's.
class HelpExamples : public testing::Test {
  protected:
    HelpExamples() {
        std::filesystem::create_directory(folder_.path() / "bin");
        folder_.write("bin/ffmpeg", "#!/bin/sh\nfor last; do :; done\nwc -c > \"$last\"\n");
        std::filesystem::permissions(folder_.path() / "bin/ffmpeg",
                                     std::filesystem::perms::owner_all);
        folder_.write("cave.pvx", "<pvx>\n<Machine Name=\"wall\" Geometry=\"800x600+0+0\" "
                                  "LowerLeft=\"-4 0 -3\" LowerRight=\"4 0 -3\" "
                                  "UpperRight=\"4 6 -3\"/>\n</pvx>\n");
        write_recording("run42.isochron");
        folder_.write("figure.toml",
                      "width = 40\ndpi = 60\n[[panels]]\nindex = \"run42.isochron\"\n");
        environment_ = {"HOME=" + folder_.path().string(),
                        "XDG_RUNTIME_DIR=" + folder_.path().string(),
                        "PATH=" + folder_.path().string() + "/bin:" + test_support::binary_root() +
                            ":" + std::getenv("PATH")};
    }

    /// The first frames of the shipped recording, small, up to its first stamp, as of `data`.
    void write_recording(const std::string& data) {
        std::ifstream shipped(test_support::source_root() + "/configs/demo.jsonl");
        std::string text, line;
        for (int i = 0; i < 16 && std::getline(shipped, line); ++i)
            text += line + '\n';
        const std::vector<std::pair<std::string, std::string>> changes{
            {"vorticity.isochron", data},
            {"[1920, 960]", "[128, 64]"},
            {"\"step\":10", "\"step\":0"},
            {"\"stamps\":[\"settled\"]", "\"stamps\":[\"stamp-1\"]"}};
        for (const auto& [from, to] : changes) {
            ASSERT_NE(text.find(from), std::string::npos) << from;
            for (std::size_t at; (at = text.find(from)) != std::string::npos;)
                text.replace(at, from.size(), to);
        }
        folder_.write("walk.jsonl", text);
    }

    ChildResult shell(const std::string& line) {
        return run_child("/bin/bash", {"-c", line}, folder_.path(), {.environment = environment_});
    }
    std::string help(const std::string& command) { return shell(command + " --help").out; }

    /// The lines below `heading` up to an empty one, without the spaces before them.
    static std::vector<std::string> lines_below(const std::string& text,
                                                const std::string& heading) {
        std::istringstream lines(text);
        std::vector<std::string> found;
        std::string line;
        while (std::getline(lines, line) && line != heading) {
        }
        while (std::getline(lines, line) && !line.empty())
            if (!found.empty() && found.back().ends_with(" \\")) // an example goes on
                found.back().replace(found.back().size() - 1, 1, line.substr(4));
            else if (line.starts_with("  ") && line.size() > 2 && line[2] != ' ')
                found.push_back(line.substr(2));
        return found;
    }
    /// `command` and all commands below it.
    std::vector<std::string> commands_of(const std::string& command) {
        const std::string text = help(command);
        std::vector<std::string> all{command};
        for (const char* heading : {"Commands to begin with:", "More commands:", "Subcommands:"})
            for (const std::string& line : lines_below(text, heading))
                for (const std::string& below :
                     commands_of(command + " " + line.substr(0, line.find(' '))))
                    all.push_back(below);
        return all;
    }

    /// The demo series, and movies of a series, take a while in full.
    static void shorten(std::string& command) {
        if (command.starts_with("isochron movie run42"))
            command.insert(std::min(command.find(" #"), command.size()),
                           command.find("--panorama") == std::string::npos
                               ? " --rate 2 --size 160 90"
                               : " --rate 2 --size 256 256");
        if (command.starts_with("isochron generate") && command.find("--step") == std::string::npos)
            command.insert(std::min(command.find(" #"), command.size()),
                           command.find("sphere") == std::string::npos ? " --steps 1 --size 16"
                                                                       : " --steps 1");
    }

    TestFolder folder_;
    std::vector<std::string> environment_;
};

TEST_F(HelpExamples, OfTheProgramAreBehindTheFiveCommandsToBeginWith) {
    const std::string text = help("isochron");
    EXPECT_EQ(lines_below(text, "Examples:").size(), 2u);
    EXPECT_LT(text.find("Commands to begin with:"), text.find("Examples:"));
    EXPECT_EQ(shell("isochron").out, text);
    EXPECT_EQ(shell("isochron help").out, text);
    std::vector<std::string> first;
    for (const std::string& line : lines_below(text, "Commands to begin with:"))
        first.push_back(line.substr(0, line.find(' ')));
    EXPECT_EQ(first, (std::vector<std::string>{"info", "build", "explore", "replay", "movie"}));
}

TEST_F(HelpExamples, OfEveryCommandWorkAsTheyAreWritten) {
    test_support::VirtualDisplay screen;
    environment_.push_back(std::string("DISPLAY=") + std::getenv("DISPLAY"));
    ASSERT_EQ(shell("isochron generate sphere --step-count 3 -o run42").status, 0);
    const std::vector<std::string> commands = commands_of("isochron");
    EXPECT_GT(commands.size(), 17u);
    for (const std::string& command : commands) {
        const std::string text = help(command);
        const std::vector<std::string> examples = lines_below(text, "Examples:");
        EXPECT_EQ(examples.size(), 2u) << command;
        EXPECT_GT(text.find("Examples:"), text.find("Usage:")) << command;
        for (std::string example : examples) {
            shorten(example);
            // A window is waited for, and closed.
            if (example.starts_with("isochron explore run42"))
                example += " & xdotool search --sync --onlyvisible --name Isochron; "
                           "kill -TERM $!; wait $!; [ $? = 143 ]";
            // A session listens, and ends afterwards.
            if (example.starts_with("isochron tell"))
                example = "isochron explore run42.isochron --control & until [ -S "
                          "$XDG_RUNTIME_DIR/isochron/control.sock ]; do sleep 0.1; done; " +
                          example + " && isochron tell quit && wait $!";
            // A server prints its link, and is ended.
            if (example == "isochron serve run42.isochron")
                example +=
                    " > link & until [ -s link ]; do sleep 0.1; done; kill -TERM $!; wait $!";
            const ChildResult result = shell(example);
            EXPECT_EQ(result.status, 0) << example << '\n' << result.err;
        }
    }
}

// Wrapped to the terminal's width; a pseudo terminal is as wide as it is told.
TEST_F(HelpExamples, AndAllHelpAreAsWideAsTheTerminal) {
    for (const std::string columns : {"50", "120"}) {
        const ChildResult shown = shell("script -qec 'stty cols " + columns +
                                        "; isochron help build; isochron help' /dev/null");
        std::istringstream lines(shown.out);
        std::size_t widest = 0;
        for (std::string line; std::getline(lines, line);)
            widest = std::max(widest, line.size() - (line.ends_with('\r') ? 1 : 0));
        EXPECT_LE(widest, std::stoul(columns));
        EXPECT_GT(widest + 12, std::stoul(columns));
    }
}

/// One part of each_command.py.
class EachCommand : public HelpExamples, public testing::WithParamInterface<const char*> {};

TEST_P(EachCommand, TellsAnswersOnStdoutAndNotesOnStderr) {
    ASSERT_EQ(shell("isochron generate sphere --step-count 3 -o run42 && isochron build run42 -o "
                    "run42.isochron && isochron replay walk.jsonl --stamps -o pictures")
                  .status,
              0);
    const ChildResult result =
        shell("PYTHONDONTWRITEBYTECODE=1 /usr/bin/python3 " + test_support::source_root() +
              "/tests/app/commands/each_command.py isochron " + test_support::source_root() + " " +
              GetParam());
    EXPECT_EQ(result.status, 0) << result.out << result.err;
}

INSTANTIATE_TEST_SUITE_P(, EachCommand,
                         testing::Values("answers", "reports", "movie", "pictures", "failures",
                                         "advice", "help"),
                         [](const auto& part) { return std::string(part.param); });

/// The commands in a page's blocks that need neither a window nor hardware nor other computers.
std::vector<std::string> commands_in(const std::filesystem::path& page) {
    std::ifstream lines(page);
    std::vector<std::string> found;
    bool block = false;
    for (std::string line; std::getline(lines, line);) {
        if (line.starts_with("```"))
            block = line == "```sh";
        const auto has = [&](const char* word) { return line.find(word) != std::string::npos; };
        if (block && line.starts_with("isochron ") && !has("--live") &&
            !has(" 'http") && // no server is there
            (!has(" serve ") || has("--write-site")) && // else it goes on until it is ended
            (!has(" explore ") || has("--check-config") || has("--list-devices")))
            found.push_back(line);
    }
    return found;
}

/// One of a page's blocks of JSON, or of another kind. @param number from 0
std::string block_in(const std::filesystem::path& page, const std::string& kind = "json",
                     int number = 0) {
    std::ifstream lines(page);
    std::string block, line;
    while (number >= 0 && std::getline(lines, line))
        number -= line == "```" + kind;
    while (std::getline(lines, line) && line != "```")
        block += line + '\n';
    return block;
}

TEST_F(HelpExamples, OfThePageAboutSteeringWorkInASession) {
    test_support::VirtualDisplay screen;
    environment_.push_back(std::string("DISPLAY=") + std::getenv("DISPLAY"));
    ASSERT_EQ(shell("isochron generate sphere --step-count 9 -o run42").status, 0);
    ASSERT_EQ(shell("isochron build run42 -o run42.isochron").status, 0);
    std::string all = "isochron explore run42.isochron --control & until [ -S "
                      "$XDG_RUNTIME_DIR/isochron/control.sock ]; do sleep 0.1; done; set -e\n";
    const auto commands = commands_in(test_support::source_root() + "/docs/guide/steering.md");
    EXPECT_EQ(commands.size(), 4u);
    for (const std::string& command : commands)
        all += command + "\n";
    const ChildResult result = shell(all + "isochron tell quit\nwait $!");
    EXPECT_EQ(result.status, 0) << result.err;
}

// Its other commands are tried with those of the other pages.
TEST_F(HelpExamples, OfThePageAboutStoriesTellOneInAWindow) {
    test_support::VirtualDisplay screen;
    environment_.push_back(std::string("DISPLAY=") + std::getenv("DISPLAY"));
    ASSERT_EQ(shell("isochron generate sphere --step-count 12 -o run42").status, 0);
    ASSERT_EQ(shell("isochron build run42 -o run42.isochron").status, 0);
    const std::string page = test_support::source_root() + "/docs/guide/stories.md";
    folder_.write("tour.isochron-story", block_in(page, "json", 1));
    std::ifstream lines(page);
    int told = 0;
    for (std::string line; std::getline(lines, line);)
        if (line.starts_with("isochron explore ")) {
            const ChildResult result =
                shell(line + " --size 640 480 --seconds 0.5 --record told.jsonl --force");
            EXPECT_EQ(result.status, 0) << line << '\n' << result.err;
            const std::string kept = folder_.read("told.jsonl");
            EXPECT_NE(kept.find("\"story\":1"), std::string::npos) << line;
            EXPECT_NE(kept.find("front arrives"), std::string::npos) << line;
            ++told;
        }
    EXPECT_EQ(told, 2);
}

/// A step of a flow as a solver of a finite volume writes it, in SI units: pressure, temperature, velocity
/// and a viscosity that is constant.
std::string flow_step(std::size_t step) {
    constexpr std::size_t kX = 33, kY = 25, kZ = 17;
    constexpr double kSpacing = 0.002; // [m]
    std::array<std::vector<float>, 4> values;
    for (std::size_t i = 0; i < kX * kY * kZ; ++i) {
        const double x = kSpacing * double(i % kX), y = kSpacing * double(i / kX % kY),
                     z = kSpacing * double(i / kX / kY), t = 0.3 * double(step);
        values[0].push_back(float(101325 + 200 * std::sin(60 * x + t) * std::cos(80 * y)));
        values[1].push_back(
            float(300 + 20 * std::exp(-1e4 * (x - 0.03) * (x - 0.03)) * std::cos(t)));
        for (const double v : {std::sin(90 * y + t), std::cos(80 * x), 0.1 * z})
            values[2].push_back(float(v));
        values[3].push_back(1e-5f);
    }
    std::string arrays, appended;
    for (std::size_t i = 0; i < values.size(); ++i) {
        arrays += fmt::format("<DataArray type=\"Float32\" Name=\"{}\" NumberOfComponents=\"{}\" "
                              "format=\"appended\" offset=\"{}\"/>",
                              std::array{"p", "T", "U", "nut"}[i], i == 2 ? 3 : 1, appended.size());
        const auto bytes = static_cast<std::uint32_t>(values[i].size() * sizeof(float));
        appended.append(reinterpret_cast<const char*>(&bytes), sizeof bytes);
        appended.append(reinterpret_cast<const char*>(values[i].data()), bytes);
    }
    const std::string extent = fmt::format("0 {} 0 {} 0 {}", kX - 1, kY - 1, kZ - 1);
    return fmt::format(
               "<VTKFile type=\"ImageData\" version=\"0.1\" byte_order=\"LittleEndian\" "
               "header_type=\"UInt32\"><ImageData WholeExtent=\"{0}\" Origin=\"0 0 0\" "
               "Spacing=\"{1} {1} {1}\"><FieldData><DataArray type=\"Float64\" "
               "Name=\"TimeValue\" NumberOfTuples=\"1\" format=\"ascii\">{2}</DataArray>"
               "</FieldData><Piece Extent=\"{0}\"><PointData Scalars=\"p\" Vectors=\"U\">{3}"
               "</PointData></Piece></ImageData><AppendedData encoding=\"raw\">_",
               extent, kSpacing, 0.05 * double(step), arrays) +
           appended + "</AppendedData></VTKFile>";
}

/// Each page's commands work in a copy of one folder, with such a flow, its index and a configuration.
class GuideCommands : public HelpExamples, public testing::WithParamInterface<std::string> {
  protected:
    static void SetUpTestSuite() {
        constexpr std::size_t kSteps = 12;
        made_ = std::make_unique<TestFolder>();
        std::filesystem::create_directory(made_->path() / "run42");
        for (std::size_t step = 0; step < kSteps; ++step)
            made_->write(fmt::format("run42/run_{:04}.vti", step), flow_step(step));
        const ChildResult built =
            run_child(test_support::binary_root() + "/isochron",
                      {"build", "run42", "-o", "run42.isochron", "--all-arrays"}, made_->path());
        ASSERT_EQ(built.status, 0) << built.err;
        EXPECT_EQ(built.err.find("note"), std::string::npos) << built.err;
    }
    static void TearDownTestSuite() { made_.reset(); }
    GuideCommands() {
        std::filesystem::copy(made_->path(), folder_.path(),
                              std::filesystem::copy_options::recursive);
    }

  private:
    inline static std::unique_ptr<TestFolder> made_;
};

INSTANTIATE_TEST_SUITE_P(
    Pages, GuideCommands,
    testing::Values("README", "docs/guide/data", "docs/guide/tutorial", "docs/guide/recordings",
                    "docs/guide/cells", "docs/guide/export", "docs/guide/programs",
                    "docs/guide/walls", "docs/guide/clusters", "docs/guide/trackers",
                    "docs/guide/measure", "docs/guide/sharing", "docs/guide/figures", "docs/guide/stories"),
    [](const auto& page) { return page.param.substr(page.param.rfind('/') + 1); });

TEST_P(GuideCommands, WorkAsTheyAreWritten) {
    const std::string page = GetParam();
    write_recording(page.ends_with("tutorial") ? "flow.isochron" : "run42.isochron");
    ASSERT_EQ(shell("isochron config import cave.pvx -o cave.toml").status, 0);
    const std::vector<std::string> commands =
        commands_in(test_support::source_root() + "/" + page + ".md");
    EXPECT_FALSE(commands.empty());
    folder_.write("keys.json", block_in(test_support::source_root() + "/docs/guide/recordings.md"));
    const std::string stories = test_support::source_root() + "/docs/guide/stories.md";
    folder_.write("film.json", block_in(stories));
    folder_.write("tour.isochron-story", block_in(stories, "json", 1));
    folder_.write("pair.toml", block_in(stories, "toml"));
    for (std::string command : commands) {
        shorten(command);
        const ChildResult result = shell(command);
        EXPECT_EQ(result.status, 0) << command << '\n' << result.err;
        // The stand-in's movie is not known as one that may be replaced.
        std::filesystem::remove(folder_.path() / "walk.mp4");
    }
}

} // namespace
} // namespace isochron::app
