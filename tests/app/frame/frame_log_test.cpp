// The log of frames: its sums and its report.
#include "app/frame/frame_log.h"
#include "app/frame/late_frame.h"
#include "app/panel/parts/notes.h"
#include "tests/support/test_folder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace isochron::app {
namespace {

using render::Footprint;
using testing::HasSubstr;

FrameReport frame_with(Footprint footprint, QualityReason reason) {
    FrameReport frame;
    frame.footprint = footprint;
    frame.reason = reason;
    frame.pace =
        reason == QualityReason::moving ? interaction::Pace::moving : interaction::Pace::settled;
    frame.budget = Milliseconds(11.1);
    return frame;
}

TEST(FrameLog, GpuTimesReachTheirFramesLater) {
    FrameLog log;
    for (int i = 0; i < 5; ++i) {
        EXPECT_EQ(log.next(), static_cast<std::uint64_t>(i));
        log.add({});
    }
    log.set_gpu(1, Milliseconds(4));
    log.set_gpu(3, Milliseconds(8));
    log.set_gpu(5, Milliseconds(99)); // not there yet
    EXPECT_EQ(log.frames()[1].gpu, Milliseconds(4));
    EXPECT_EQ(log.frames()[3].gpu, Milliseconds(8));
    EXPECT_EQ(log.frames()[4].gpu, std::nullopt);
    EXPECT_EQ(log.known(&FrameReport::gpu).worst, 8);
}

TEST(FrameLog, KeepsSoManyOfTheNewestAsItIsToldTo) {
    FrameLog log;
    for (int i = 0; i < 10; ++i)
        log.add({});
    log.keep(3);
    FrameReport last;
    last.cells = 7;
    log.add(last);
    EXPECT_EQ(log.frames().size(), 3u);
    EXPECT_EQ(log.frames().back().cells, 7u);
    EXPECT_EQ(log.next(), 11u);
    log.set_gpu(10, Milliseconds(4));
    log.set_gpu(2, Milliseconds(99)); // no longer there
    EXPECT_EQ(log.known(&FrameReport::gpu).worst, 4);
}

TEST(FrameLog, TimeInWhichNothingWasToBeDoneIsNoFramesTime) {
    FrameLog log;
    double time = 0;
    for (int i = 0; i < 10; ++i) {
        FrameReport frame = frame_with(Footprint::quad, QualityReason::fits);
        frame.after_wait = i == 5;
        frame.time = interaction::Seconds(time += frame.after_wait ? 3600 : 0.02);
        log.add(frame);
    }
    EXPECT_NEAR(log.frames_per_second(0), 0, 1e-9);
    EXPECT_NEAR(log.frames_per_second(10), 50, 1e-6);
    EXPECT_NEAR(log.frames_per_second(5), 50, 1e-6);
}

TEST(FrameLog, SaysHowOftenTheSurfaceItselfWasShownInMotionAndHowSoonAtRest) {
    FrameLog log;
    const auto add = [&](double time, Footprint footprint, QualityReason reason,
                         bool redrawn = true, std::size_t cells = 100) {
        FrameReport frame = frame_with(footprint, reason);
        frame.time = interaction::Seconds(time);
        frame.total = Milliseconds(20);
        frame.redrawn = redrawn;
        frame.cells = cells;
        log.add(frame);
    };
    const auto moving = QualityReason::moving, rest = QualityReason::trial;
    add(0.0, Footprint::quad, moving, true, 0); // nothing to see
    add(0.1, Footprint::quad, moving);
    add(0.2, Footprint::mesh, moving);
    add(0.3, Footprint::surface, moving);
    add(0.4, Footprint::surface, moving, false); // not drawn again
    add(0.5, Footprint::gaussian, rest);
    add(0.6, Footprint::surface, rest);
    add(0.7, Footprint::surface, rest);
    add(0.8, Footprint::quad, moving);
    add(0.9, Footprint::gaussian, rest); // and never better
    EXPECT_EQ(log.moving().frames, 4u);
    EXPECT_EQ(log.moving().as_surface, 2u);
    EXPECT_EQ(log.rests().count, 2u);
    ASSERT_EQ(log.rests().exact_after.size(), 1u);
    EXPECT_NEAR(log.rests().exact_after[0], 220, 1e-6);
    EXPECT_THAT(log.table(), HasSubstr("4 frames, 50 % of them as mesh or surface"));
    EXPECT_THAT(log.table(), HasSubstr("2 times, 1 of them exact after 220 ms"));
}

TEST(FrameLog, TheReportTellsHowEveryFrameWasDrawnAndWhy) {
    test_support::TestFolder folder;
    FrameLog log;
    log.add(frame_with(Footprint::quad, QualityReason::moving));
    FrameReport trial = frame_with(Footprint::gaussian, QualityReason::trial);
    trial.missed = 2;
    log.add(trial);
    FrameReport last = frame_with(Footprint::gaussian, QualityReason::over_budget);
    last.expected = Milliseconds(7.25);
    last.missed = 1;
    last.pose_age = Milliseconds(3.5);
    last.latency = Milliseconds(12.5);
    log.add(last);
    log.set_gpu(2, Milliseconds(6.5));
    log.write(folder.path() / "report.json", "a context",
              {.bytes = 4000, .hits = 30, .misses = 10, .held = 3000, .budget = 5000});
    const auto report = nlohmann::json::parse(folder.read("report.json"));
    EXPECT_EQ(report["missed"], 3);
    EXPECT_EQ(
        report["reading"],
        (nlohmann::json{
            {"bytes", 4000}, {"hits", 30}, {"misses", 10}, {"held", 3000}, {"budget", 5000}}));
    EXPECT_EQ(report["footprints"],
              (nlohmann::json{{"quad", 1}, {"gaussian", 2}, {"mesh", 0}, {"surface", 0}}));
    EXPECT_EQ(report["milliseconds"]["gpu"]["worst"], 6.5);
    const auto& rows = report["rows"];
    EXPECT_EQ(rows[0]["footprint"], "quad");
    EXPECT_EQ(rows[0]["reason"], "moving");
    EXPECT_TRUE(rows[0]["gpu_ms"].is_null());
    EXPECT_TRUE(rows[0]["expected_ms"].is_null());
    EXPECT_EQ(rows[1]["missed"], 2);
    EXPECT_EQ(rows[2]["reason"], "over budget");
    EXPECT_EQ(rows[2]["budget_ms"], 11.1);
    EXPECT_EQ(rows[2]["expected_ms"], 7.25);
    EXPECT_EQ(rows[2]["gpu_ms"], 6.5);
    EXPECT_TRUE(rows[1]["pose_age_ms"].is_null());
    EXPECT_EQ(rows[2]["pose_age_ms"], 3.5);
    EXPECT_EQ(rows[2]["latency_ms"], 12.5);
    EXPECT_EQ(report["milliseconds"]["pose_age"]["worst"], 3.5);
    EXPECT_EQ(report["milliseconds"]["latency"]["worst"], 12.5);
    EXPECT_THAT(log.table(), HasSubstr("missed"));
    EXPECT_THAT(log.table(), HasSubstr("gaussian             2 frames"));
}

TEST(FrameLog, NamesWhatTookALateFrame) {
    test_support::TestFolder folder;
    FrameLog log;
    FrameReport frame = frame_with(Footprint::quad, QualityReason::moving);
    frame.budget = Milliseconds(100);
    frame.draw = Milliseconds(150);
    frame.total = Milliseconds(200);
    log.add(frame);
    EXPECT_FALSE(is_late(frame));
    frame.total = Milliseconds(201);
    frame.processor = Milliseconds(402);
    frame.extracting = true;
    frame.expected = Milliseconds(70);
    log.add(frame);
    frame.footprint = Footprint::surface;
    frame.reason = QualityReason::trial;
    frame.upload = Milliseconds(151);
    frame.total = Milliseconds(302);
    frame.uploaded.sets = 1;
    frame.extracting = false;
    frame.expected.reset();
    log.add(frame);
    frame.upload = Milliseconds(10);
    frame.redrawn = false;
    frame.uploaded.sets = 0;
    frame.total = Milliseconds(1000);
    log.add(frame);
    const FrameLog::Late late = log.late();
    EXPECT_EQ(late.over_two, 3u);
    EXPECT_EQ(late.over_three, 2u);
    EXPECT_EQ(late.stages,
              (std::map<std::string, std::uint64_t>{{"draw", 1}, {"rest", 1}, {"upload", 1}}));
    EXPECT_THAT(log.table(), HasSubstr("3 frames over two budgets, 2 over three: draw 1 rest 1"));
    log.write(folder.path() / "report.json", "a context", {});
    const auto report = nlohmann::json::parse(folder.read("report.json"));
    EXPECT_EQ(report["late"]["over_two_budgets"], 3);
    const auto& rows = report["rows"];
    EXPECT_FALSE(rows[0].contains("late"));
    EXPECT_EQ(rows[1]["late"], "draw took 150 of 201 ms (quad, moving, expected 70 ms; cells were "
                               "being extracted; 2.0 processors worked)");
    EXPECT_EQ(rows[2]["late"], "upload took 151 of 302 ms (surface, trial, for the first time; a "
                               "set of cells came; 1.3 processors worked)");
    EXPECT_EQ(rows[3]["late"],
              "rest took 840 of 1000 ms (surface, trial, not drawn again; 0.4 processors worked)");
    EXPECT_EQ(rows[1]["extracting"], true);
    EXPECT_EQ(rows[1]["processor_ms"], 402.0);
    frame.budget = Milliseconds(0);
    EXPECT_FALSE(is_late(frame)) << "no budget";
}

TEST(QualityLine, SaysPaceFootprintCostAndWhy) {
    FrameReport frame = frame_with(Footprint::surface, QualityReason::fits);
    EXPECT_EQ(quality_line(frame), "settled: surface");
    frame.expected = Milliseconds(7.24);
    EXPECT_EQ(quality_line(frame), "settled: surface, 7.2 of 11.1 ms");
    frame.footprint = Footprint::gaussian;
    frame.reason = QualityReason::trial;
    EXPECT_EQ(quality_line(frame), "settled: gaussian, 7.2 of 11.1 ms (trial)");
    frame.reason = QualityReason::over_budget;
    frame.better = Milliseconds(14.2);
    EXPECT_EQ(quality_line(frame),
              "settled: gaussian, 7.2 of 11.1 ms (the next better one takes 14.2 ms)");
    EXPECT_EQ(quality_line(frame_with(Footprint::quad, QualityReason::moving)), "moving: quad");
}

} // namespace
} // namespace isochron::app
