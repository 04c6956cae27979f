// The panel's movies: made by another process, given up without a trace, refused in one line.
#include "tests/support/eventually.h"
#include "tests/support/session_fixture.h"

#include "app/kept/recording_file.h"
#include "app/loop/movie_maker.h"
#include "interaction/error.h"

#include <gmock/gmock.h>

#include <cstdlib>
#include <fstream>
#include <set>

namespace isochron::app {
namespace {

namespace fs = std::filesystem;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::StartsWith;

/// A stand-in for the program, told what to do by the folder's script.
class MovieMakerTest : public testing::Test {
  protected:
    MovieOrders orders(const std::string& script) {
        folder_.write("program", "#!/bin/sh\n" + script);
        fs::permissions(folder_.path() / "program", fs::perms::owner_all);
        return {.program = folder_.path() / "program",
                .folder = folder_.path() / "shots",
                .options = {"--shape", "plane"},
                .header = {}};
    }
    static void write(const fs::path& path) { std::ofstream(path) << "a recording"; }
    /// Until the movie is there or is none.
    static std::string outcome(MovieMaker& movies) {
        std::vector<std::string> lines;
        test_support::eventually([&] {
            movies.update();
            lines = movies.messages();
            return !lines.empty();
        });
        EXPECT_EQ(lines.size(), 1u);
        EXPECT_FALSE(movies.busy());
        EXPECT_FALSE(movies.progress());
        return lines.empty() ? std::string() : lines.front();
    }
    std::vector<std::string> shots() const {
        std::vector<std::string> names;
        for (const auto& entry : fs::directory_iterator(folder_.path() / "shots"))
            names.push_back(entry.path().filename().string());
        std::ranges::sort(names);
        return names;
    }

    MovieMakerTest() { fs::create_directory(folder_.path() / "shots"); }

