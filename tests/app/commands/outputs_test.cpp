// What every command may write over: what this program wrote, and never what is read.
#include "tests/app/commands/output_ways.h"
#include "tests/support/child_process.h"
#include "tests/support/session_fixture.h"
#include "tests/support/virtual_display.h"

#include "interaction/recording/recording.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <map>
#include <optional>
#include <regex>
#include <set>
#include <string>
#include <vector>

namespace isochron::app {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

const std::string kNotes = "notes of a user, who has no copy of them\n";

ChildResult run_in(const fs::path& folder, const std::vector<std::string>& arguments) {
    const char* path = std::getenv("PATH");
    return run_child(test_support::binary_root() + "/isochron", arguments, folder,
                     {.environment = {"PATH=" + folder.string() + ":" + (path ? path : ""),
                                      "XDG_STATE_HOME=" + folder.string() + "/state"}});
}

/// A series, its index, a recording on it, two of its pictures, and what else commands read: made
/// once, as each test works on a copy.
const TestFolder& prepared() {
    static const TestFolder folder;
    static const bool made = [] {
        for (int step = 0; step < 3; ++step) {
            std::string bytes;
            for (int i = 0; i < 8 * 8 * 8; ++i) { // a plane that moves
                const auto value = static_cast<float>(10 * (i / 64 + step) + i % 8);
                bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
            }
            folder.write("t" + std::to_string(step) + ".raw", bytes);
        }
        folder.write("cave.pvx", "<pvx><Process Type=\"client\"/><Process Type=\"server\">"
                                 "<Machine Name=\"a\" Environment=\"DISPLAY=:0\" "
                                 "LowerLeft=\"-1 -1 -1\" LowerRight=\"1 -1 -1\" "
                                 "UpperRight=\"1 1 -1\"/></Process></pvx>");
        folder.write("figure.toml", "width = 30\ndpi = 40\n[[panels]]\nindex = \"a.isochron\"\n");
        folder.write("own.toml", "[rendering]\ncontext = \"egl\"\n[[windows]]\nsize = [64, 48]\n");
        interaction::RecordingHeader header;
        header.configuration = folder.read("own.toml");
        header.data = "a.isochron";
        interaction::RecordingWriter writer(folder.path() / "walk.jsonl", header);
        for (int i = 0; i < 3; ++i)
            writer.append({.input = head_at_rest(i), .commands = {}, .from_panel = {}});
        writer.finish();
        // A stand-in for ffmpeg, which need not be there.
        folder.write("ffmpeg", "#!/bin/sh\nfor last; do :; done\nwc -c > \"$last\"\n");
        fs::permissions(folder.path() / "ffmpeg", fs::perms::owner_all);
        fs::create_directory(folder.path() / "elsewhere");
        for (const std::vector<std::string>& command :
             {as_words("build t0.raw t1.raw t2.raw --dims 8 8 8 --type f32 -o a.isochron"),
              {"replay", "walk.jsonl", "--every", "2", "--out", "shown"}})
            EXPECT_EQ(run_in(folder.path(), command).status, 0);
        return true;
    }();
    EXPECT_TRUE(made);
    return folder;
}

class Outputs : public testing::Test {
  protected:
    Outputs() {
        fs::copy(prepared().path(), folder_.path(), fs::copy_options::recursive);
        // An index knows its sources by their times, too.
        for (const std::string& name : prepared().names())
            fs::last_write_time(folder_.path() / name,
                                fs::last_write_time(prepared().path() / name));
    }

    ChildResult isochron(const std::vector<std::string>& arguments) const {
        return run_in(folder_.path(), arguments);
    }
    void expect_done(const std::vector<std::string>& arguments) const {
        const ChildResult result = isochron(arguments);
        EXPECT_EQ(result.status, 0) << result.err;
    }
    static std::vector<std::string> with(std::vector<std::string> command, const std::string& out,
                                         bool force = false) {
        std::ranges::replace(command, "OUT", out);
        if (force)
            command.emplace_back("--force");
        return command;
    }

