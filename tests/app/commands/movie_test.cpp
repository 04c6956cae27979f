// A movie has exactly the frames that follow from its rate and its recording's length.
#include "tests/support/as_words.h"
#include "tests/support/session_fixture.h"

#include "app/loop/replay.h"
#include "app/output/movie_file.h"
#include "app/output/picture_note.h"
#include "index/error.h"
#include "index/indexing/index_build.h"
#include "interaction/recording/recording.h"
#include "stereo/image_file.h"
#include "tests/support/child_process.h"
#include "tests/support/memory_series.h"

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <csignal>
#include <cstdlib>
#include <fstream>
#include <set>

namespace isochron::app {
namespace {

/// A stand-in for ffmpeg, which need not be there: it writes how many bytes came.
class MovieTest : public testing::Test {
  protected:
    MovieTest() {
        folder_.write("ffmpeg", "#!/bin/sh\nfor last; do :; done\nwc -c > \"$last\"\n"
                                "printf '%s ' \"$@\" >> \"$last\"\n");
        std::filesystem::permissions(folder_.path() / "ffmpeg", std::filesystem::perms::owner_all);
        before_ = std::getenv("PATH");
        setenv("PATH", (folder_.path().string() + ":" + before_).c_str(), 1);
    }
    ~MovieTest() override { setenv("PATH", before_.c_str(), 1); }

    std::size_t bytes_of(const std::string& name) { return std::stoul(folder_.read(name)); }
    static render::Image picture() { return {4, 2, std::vector<std::uint8_t>(32, 7)}; }

