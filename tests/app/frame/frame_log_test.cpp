// The log of frames: its sums and its report.
#include "app/frame/frame_log.h"
#include "app/frame/late_frame.h"
#include "app/output/known_files.h"
#include "app/panel/parts/messages.h"
#include "index/error.h"
#include "tests/support/test_folder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <malloc.h>

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

TEST(FrameLog, ADayTakesAsMuchMemoryAsTenMinutesAndItsSumsAreOfAllFrames) {
    FrameLog log;
    const int day = 3 * FrameLog::kTenMinutes; // which is as good as any
    for (int i = 0; i < day; ++i) {
        FrameReport frame =
            frame_with(i % 3 == 0 ? Footprint::mesh : Footprint::quad, QualityReason::moving);
        frame.cells = 1;
        frame.missed = i % 2;
        frame.total = Milliseconds(i < 10 ? 500 : 5 + i % 10);
        frame.time = interaction::Seconds(i);
        frame.uploaded.sets = 1;
        log.add(frame);
        log.set_gpu(log.next() - 1, Milliseconds(2));
    }
    EXPECT_EQ(log.next(), static_cast<std::uint64_t>(day));
    EXPECT_EQ(log.frames().size(), FrameLog::kWhole);
    EXPECT_EQ(log.frames().back().time.count(), day - 1);
    EXPECT_EQ(log.missed(), static_cast<std::uint64_t>(day / 2));
    EXPECT_EQ(log.frames_with(Footprint::mesh), static_cast<std::uint64_t>(day / 3));
    EXPECT_EQ(log.moving().frames, static_cast<std::uint64_t>(day));
    EXPECT_EQ(log.moving().as_surface, static_cast<std::uint64_t>(day / 3));
    EXPECT_EQ(log.late().over_three, 10u);
    const TimeSummary total = log.stage(&FrameReport::total);
    EXPECT_NEAR(total.median, 10, 0.1) << "within one percent";
    EXPECT_NEAR(total.p99, 14, 0.14);
    EXPECT_EQ(total.worst, 500) << "of frames whose times are gone";
    EXPECT_NEAR(log.known(&FrameReport::gpu).median, 2, 0.02);
    EXPECT_EQ(log.stage(&FrameReport::total, 10).worst, 14);
    log.set_gpu(0, Milliseconds(99)); // no longer there
    EXPECT_EQ(log.known(&FrameReport::gpu).worst, 2);
}

TEST(FrameLog, AnHourOfFramesTakesNoMoreMemoryThanElevenMinutes) {
    FrameLog log;
    const auto run = [&](int minutes) { // at 60 frames per second
        for (int i = 0; i < minutes * 3600; ++i) {
            FrameReport frame = frame_with(Footprint::mesh, QualityReason::moving);
            frame.time = interaction::Seconds(static_cast<double>(log.next()) / 60);
            frame.shown = frame.asked;
            frame.tracking = {{.name = "a head with a long name", .age = interaction::Seconds(1)},
                              {.name = "a wand with a long name", .age = interaction::Seconds(1)}};
            log.add(frame);
            log.set_gpu(log.next() - 1, Milliseconds(2));
        }
        return ::mallinfo2().uordblks; // none under a sanitizer, which has an allocator of its own
    };
    const auto before = run(11), after = run(49);
    RecordProperty("bytes", std::to_string(after));
    EXPECT_LE(static_cast<double>(after), 1.02 * static_cast<double>(before));
}

TEST(FrameLog, AReportHasTheRowOfEveryFrameAndHoldsFewOfThem) {
    test_support::TestFolder folder;
    FrameLog log;
    log.add({});
    log.report_to(folder.path() / "report.json");
    const int frames = 5000; // more than are kept whole
    for (int i = 0; i < frames; ++i) {
        FrameReport frame = frame_with(Footprint::quad, QualityReason::moving);
        frame.cells = static_cast<std::uint64_t>(i);
        log.add(frame);
        if (i >= 3)
            log.set_gpu(log.next() - 4, Milliseconds(i - 3)); // three frames later
    }
    EXPECT_FALSE(std::filesystem::exists(folder.path() / "report.json")) << "is not complete";
    log.finish_report("a context", {});
    const auto report = nlohmann::json::parse(folder.read("report.json"));
    EXPECT_EQ(report["frames"], frames + 1);
    const auto& rows = report["rows"];
    const auto report_file = folder.path() / "report.json";
    EXPECT_TRUE(is_known(report_file, {report_file, OutputKind::report})) << "is replaced";
    ASSERT_EQ(rows.size(), static_cast<std::size_t>(frames)) << "from when it was asked for";
    for (int i = 0; i < frames; ++i) {
        ASSERT_EQ(rows[i]["cells"], i);
        ASSERT_EQ(rows[i]["gpu_ms"], i < frames - 3 ? nlohmann::json(double(i)) : nlohmann::json());
    }
}