    /// All files and folders, and what is in them.
    std::map<std::string, std::string> everything() const {
        std::map<std::string, std::string> all;
        for (const auto& entry : fs::recursive_directory_iterator(folder_.path())) {
            const std::string name = entry.path().lexically_relative(folder_.path()).string();
            if (!name.starts_with("state"))
                all[name] = entry.is_symlink()     ? fs::read_symlink(entry.path()).string()
                            : entry.is_directory() ? "folder"
                                                   : folder_.read(name);
        }
        return all;
    }
    /// One line that says this, and nothing is written.
    void expect_refused(const std::vector<std::string>& command, const std::string& said,
                        const std::string& way_out) const {
        const auto before = everything();
        const ChildResult result = isochron(command);
        EXPECT_EQ(result.status, 1) << result.out << result.err;
        EXPECT_THAT(result.err, HasSubstr(said));
        EXPECT_THAT(result.err, HasSubstr(way_out));
        // Warnings of a display without vertical synchronization and the like come before.
        const std::size_t lines = static_cast<std::size_t>(std::ranges::count(result.err, '\n'));
        EXPECT_EQ(lines, 1u) << result.err;
        const auto after = everything();
        EXPECT_TRUE(after == before) << "something was written";
    }

    TestFolder folder_;
};

/// Each way to tell a command where to write.
class EachOutput : public Outputs, public testing::WithParamInterface<Way> {
  protected:
    EachOutput() {
        if (GetParam().page == "explore")
            screen_.emplace();
    }