    TestFolder folder_;
    std::string before_;
};

TEST_F(MovieTest, EveryPictureReachesFfmpegAndTheFileAppearsWhole) {
    const auto path = folder_.path() / "a.mp4";
    {
        MovieFile movie(path, {4, 2}, 25);
        for (int i = 0; i < 7; ++i)
            movie.add(picture());
        EXPECT_FALSE(std::filesystem::exists(path));
        movie.finish();
        EXPECT_EQ(movie.frames(), 7u);
    }
    EXPECT_EQ(bytes_of("a.mp4"), 7u * 32);
    EXPECT_THAT(folder_.read("a.mp4"), testing::HasSubstr("-s 4x2 -r 25 "));
    EXPECT_THAT(folder_.read("a.mp4"), testing::HasSubstr("libx264"));
}

TEST_F(MovieTest, ANameWithAColonIsNoProtocolAndALongNoteNoArgument) {
    const std::string note = "a=b;#\\ " + std::string(200'000, 'x');
    const auto before = std::filesystem::current_path();
    std::filesystem::current_path(folder_.path());
    {
        MovieFile movie("10:30.mp4", {4, 2}, 25, note);
        movie.add(picture());
        movie.finish();
    }
    std::filesystem::current_path(before);
    const std::string said = folder_.read("10:30.mp4");
    EXPECT_THAT(said, testing::HasSubstr("-f ffmetadata -i /"));
    EXPECT_THAT(said, testing::ContainsRegex(" /[^ ]*/movie.mp4 $"));
    EXPECT_LT(said.size(), 2000u);
}

TEST_F(MovieTest, IsMadeInAFolderThatNobodyElseCanOpen) {
    const auto folder_mode = [&] {
        for (const auto& entry : std::filesystem::directory_iterator(folder_.path()))
            if (entry.is_directory())
                return entry.status().permissions();
        return std::filesystem::perms::unknown;
    };
    MovieFile movie(folder_.path() / "a.mp4", {4, 2}, 25);
    EXPECT_EQ(folder_mode(), std::filesystem::perms::owner_all);
}

TEST_F(MovieTest, AnAbandonedMovieLeavesNothing) {
    {
        MovieFile movie(folder_.path() / "a.gif", {4, 2}, 25);
        movie.add(picture());
    }
    std::size_t files = 0;
    for (const auto& entry : std::filesystem::directory_iterator(folder_.path()))
        files += entry.path().filename() != "ffmpeg";
    EXPECT_EQ(files, 0u);
}

TEST_F(MovieTest, AFolderHasItsFramesWhenAllAreThereAndReplacesThoseOfAnEarlierOne) {
    const auto path = folder_.path() / "frames";
    folder_.write("note.txt", "");
    {
        MovieFolder movie(path);
        for (int i = 0; i < 3; ++i)
            movie.add(picture());
        EXPECT_FALSE(holds_movie(path));
        movie.finish();
        EXPECT_TRUE(holds_movie(path));
    }
    std::filesystem::rename(folder_.path() / "note.txt", path / "note.txt");
    MovieFolder again(path);
    again.add(picture());
    EXPECT_THROW(again.add({2, 2, std::vector<std::uint8_t>(16, 7)}), index::Error);
    EXPECT_TRUE(std::filesystem::exists(path / "frame_00002.png")) << "the earlier one, until then";
    again.finish();
    std::set<std::string> names;
    for (const auto& entry : std::filesystem::directory_iterator(path))
        names.insert(entry.path().filename().string());
    EXPECT_EQ(names, (std::set<std::string>{"frame_00000.png", "note.txt"}));
}

TEST_F(MovieTest, WhatFfmpegComplainsOfIsTold) {
    folder_.write("ffmpeg", "#!/bin/sh\ncat > /dev/null\necho 'no such codec' >&2\nexit 1\n");
    MovieFile movie(folder_.path() / "a.mp4", {4, 2}, 25);
    movie.add(picture());
    try {
        movie.finish();
        ADD_FAILURE();
    } catch (const index::Error& error) {
        EXPECT_THAT(error.what(), testing::HasSubstr("a.mp4: ffmpeg: no such codec"));
    }
    setenv("PATH", folder_.path().c_str(), 1);
    std::filesystem::remove(folder_.path() / "ffmpeg");
    EXPECT_THROW(MovieFile(folder_.path() / "b.mp4", {4, 2}, 25), index::Error);
}

TEST_F(MovieTest, ARecordingOfASecondHasTheFramesOfASecond) {
    build_sphere(folder_.path());
    // Keeps the note of its file of metadata, as ffmpeg does.
    folder_.write("ffmpeg", "#!/bin/sh\nfor last; do :; done\nwc -c > \"$last\"\n"
                            "while [ \"$1\" != ffmetadata ]; do shift; done\n"
                            "sed -n 's/^comment=//p' \"$3\" | sed 's/\\\\\\(.\\)/\\1/g' "
                            ">> \"$last\"\n");
    interaction::RecordingHeader header;
    header.configuration = "[rendering]\ncontext = \"egl\"\n[[windows]]\nsize = [64, 48]\n";
    header.data = (folder_.path() / "sphere.isochron").string();
    {
        interaction::RecordingWriter writer(folder_.path() / "walk.jsonl", header);
        for (const double time : {0.0, 0.3, 0.301, 0.302, 0.75, 1.0}) // uneven, as real ones are
            writer.append({.input = head_at_rest(time), .commands = {}, .from_panel = {}});
        writer.finish();
    }
    const auto movie = (folder_.path() / "walk.mp4").string();
    const auto recording = (folder_.path() / "walk.jsonl").string();
    const auto program = [&](const std::vector<std::string>& arguments) {
        return run_child(test_support::binary_root() + "/isochron", arguments, folder_.path());
    };
    EXPECT_EQ(program({"movie", recording, "-o", movie, "--rate", "20"}).status, 0);
    EXPECT_EQ(bytes_of("walk.mp4"), 21u * 64 * 48 * 4) << "0, 0.05, ... 1 s";
    EXPECT_EQ(program({"movie", recording, "-o", movie}).status, 1) << "it is there already";
    for (const char* wrong : {"walk.xyz", "nowhere/walk.mp4"}) {
        const ChildResult refused = program({"movie", recording, "-o", wrong});
        EXPECT_NE(refused.status, 0) << wrong;
        EXPECT_EQ(std::count(refused.err.begin(), refused.err.end(), '\n'), 1) << refused.err;
    }
    // A folder holds the same frames; each can be made again.
    EXPECT_EQ(
        program({"movie", recording, "-o", "frames_0.5/", "--rate", "20", "--eyes", "each"}).status,
        0);
    EXPECT_TRUE(std::filesystem::exists(folder_.path() / "frames_0.5_center/frame_00020.png"));
    EXPECT_FALSE(std::filesystem::exists(folder_.path() / "frames_0.5_center/frame_00021.png"));
    EXPECT_EQ(program(as_words("reproduce frames_0.5_center/frame_00020.png")).status, 0);
    // It says what it shows, without a path of this machine.
    const PictureNote note = note_from(note_text_in(movie));
    EXPECT_EQ(note.data, "sphere.isochron");
    EXPECT_EQ(note.data_hash.size(), 16u);
    ASSERT_TRUE(note.movie);
    EXPECT_EQ(note.movie->rate, 20);
    EXPECT_TRUE(note.state.isosurfaces);
    const std::string told = note_text_in(movie);
    EXPECT_EQ(told.find(folder_.path().string()), std::string::npos);
    const ChildResult again = program({"reproduce", movie});
    EXPECT_EQ(again.status, 1);
    EXPECT_THAT(again.err, testing::HasSubstr("isochron movie RECORDING --rate 20"));
}

/// A process that is killed while it makes a movie, by an ffmpeg that does so, leaves its frames; the
/// same command goes on, and its movie has the bytes of one that was made at once.
TEST_F(MovieTest, GoesOnAfterAKillAndHasTheSameBytes) {
    namespace fs = std::filesystem;
    build_sphere(folder_.path());
    const auto ffmpeg = [&](const std::string& script) {
        folder_.write("ffmpeg", "#!/bin/sh\nfor last; do :; done\n" + script);
    };
    const std::string whole = "cat > \"$last\"\n";
    const std::vector<std::string> film =
        as_words("movie sphere.isochron --film both --length 1 --rate 8 --size 64 48 -o a.mp4");
    const auto make = [&](std::vector<std::string> words, const std::string& more = {}) {
        if (!more.empty())
            words.push_back(more);
        return run_child(test_support::binary_root() + "/isochron", words, folder_.path());
    };
    const auto left = [&] {
        std::vector<fs::path> folders;
        for (const auto& entry : fs::directory_iterator(folder_.path()))
            if (entry.path().extension() == ".frames")
                folders.push_back(entry.path());
        return folders;
    };
    ffmpeg(whole);
    ASSERT_EQ(make(film).status, 0);
    const std::string right = folder_.read("a.mp4");
    ASSERT_EQ(right.size(), 9u * 64 * 48 * 4);
    EXPECT_TRUE(left().empty()) << "finished";
    fs::remove(folder_.path() / "a.mp4");

    ffmpeg("head -c 60000 > /dev/null\nkill -9 $PPID\n");
    EXPECT_EQ(make(film).status, 1000 + SIGKILL);
    EXPECT_FALSE(fs::exists(folder_.path() / "a.mp4"));
    ASSERT_EQ(left().size(), 1u);
    const fs::path frames = left().front();
    std::size_t there = 0;
    for (const auto& entry : fs::directory_iterator(frames))
        there += entry.path().filename().string().starts_with("frame_");
    EXPECT_GE(there, 4u) << "60,000 bytes are nearly five frames";
    // One of them is damaged; a file of somebody else lies beside them.
    std::ofstream(frames / "frame_000002", std::ios::app) << "x";
    std::ofstream(frames / "notes.txt") << "mine";
    ffmpeg(whole);
    const ChildResult other = make(film, "--ray"); // another question
    EXPECT_THAT(other.err, testing::HasSubstr(frames.filename().string()));
    fs::remove(folder_.path() / "a.mp4");
    const ChildResult again = make(film);
    EXPECT_EQ(again.status, 0) << again.err;
    EXPECT_THAT(again.out, testing::HasSubstr(fmt::format("{} of its pictures", there)));
    EXPECT_TRUE(folder_.read("a.mp4") == right);
    EXPECT_FALSE(fs::exists(frames / "frame_000000"));
    EXPECT_TRUE(fs::exists(frames / "notes.txt"));
}

TEST_F(MovieTest, ReadyFilmsAreTimeATurnAndBoth) {
    build_sphere(folder_.path());
    const auto of = [&](const std::string& film) {
        const ChildResult made = run_child(test_support::binary_root() + "/isochron",
                                           {"movie", "sphere.isochron", "--film", film, "--rate",
                                            "0.4", "--size", "64", "48", "-o", film + "/"},
                                           folder_.path());
        EXPECT_EQ(made.status, 0) << made.err;
        std::set<std::uint32_t> steps;
        std::set<double> turns;
        for (const auto& entry : std::filesystem::directory_iterator(folder_.path() / film)) {
            const PictureNote note = note_from(note_text_in(entry.path()));
            steps.insert(note.state.instant->step);
            turns.insert(note.state.room_from_physical->rotation.w);
        }
        return std::pair(steps.size() > 1, turns.size() > 1);
    };
    EXPECT_EQ(of("time"), std::pair(true, false));
    EXPECT_EQ(of("turn"), std::pair(false, true));
    EXPECT_EQ(of("both"), std::pair(true, true));
}

TEST_F(MovieTest, WhatAPanoramaCannotBeIsSaidInALine) {
    build_sphere(folder_.path());
    for (const auto& [more, words] : std::vector<std::pair<std::vector<std::string>, std::string>>{
             {{"--size", "512", "256"}, "expected the same even number twice"},
             {{"--size", "511", "511"}, "got 511 511"},
             {{"--emulate"}, "--emulate, --stereo and --eyes go without it"},
             {{"--stereo", "mono"}, "--emulate, --stereo and --eyes go without it"},
             {{"--eyes", "each"}, "--emulate, --stereo and --eyes go without it"}}) {
        std::vector<std::string> all = as_words("movie sphere.isochron --panorama -o p.mp4");
        all.insert(all.end(), more.begin(), more.end());
        const ChildResult refused =
            run_child(test_support::binary_root() + "/isochron", all, folder_.path());
        EXPECT_EQ(refused.status, 2);
        EXPECT_THAT(refused.err, testing::HasSubstr(words));
        EXPECT_EQ(std::count(refused.err.begin(), refused.err.end(), '\n'), 1) << refused.err;
    }
}

TEST_F(MovieTest, OfAnIndexHasEveryStepOnceAsTheExplorerShowsItFirst) {
    build_sphere(folder_.path());
    const auto movie = [&](std::vector<std::string> more) {
        std::vector<std::string> all = as_words("movie sphere.isochron --size 64 48 --rate 0.5");
        all.insert(all.end(), more.begin(), more.end());
        return run_child(test_support::binary_root() + "/isochron", all, folder_.path());
    };
    const auto frames_in = [&](const char* name) {
        std::vector<PictureNote> notes;
        for (std::filesystem::path file;
             file = folder_.path() / name / fmt::format("frame_{:05}.png", notes.size()),
             std::filesystem::exists(file);)
            notes.push_back(note_from(note_text_in(file)));
        return notes;
    };
    // At a frame each two seconds the steps outlast the ten seconds of a whole series.
    EXPECT_EQ(movie({"-o", "all/", "--isovalue", "12.5"}).status, 0);
    const std::vector<PictureNote> all = frames_in("all");
    ASSERT_GE(all.size(), 6u);
    std::set<std::uint32_t> steps;
    for (const PictureNote& note : all) {
        steps.insert(note.state.instant.value_or(index::Instant(999)).step);
        EXPECT_EQ(note.state.isosurfaces->front().isovalue, 12.5);
        EXPECT_EQ(note.footprint, "surface");
    }
    EXPECT_EQ(steps.size(), 6u);
    EXPECT_EQ(*steps.rbegin(), 6u - 1);
    // Some steps, in their order.
    EXPECT_EQ(movie({"-o", "some/", "--steps", "1:3:2"}).status, 0);
    steps.clear();
    for (const PictureNote& note : frames_in("some"))
        steps.insert(note.state.instant.value_or(index::Instant(999)).step);
    EXPECT_EQ(steps, (std::set<std::uint32_t>{1, 3}));
    for (const auto& [wrong, words] : std::vector<std::pair<std::vector<std::string>, std::string>>{
             {{"--steps", "0:999"}, "--steps 0:999: "},
             {{"--data", "a.isochron"}, "--data goes with"}}) {
        std::vector<std::string> words_of = wrong;
        words_of.insert(words_of.end(), {"-o", "no/"});
        const ChildResult refused = movie(words_of);
        EXPECT_NE(refused.status, 0);
        EXPECT_THAT(refused.err, testing::HasSubstr(words));
        EXPECT_FALSE(std::filesystem::exists(folder_.path() / "no"));
    }
}

TEST_F(MovieTest, OfKeysGoesThroughThemAndIsTheSameTwiceAndAsARecording) {
    build_sphere(folder_.path());
    const auto program = [&](const std::vector<std::string>& arguments) {
        return run_child(test_support::binary_root() + "/isochron", arguments, folder_.path());
    };
    const auto movie = [&](const std::string& out, const std::vector<std::string>& more) {
        std::vector<std::string> all{"movie", "sphere.isochron", "-o", out, "--size", "64",
                                     "48",    "--rate",          "4"};
        all.insert(all.end(), more.begin(), more.end());
        return program(all);
    };
    folder_.write("keys.json", R"({"format": "isochron keys", "version": 1, "keys": [
        {"time": 0, "step": 0, "isovalue": 8},
        {"time": 1, "hold": 0.5, "step": 3, "isovalue": 12},
        {"time": 2.5, "step": 5}]})");
    const ChildResult said = movie("a/", {"--keys", "keys.json"});
    ASSERT_EQ(said.status, 0) << said.err;
    EXPECT_THAT(said.out + said.err,
                testing::HasSubstr("/a/: 2.5 s, 11 frames at 4 per second, 64 x 48 pixels"));
    ASSERT_EQ(movie("b/", {"--keys", "keys.json"}).status, 0);
    ASSERT_EQ(movie("film.jsonl", {"--keys", "keys.json"}).status, 0);
    ASSERT_EQ(program(as_words("movie film.jsonl -o c/ --rate 4 --size 64 48")).status, 0);
    std::set<std::string> pictures;
    const auto frame = [&](const char* name, int number) {
        return fmt::format("{}/frame_{:05}.png", name, number);
    };
    for (int i = 0; i < 11; ++i) {
        const std::string bytes = folder_.read(frame("a", i));
        EXPECT_EQ(folder_.read(frame("b", i)), bytes) << i;
        const PictureNote note = note_from(note_text_in(folder_.path() / frame("a", i)));
        const double time = std::min(i / 4.0, 1.0); // eased, then it rests
        EXPECT_NEAR(note.state.isosurfaces->front().isovalue, 8 + 4 * time * time * (3 - 2 * time),
                    1e-9);
        if (i >= 4 && i <= 6) {
            EXPECT_EQ(note.state.instant, index::Instant(3)) << i;
        }
        const PictureNote again = note_from(note_text_in(folder_.path() / frame("c", i)));
        EXPECT_EQ(again.state, note.state) << i;
    }
    EXPECT_EQ(program({"reproduce", frame("c", 7)}).status, 0);
    EXPECT_FALSE(std::filesystem::exists(folder_.path() / frame("a", 11)));
    // A turn ends as it began, and the steps pass meanwhile.
    ASSERT_EQ(movie("turn.jsonl", {"--turn", "--length", "2"}).status, 0);
    std::ifstream file(folder_.path() / "turn.jsonl");
    const interaction::Recording turn = interaction::read_recording(file, "turn.jsonl");
    ASSERT_EQ(turn.frames.size(), 9u);
    EXPECT_EQ(turn.frames.back().commands.room_from_physical, turn.header.start.room_from_physical);
    EXPECT_EQ(turn.frames.back().commands.instant, index::Instant(5));
    EXPECT_NE(program({"movie", "film.jsonl", "--turn", "-o", "no/"}).status, 0);
    EXPECT_NE(program({"movie", "film.jsonl", "-o", "no.jsonl"}).status, 0);
}

// Two lines at the bottom, and nothing else, while the film rests at a key that has words.
TEST_F(MovieTest, OfKeysHasTheirNamesAndTextsAsTitlesWhereThatIsAskedFor) {
    build_sphere(folder_.path());
    const auto movie = [&](const std::string& source, const std::string& out,
                           const std::vector<std::string>& more) {
        std::vector<std::string> all{"movie", source, "-o",     out, "--size",
                                     "320",   "240",  "--rate", "2"};
        all.insert(all.end(), more.begin(), more.end());
        return run_child(test_support::binary_root() + "/isochron", all, folder_.path());
    };
    folder_.write("keys.json", R"({"format": "isochron keys", "version": 1, "keys": [
        {"time": 0}, {"time": 1, "hold": 2, "name": "front", "text": "It is here, %s <b>."},
        {"time": 4, "step": 1}]})");
    ASSERT_EQ(movie("sphere.isochron", "plain/", {"--keys", "keys.json"}).status, 0);
    ASSERT_EQ(movie("sphere.isochron", "titled/", {"--keys", "keys.json", "--titles"}).status, 0);
    ASSERT_EQ(movie("sphere.isochron", "film.jsonl", {"--keys", "keys.json", "--titles"}).status,
              0);
    ASSERT_EQ(movie("film.jsonl", "again/", {"--titles"}).status, 0);
    const auto picture = [&](const char* name, int frame) {
        return stereo::read_image(folder_.path() / fmt::format("{}/frame_{:05}.png", name, frame));
    };
    for (int i = 0; i <= 8; ++i) {
        const render::Image plain = picture("plain", i), titled = picture("titled", i);
        int low = 0, high = 0, most = 0; // rows that differ, from the top
        for (std::size_t at = 0; at < plain.rgba.size(); ++at)
            if (plain.rgba[at] != titled.rgba[at]) {
                const int row = static_cast<int>(at / 4) / plain.width;
                low = most == 0 ? row : std::min(low, row);
                high = std::max(high, row);
                most = std::max(most, std::abs(plain.rgba[at] - titled.rgba[at]));
            }
        // At 1 s it begins to come, after 3 s it has gone.
        EXPECT_EQ(most > 0, i > 2 && i <= 6) << i;
        if (most > 0) {
            EXPECT_GT(low, 240 - 60) << i;
            EXPECT_LT(low, 240 - 30) << "two lines";
            EXPECT_LT(high, 240) << i;
            EXPECT_GT(most, 100) << i;
        }
        EXPECT_EQ(picture("again", i).rgba, titled.rgba) << "as a recording";
    }
    EXPECT_EQ(run_child(test_support::binary_root() + "/isochron",
                        {"reproduce", "titled/frame_00004.png"}, folder_.path())
                  .status,
              0);
    folder_.write(
        "mute.json",
        R"({"format": "isochron keys", "version": 1, "keys": [{"time": 0}, {"time": 1}]})");
    using Row = std::pair<std::string, std::vector<std::string>>;
    for (const auto& [source, wrong] :
         std::vector<Row>{{"sphere.isochron", {"--titles"}},
                          {"sphere.isochron", {"--keys", "mute.json", "--titles"}},
                          {"sphere.isochron", {"--keys", "keys.json", "--titles", "--panorama"}},
                          {"mute.jsonl", {"--titles"}}}) {
        if (source == "mute.jsonl") {
            ASSERT_EQ(movie("sphere.isochron", source, {"--keys", "keys.json"}).status, 0);
        }
        const ChildResult refused = movie(source, "no/", wrong);
        EXPECT_NE(refused.status, 0);
        EXPECT_THAT(refused.err, testing::HasSubstr("--titles"));
        EXPECT_EQ(std::count(refused.err.begin(), refused.err.end(), '\n'), 1) << refused.err;
    }
}