    TestFolder folder_;
    BackgroundWork writing_;
};

TEST_F(MovieMakerTest, TheProgramGetsTheRecordingAndItsWordsAreProgressAndOutcome) {
    MovieMaker movies(orders("echo '40 %'; echo \"$@\" > shots/words; cp \"$2\" \"$4\";"
                             "while [ ! -e go ]; do sleep 0.01; done; echo \"wrote $4\"\n"));
    const fs::path before = fs::current_path();
    fs::current_path(folder_.path());
    EXPECT_FALSE(movies.progress());
    movies.make(write, writing_);
    EXPECT_TRUE(movies.busy());
    EXPECT_TRUE(test_support::eventually([&] {
        movies.update();
        return movies.progress() == 0.4f;
    }));
    movies.make(write, writing_); // one at a time
    folder_.write("go", "");
    const std::string movie = (folder_.path() / "shots/isochron_movie_0001.mp4").string();
    EXPECT_EQ(outcome(movies), "wrote " + movie);
    EXPECT_THAT(shots(),
                ElementsAre("isochron_movie_0001.jsonl", "isochron_movie_0001.mp4", "words"));
    EXPECT_THAT(folder_.read("shots/words"),
                StartsWith("movie " +
                           (folder_.path() / "shots/isochron_movie_0001.jsonl").string() + " -o " +
                           movie + " --background --rate 30 --shape plane"));
    movies.make(write, writing_); // the next has a name of its own
    EXPECT_THAT(outcome(movies), HasSubstr("isochron_movie_0002.mp4"));
    movies.make(write, writing_,
                {.folder = folder_.path() / "far/away", .rate = 12, .width = 640, .height = 360});
    EXPECT_THAT(outcome(movies), HasSubstr("far/away/isochron_movie_0001.mp4"));
    EXPECT_THAT(folder_.read("shots/words"), HasSubstr(" --rate 12 --size 640 360 "));
    fs::current_path(before);
}

TEST_F(MovieMakerTest, WhatKeepsItFromBeingMadeIsOneLineAndNothingIsLeft) {
    MovieMaker complains(orders("echo 'making ...'; echo 'isochron: no ffmpeg' >&2\n"
                                "echo 'a driver: bye'; exit 1\n"));
    complains.make(write, writing_);
    EXPECT_EQ(outcome(complains), "no ffmpeg");
    MovieMaker dies(orders("kill -9 $$\n"));
    dies.make(write, writing_);
    EXPECT_THAT(outcome(dies), HasSubstr("ended without a message"));
    MovieOrders nobody = orders("");
    nobody.program = folder_.path() / "nobody";
    MovieMaker missing(nobody);
    missing.make(write, writing_);
    EXPECT_THAT(outcome(missing), HasSubstr("nobody: No such file"));
    MovieMaker unwritten(orders("touch shots/started\n"));
    unwritten.make([](const fs::path&) { throw interaction::Error("disk full"); }, writing_);
    EXPECT_EQ(outcome(unwritten), "disk full");
    EXPECT_NO_THROW(writing_.finish()) << "no failure of what else is written there";
    EXPECT_THAT(shots(), ElementsAre());
}

TEST_F(MovieMakerTest, GivenUpAtAnyTimeItLeavesNothing) {
    const std::string waits = "trap 'exit 143' TERM; echo '1 %'; while :; do sleep 0.01; done\n";
    MovieMaker movies(orders(waits));
    movies.make(write, writing_);
    movies.give_up(); // before it has begun
    EXPECT_THAT(outcome(movies), StartsWith("canceled: "));
    movies.make(write, writing_);
    EXPECT_TRUE(test_support::eventually([&] {
        movies.update();
        return movies.progress() == 0.01f;
    }));
    movies.give_up();
    EXPECT_THAT(outcome(movies), StartsWith("canceled: "));
    movies.make(write, writing_);
    movies.finish(); // as at the end of a session
    EXPECT_THAT(movies.messages(), ElementsAre(StartsWith("canceled: ")));
    EXPECT_THAT(shots(), ElementsAre());
}

/// As the panel's button leads to it: the whole program, and what it says of ffmpeg.
TEST_F(MovieMakerTest, TheSeriesAtAViewIsAMovieWithEveryStepInIt) {
    const auto file = build_sphere(folder_.path());
    Config config = small_config(stereo::StereoMode::mono);
    config.text = "[rendering]\ncontext = \"egl\"\n[[windows]]\nsize = [64, 48]\n";
    const auto context = stereo::make_context(stereo::ContextKind::egl, {.size = {64, 48}});
    Session session(config, file, *context);
    interaction::Commands commands;
    commands.isovalue = 8;
    commands.instant = index::Instant(3);
    commands.panel = true;
    session.frame(head_at_rest(1), commands, Waiting::for_cells);
    interaction::RecordingHeader header;
    header.configuration = config.text;
    header.data = (folder_.path() / "sphere.isochron").string();
    const auto series = series_seen(header, session.note(), session.times(), 30);
    ASSERT_EQ(series.frames.size(), 7u) << "six steps, and the end of the last";
    for (std::uint32_t i = 0; i < 6; ++i) {
        EXPECT_EQ(series.frames[i].commands.instant, index::Instant(i));
        EXPECT_EQ(*series.frames[i].input.find("head"), *head_at_rest(1).find("head"));
        EXPECT_NEAR(series.frames[i].input.time.count(), i * 10.0 / 6, 1e-4);
    }
    EXPECT_EQ(series.header.start.isovalue, 8);
    EXPECT_EQ(series.header.start.panel, false);

    folder_.write("ffmpeg", "#!/bin/sh\nfor last; do :; done\nwc -c > \"$last\"\n");
    fs::permissions(folder_.path() / "ffmpeg", fs::perms::owner_all);
    const std::string path = std::getenv("PATH");
    setenv("PATH", (folder_.path().string() + ":" + path).c_str(), 1);
    MovieMaker movies({.program = test_support::binary_root() + "/isochron",
                       .folder = folder_.path() / "shots",
                       .options = {},
                       .header = header});
    const auto write_series = [&series](const fs::path& to) { write_recording(to, series); };
    movies.make(write_series, writing_);
    EXPECT_THAT(outcome(movies), HasSubstr("isochron_movie_0001.mp4: 300 frames at 30 per second"));
    EXPECT_EQ(std::stoul(folder_.read("shots/isochron_movie_0001.mp4")), 300u * 64 * 48 * 4);
    fs::remove(folder_.path() / "ffmpeg");
    setenv("PATH", folder_.path().c_str(), 1);
    movies.make(write_series, writing_);
    EXPECT_THAT(outcome(movies), HasSubstr("which cannot be started"));
    setenv("PATH", path.c_str(), 1);
    EXPECT_THAT(shots(), ElementsAre("isochron_movie_0001.jsonl", "isochron_movie_0001.mp4"));
}

TEST(SeriesSeen, EveryStepHasItsFrameHoweverFastTheSeriesPlays) {
    PictureNote view;
    view.state.playback = interaction::PlaybackState{.speed = 64};
    const std::vector<double> times{0, 1, 1.5, 7, 1e9};
    for (const bool reverse : {false, true}) {
        view.state.playback->reverse = reverse;
        const auto series = series_seen({}, view, {times, {}}, 25);
        ASSERT_EQ(series.frames.size(), times.size() + 1);
        for (std::size_t i = 0; i < times.size(); ++i) {
            EXPECT_EQ(series.frames[i].commands.instant,
                      index::Instant(reverse ? times.size() - 1 - i : i));
            if (i > 0)
                EXPECT_GE((series.frames[i].input.time - series.frames[i - 1].input.time).count(),
                          1.0 / 25);
        }
    }
}

TEST(SeriesSeen, FramesOfBlendedStepsAreInstants) {
    PictureNote view;
    view.state.between = interaction::BetweenSteps::blend;
    const std::vector<double> times{0, 1, 2, 3};
    for (const bool reverse : {false, true}) {
        view.state.playback = interaction::PlaybackState{.reverse = reverse, .speed = 0.1};
        const auto series = series_seen({}, view, {times, {}}, 25);
        const double seconds = 10.0 / 4 * 3 / 0.1; // to the last step, which is shown then
        ASSERT_EQ(series.frames.size(), static_cast<std::size_t>(seconds * 25) + 2);
        double before = reverse ? 3 : 0;
        for (std::size_t i = 1; i + 1 < series.frames.size(); ++i) {
            const interaction::Commands& commands = series.frames[i].commands;
            const double now = double(commands.instant->number()) / index::Instant::kFractions;
            EXPECT_NEAR((now - before) * (reverse ? -1 : 1), 3 / (seconds * 25), 1e-4);
            before = now;
        }
        EXPECT_EQ(before, reverse ? 0 : 3);
    }
}

TEST(SeriesSeen, AGapIsHeld) {
    PictureNote view;
    view.state.between = interaction::BetweenSteps::blend;
    view.state.playback = interaction::PlaybackState{.speed = 0.1};
    const std::vector<double> times{0, 1, 2, 3};
    std::set<std::uint32_t> blended;
    std::size_t held = 0;
    for (const auto& frame :
         series_seen({}, view, {times, interaction::StepGaps({1})}, 25).frames) {
        const index::Instant now = frame.commands.instant.value_or(index::Instant());
        if (now.between())
            blended.insert(now.step);
        held += now == index::Instant(1);
    }
    EXPECT_EQ(blended, (std::set<std::uint32_t>{0, 2}));
    EXPECT_NEAR(static_cast<double>(held), 10.0 / 4 / 0.1 * 25, 1) << "as long as it lasts";
}

} // namespace
} // namespace isochron::app