  private:
    std::optional<test_support::VirtualDisplay> screen_;
};
/// The ways of commands that read files.
class EachOutputOfAReader : public EachOutput {};
/// The ways that tell a file, which is always written.
class EachOutputFile : public EachOutput {};

TEST_P(EachOutput, ReplacesWhatItWroteAndOtherFilesOnlyByForce) {
    const Way way = GetParam();
    const fs::path file = folder_.path() / way.file;
    fs::create_directories(file.parent_path());
    folder_.write(way.file, kNotes);
    expect_refused(with(way.command, way.out), way.out, "--force replaces it");
    if (way.any_by_force)
        expect_done(with(way.command, way.out, true));
    else
        expect_refused(with(way.command, way.out, true), "not a recording", "");
    if (way.option == "--session") // is saved where something has changed
        return;
    EXPECT_NE(folder_.read(way.file) == kNotes, way.any_by_force);
    if (!way.any_by_force) {
        fs::remove(file);
        expect_done(with(way.command, way.out));
    }
    const std::string written = folder_.read(way.file);
    EXPECT_NE(written, kNotes);
    EXPECT_NE(written, "");
    if (way.replaced == Replaced::unasked)
        expect_done(with(way.command, way.out));
    else
        expect_refused(with(way.command, way.out), "exists already", "--force replaces it");
}

TEST_P(EachOutputOfAReader, ReplacesNothingThatIsReadNotEvenByForce) {
    const Way way = GetParam();
    for (const std::string& read : way.read) {
        SCOPED_TRACE(read);
        const std::string suffix = fs::path(way.out).extension().string();
        const fs::path link = folder_.path() / ("link" + suffix),
                       twin = folder_.path() / ("twin" + suffix);
        fs::create_symlink(read, link);
        fs::create_hard_link(folder_.path() / read, twin);
        for (const std::string& out :
             {read, "elsewhere/../" + link.filename().string(), twin.filename().string()})
            // What a movie or a figure is called says how it is encoded.
            if ((way.page != "movie" && way.page != "figure") ||
                fs::path(out).extension() == suffix)
                expect_refused(with(way.command, out, true), "it would be overwritten",
                               "expected another name");
        expect_refused(with(way.command, link.filename().string()), "it would be overwritten",
                       "expected another name");
        fs::remove(link);
        fs::remove(twin);
    }
}

TEST_P(EachOutputFile, GoesWhereALinkLeadsAndLeavesTheLink) {
    const Way way = GetParam();
    const fs::path link = folder_.path() / way.file, folder = folder_.path() / "elsewhere";
    fs::create_symlink(fs::path("elsewhere") / way.file, link);
    expect_done(with(way.command, way.out));
    EXPECT_TRUE(fs::is_symlink(link));
    EXPECT_TRUE(fs::is_regular_file(folder / way.file));
    EXPECT_EQ(std::distance(fs::directory_iterator(folder), {}), 1);
}

template <class Have>
auto ways_that(Have have) {
    std::vector<Way> all = ways();
    std::erase_if(all, [&](const Way& way) { return !have(way); });
    return testing::ValuesIn(all);
}
std::string way_name(const testing::TestParamInfo<Way>& way) {
    std::string name = way.param.page + way.param.option + "_" + way.param.out;
    std::erase_if(name, [](unsigned char c) { return !std::isalnum(c) && c != '_'; });
    return name;
}
INSTANTIATE_TEST_SUITE_P(Ways, EachOutput, testing::ValuesIn(ways()), way_name);
INSTANTIATE_TEST_SUITE_P(Ways, EachOutputOfAReader,
                         ways_that([](const Way& way) { return !way.read.empty(); }), way_name);
INSTANTIATE_TEST_SUITE_P(Ways, EachOutputFile, ways_that([](const Way& way) {
                             return way.out == way.file && way.option != "--session";
                         }),
                         way_name);

/// Every option of the manual pages whose words say that something is written is a way above.
TEST_F(Outputs, AreAllTriedByTheseTests) {
    std::set<std::string> tried;
    for (const Way& way : ways())
        tried.insert(way.page + " " + way.option);
    // Other data; what only gets names that are not there yet; of a running session; a
    // folder that is replaced only where this command wrote it.
    for (const char* also : {"generate-vorticity --output", "generate-fourier --output",
                             "explore --screenshots", "tell --output", "serve --write-site"})
        tried.insert(also);
    expect_done({"manual", "pages"});
    const std::regex entry(R"(\.TP\n([^\n]*)\n([^\n]*))"), long_name("--[a-z-]+"),
        file("fI(FILE|FOLDER|INDEX)");
    const std::regex writes(
        "\\b([Ww]rite|[Ss]ave|Record the session|Output|Folder for|File for)\\b");
    std::set<std::string> found;
    for (const auto& page : fs::directory_iterator(folder_.path() / "pages")) {
        const std::string text = std::regex_replace(
            folder_.read("pages/" + page.path().filename().string()), std::regex(R"(\\-)"), "-");
        const std::string name = page.path().stem().string();
        const std::string command = name.substr(std::min(name.size(), sizeof "isochron"));
        for (std::sregex_iterator at(text.begin(), text.end(), entry), end; at != end; ++at) {
            const std::string names = (*at)[1], help = (*at)[2];
            std::smatch option;
            if (!std::regex_search(names, file) || !std::regex_search(help, writes) ||
                !std::regex_search(names, option, long_name))
                continue; // no file, or it is read
            found.insert(command + " " + option.str());
        }
    }
    EXPECT_FALSE(found.empty());
    for (const std::string& each : found)
        EXPECT_TRUE(tried.contains(each)) << each << " writes something and is not tried";
    for (const std::string& each : tried)
        EXPECT_TRUE(found.contains(each)) << each << " is tried and is no option that writes";
}

TEST_F(Outputs, DoNotReplaceFilesThatAHeaderNames) {
    std::string bytes(8 * 8 * 8, 'a');
    for (std::size_t i = 0; i < bytes.size(); ++i)
        bytes[i] = static_cast<char>(i % 97);
    folder_.write("elsewhere/v.raw", bytes);
    folder_.write("elsewhere/v.mhd", "NDims = 3\nDimSize = 8 8 8\nElementType = MET_UCHAR\n"
                                     "ElementDataFile = v.raw\n");
    const std::string raw = "elsewhere/v.raw";
    expect_refused({"build", "elsewhere/v.mhd", "-o", raw, "--force"}, "it would be overwritten",
                   "expected another name");
    expect_done({"build", "elsewhere/v.mhd", "-o", "v.isochron"});
    expect_refused(
        {"query", "v.isochron", "--isovalue", "40", "--step", "0", "--ids", raw, "--force"},
        "elsewhere/v.raw: is a source of v.isochron, it would be overwritten",
        "expected another name");
    expect_done(as_words("query v.isochron --isovalue 40 --step 0 --ids ids.bin"));
}

TEST_F(Outputs, DoNotReplaceFilesInAFolderThatIsRead) {
    fs::create_directories(folder_.path() / "run.zarr" / "rho");
    folder_.write("run.zarr/.zgroup", "{\"zarr_format\": 2}");
    folder_.write("run.zarr/rho/.zarray",
                  "{\"zarr_format\": 2, \"shape\": [3, 4, 5], \"chunks\": [3, 4, 5], \"dtype\": "
                  "\"<i4\", \"compressor\": null, \"fill_value\": 0, \"order\": \"C\", "
                  "\"filters\": null}");
    std::string chunk; // as ids of cells would be
    for (std::uint32_t i = 0; i < 60; ++i)
        chunk.append(reinterpret_cast<const char*>(&i), sizeof i);
    folder_.write("run.zarr/rho/0.0.0", chunk);
    const std::vector<std::string> build{"build", "run.zarr", "-o", "OUT"};
    const std::string part = "run.zarr/rho/0.0.0";
    expect_refused(with(build, part, true), "it would be overwritten", "expected another name");
    expect_done(with(build, "z.isochron"));
    for (const bool force : {false, true})
        expect_refused(
            with(as_words("query z.isochron --isovalue 30 --step 0 --ids OUT"), part, force),
            "it would be overwritten", "expected another name");
    // A new name there is none of its files, and an index beside a series is no part of it.
    fs::create_directory(folder_.path() / "series");
    for (const char* name : {"t0.raw", "t1.raw"})
        fs::copy_file(folder_.path() / name, folder_.path() / "series" / name);
    const std::vector<std::string> whole = as_words("build series --dims 8 8 8 --type f32 -o OUT");
    for (int twice = 0; twice < 2; ++twice)
        expect_done(with(whole, "series/s.isochron"));
    expect_refused(with(whole, "series/t1.raw", true), "it would be overwritten",
                   "expected another name");
}

TEST_F(Outputs, OfOneCommandHaveNamesOfTheirOwn) {
    expect_refused(as_words("change a.isochron --isovalue 50 --step 0 --to-step 1 --added same.bin "
                            "--removed ./same.bin"),
                   "two outputs have this name", "expected two names");
}

TEST_F(Outputs, AnIndexBehindALinkFindsTheSourcesThatItRefersTo) {
    fs::create_symlink("elsewhere/r.isochron", folder_.path() / "r.isochron");
    expect_done(as_words("build t?.raw --dims 8 8 8 --type f32 --refer -o r.isochron"));
    for (const char* name : {"r.isochron", "elsewhere/r.isochron"})
        expect_done({"verify", name});
    expect_refused(
        as_words("query elsewhere/r.isochron --isovalue 45 --step 0 --ids t1.raw --force"),
        "t1.raw: is a source of elsewhere/r.isochron", "expected another name");
}

TEST_F(Outputs, AreRecognizedByWhatIsInThem) {
    const std::vector<std::string> query =
        as_words("query a.isochron --isovalue 50 --step 1 --ids OUT");
    const auto ids = [](std::vector<std::uint32_t> all) {
        return std::string(reinterpret_cast<const char*>(all.data()), all.size() * 4);
    };
    for (const std::string& known : {ids({}), ids({0, 5, 342})}) {
        folder_.write("ids.bin", known);
        expect_done(with(query, "ids.bin"));
    }
    // Not ascending, twice the same, no cell (7^3 are there), half an id.
    for (const std::string& foreign :
         {ids({5, 4}), ids({5, 5}), ids({343}), ids({1, 2}).substr(0, 6)}) {
        folder_.write("ids.bin", foreign);
        expect_refused(with(query, "ids.bin"), "ids.bin: exists and is not a file of ascending ids",
                       "but another file of");
    }
    expect_refused(with(query, "walk.jsonl"), "but a recording", "--force replaces it");
    expect_refused(with(query, "shown/frame_00000.png"), "but a picture of this program",
                   "--force replaces it");
    const std::vector<std::string> import = as_words("config import cave.pvx -o cave.toml");
    expect_done(import);
    folder_.write("cave.toml", folder_.read("cave.toml") + "# my tracker\n");
    expect_refused(import, "cave.toml: exists and is not the same configuration",
                   "--force replaces it");
}

} // namespace
} // namespace isochron::app