TEST_F(MovieTest, OfKeysThatFitNoDataOrAreAskedForTwiceIsRefusedInOneLine) {
    build_sphere(folder_.path());
    const auto movie = [&](const std::string& out, const std::vector<std::string>& more) {
        std::vector<std::string> all{"movie", "sphere.isochron", "-o", out};
        all.insert(all.end(), more.begin(), more.end());
        return run_child(test_support::binary_root() + "/isochron", all, folder_.path());
    };
    folder_.write("keys.json",
                  R"({"format": "isochron keys", "version": 1, "keys": [{"time": 0}]})");
    folder_.write("late.json", R"({"format": "isochron keys", "version": 1, "keys": [
        {"time": 0}, {"time": 1, "step": 6}]})");
    folder_.write("other.json", R"({"format": "isochron keys", "version": 1, "keys": [
        {"time": 0, "array": "none"}]})");
    folder_.write("unsorted.isochron-session",
                  R"({"format": "isochron session", "version": 1, "data": "sphere.isochron",
        "state": {"keys": [{"time": 0}, {"time": 5}, {"time": 3}]}})");
    using Row = std::pair<std::vector<std::string>, std::string>;
    for (const auto& [wrong, words] :
         std::vector<Row>{{{"--keys", "late.json"},
                           "late.json: key 2 does not fit the data: step is 6, "
                           "expected at most 5"},
                          {{"--keys", "other.json"}, "other.json: key 1 does not fit the data: "},
                          {{"--keys", "none.json"}, "none.json: "},
                          {{"--keys", "keys.json", "--turn"}, "--keys: "},
                          {{"--keys", "unsorted.isochron-session"}, "unsorted.isochron-session: "},
                          {{"--turn", "--steps", "0:4:2"}, "--turn: all steps pass"},
                          {{"--length", "5"}, "--length"},
                          {{"--turn", "--steps", "0:9"}, "--steps 0:9: "}}) {
        const ChildResult refused = movie("no/", wrong);
        EXPECT_NE(refused.status, 0);
        EXPECT_THAT(refused.err, testing::HasSubstr(words));
        EXPECT_EQ(std::count(refused.err.begin(), refused.err.end(), '\n'), 1) << refused.err;
        EXPECT_FALSE(std::filesystem::exists(folder_.path() / "no"));
    }
    EXPECT_THAT(movie("no/", {"--turn", "--rate", "1e300"}).err,
                testing::HasSubstr("--rate: a film has at most 1048576 frames, got "));
    EXPECT_NE(movie("keys.json", {"--keys", "keys.json"}).status, 0);
}