TEST(FrameLog, AReportWithoutFramesIsAReport) {
    test_support::TestFolder folder;
    FrameLog log;
    log.report_to(folder.path() / "report.json");
    log.finish_report("a context", {});
    const auto report = nlohmann::json::parse(folder.read("report.json"));
    EXPECT_EQ(report["rows"], nlohmann::json::array());
    const auto report_file = folder.path() / "report.json";
    EXPECT_TRUE(is_known(report_file, {report_file, OutputKind::report}));
    EXPECT_EQ(report["frames"], 0);
}

TEST(FrameLog, AReportThatCannotBeWrittenIsAnError) {
    test_support::TestFolder folder;
    FrameLog log;
    EXPECT_THROW(log.report_to(folder.path() / "missing" / "report.json"), index::Error);
}

TEST(TimeTally, SummariesAreThoseOfTheTimesWithinOnePercent) {
    TimeTally tally;
    EXPECT_EQ(tally.summary().worst, 0);
    std::vector<double> times;
    double time = 0.002;
    for (int i = 0; i < 3000; ++i, time *= 1.004) {
        times.push_back(time);
        tally.add(time);
    }
    const TimeSummary exact = summarize(times), told = tally.summary();
    EXPECT_NEAR(told.median / exact.median, 1, 0.01);
    EXPECT_NEAR(told.p99 / exact.p99, 1, 0.01);
    EXPECT_EQ(told.worst, exact.worst);
    TimeTally zero;
    zero.add(0);
    EXPECT_EQ(zero.summary().median, 0);
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

TEST(FrameLog, ASurfaceThatComesAfterAWaitHasNotTakenSoLong) {
    FrameLog log;
    const auto add = [&](double time, Footprint footprint, QualityReason reason, bool after_wait) {
        FrameReport frame = frame_with(footprint, reason);
        frame.time = interaction::Seconds(time);
        frame.redrawn = true;
        frame.cells = 100;
        frame.after_wait = after_wait;
        log.add(frame);
    };
    add(1.0, Footprint::quad, QualityReason::moving, false);
    add(1.1, Footprint::quad, QualityReason::trial, false); // and stays so
    add(3600, Footprint::surface, QualityReason::trial, true);
    EXPECT_EQ(log.rests().count, 1u);
    EXPECT_EQ(log.rests().exact, 0u);
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
    EXPECT_EQ(log.rests().exact, 1u);
    EXPECT_NEAR(log.rests().exact_after.summary().worst, 220, 1e-6);
    EXPECT_THAT(log.table(), HasSubstr("4 frames, 50 % of them as mesh or surface"));
    EXPECT_THAT(log.table(), HasSubstr("2 times, 1 of them exact after 220 ms"));
}

TEST(FrameLog, TheReportTellsHowEveryFrameWasDrawnAndWhy) {
    test_support::TestFolder folder;
    FrameLog log;
    log.report_to(folder.path() / "report.json");
    log.add(frame_with(Footprint::quad, QualityReason::moving));
    FrameReport trial = frame_with(Footprint::gaussian, QualityReason::trial);
    trial.missed = 2;
    trial.reused = 1234;
    log.add(trial);
    FrameReport last = frame_with(Footprint::gaussian, QualityReason::over_budget);
    last.expected = Milliseconds(7.25);
    last.missed = 1;
    last.pose_age = Milliseconds(3.5);
    last.latency = Milliseconds(12.5);
    log.add(last);
    log.set_gpu(2, Milliseconds(6.5));
    log.finish_report("a context",
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
    EXPECT_EQ(rows[1]["reused"], 1234);
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
    log.report_to(folder.path() / "report.json");
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
    log.finish_report("a context", {});
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
              "settled: gaussian, 7.2 of 11.1 ms (the next better way of drawing takes 14.2 ms)");
    EXPECT_EQ(quality_line(frame_with(Footprint::quad, QualityReason::moving)), "moving: quad");
}

} // namespace
} // namespace isochron::app