/// A blob that moves so slowly that blends stand for what lies between its steps, or so fast that
/// they do not: the advice is kept in the index as it is built.
TEST_F(MovieTest, OfAnIndexBlendsStepsOrHoldsThemAsTheIndexAdvises) {
    const auto program = [&](const std::vector<std::string>& arguments) {
        const ChildResult result =
            run_child(test_support::binary_root() + "/isochron", arguments, folder_.path());
        EXPECT_EQ(result.status, 0) << result.err;
    };
    const auto moments_in = [&](const std::string& name, const std::vector<std::string>& more) {
        std::vector<std::string> all{
            "movie", name + ".isochron", "-o",  name + "/",   "--size", "32", "24", "--rate",
            "3",     "--steps",          "0:4", "--isovalue", "8"};
        all.insert(all.end(), more.begin(), more.end());
        program(all);
        std::vector<index::Instant> moments;
        for (std::filesystem::path file;
             file = folder_.path() / name / fmt::format("frame_{:05}.png", moments.size()),
             std::filesystem::exists(file);) {
            const PictureNote note = note_from(note_text_in(file));
            moments.push_back(*note.state.instant);
        }
        std::filesystem::remove_all(folder_.path() / name);
        return moments;
    };
    const auto between = [](const std::vector<index::Instant>& moments) {
        return std::ranges::count_if(moments, &index::Instant::between);
    };
    for (const auto& [name, by] : {std::pair("slow", 0.3), std::pair("fast", 10.0)}) {
        const index::TestField field(
            {96, 32, 32}, 7, index::ValueType::f32,
            [by = by](double x, double y, double z, double t) {
                return 16 *
                       std::exp(-std::pow(std::hypot(x - 16 - by * t, y - 16, z - 16), 2) / 32);
            });
        index::MemorySeries series(field.view());
        index::build_index(series, folder_.path() / fmt::format("{}.isochron", name), {});
    }
    EXPECT_GT(between(moments_in("slow", {})), 10);
    EXPECT_EQ(between(moments_in("slow", {"--between", "hold"})), 0);
    EXPECT_EQ(between(moments_in("fast", {})), 0);
    EXPECT_GT(between(moments_in("fast", {"--between", "blend"})), 10);
    folder_.write("hold.toml", "[time]\nbetween = \"hold\"\n[[windows]]\nsize = [32, 24]\n");
    EXPECT_EQ(between(moments_in("slow", {"--config", "hold.toml"})), 0) << "as configured";
}

} // namespace
} // namespace isochron::app
