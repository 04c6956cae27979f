// What a picture at rest comes to: all cells, from pictures that only get better.
#include "tests/app/session/large_session.h"
#include "tests/support/gate.h"

#include <algorithm>
#include <atomic>
#include <memory>
#include <random>
#include <stop_token>
#include <utility>
#include <vector>

namespace isochron::app {
namespace {

using SessionRest = SessionDetail;

const std::atomic<bool> kNever = false;
constexpr std::uint64_t kFirstAtRest = 15'000; ///< the first set at rest has 18,524 cells

/// Frames of a session in which quads take a known time for each cell, or suddenly much longer.
class KnownTimes final : public FramesAlone {
  public:
    explicit KnownTimes(const std::atomic<bool>& stalls = kNever) : stalls_(stalls) {}
    std::vector<DrawSample> samples(std::vector<DrawSample>) override {
        constexpr double kOfCell = 1.5 / 20'000 / 2; // ms, in two views
        const double slower = stalls_ ? 1000 : 1;
        std::vector<DrawSample> all(1);
        all[0].load = {2e4, 1 << 15};
        all[0].processor = Milliseconds(slower * kOfCell * all[0].load.cells);
        return all;
    }

  private:
    const std::atomic<bool>& stalls_;
};

/// Answers with at most so many cells, however many are asked for: that depends on what was measured.
/// @param most_cells 0: all of level 0
index::ExtractionPtr with_cells(const index::Extract& extract, std::uint64_t most_cells,
                                const index::SurfacesQuery& query, std::stop_token stop) {
    index::SurfacesQuery same = query;
    same.detail = {most_cells, query.detail.at_rest, {}};
    const index::ExtractionPtr set = extract(same, std::move(stop));
    if (!set)
        return nullptr;
    auto asked = std::make_shared<index::Extraction>(*set);
    asked->query = query;
    return asked;
}

/// Counts cells of level 0 at rest only, as in a large step: until then nobody knows what an eighth
/// of them is, and moving pictures may have fewer.
index::Extract uncounted(const index::Extract& extract) {
    return
        [extract](const index::SurfacesQuery& query, std::stop_token stop) -> index::ExtractionPtr {
            const index::ExtractionPtr set = extract(query, std::move(stop));
            if (!set || query.detail.at_rest)
                return set;
            auto same = std::make_shared<index::Extraction>(*set);
            same->volume_cells.reset();
            return same;
        };
}

TEST_P(SessionRest, PartsBeginAnewWhereAFinerSetComes) {
    Config config = config_with(1e-6);
    config.quality.still_budget_ms = 1e-6; // a piece in each frame
    config.quality.settled = render::Footprint::gaussian; // coarse cells are made in parts, too
    const auto second_picture = [&](bool in_the_midst) {
        test_support::Gate at_rest;
        std::atomic<bool> asked = false, found = false;
        const index::Extract real = extract();
        const index::Extract controlled = [&](const index::SurfacesQuery& query,
                                              std::stop_token stop) -> index::ExtractionPtr {
            if (!query.detail.at_rest)
                return real(query, stop);
            asked = true;
            at_rest.pass(stop);
            const index::ExtractionPtr set = with_cells(real, 20'000, query, stop);
            asked = set != nullptr; // else it will be asked again
            found = set != nullptr || found;
            return set;
        };
        Session session(config, large_, *context_, controlled);
        FrameReport report = first_frame(session, false);
        const auto made = [&] {
            return report.in_parts && report.cells > 0 && report.footprint == *report.in_parts;
        };
        EXPECT_TRUE(test_support::eventually([&] {
            report = frame(session, false);
            return asked && (in_the_midst ? report.in_parts && !made() : made());
        }));
        for (int i = 0; i < 12; ++i) // until some cells are drawn, and not only put in order
            report = frame(session, false);
        EXPECT_NE(made(), in_the_midst);
        const std::uint64_t cells = report.cells;
        at_rest.open();
        EXPECT_TRUE(test_support::eventually([&] {
            if (!asked)
                report = frame(session, false);
            return found.load();
        }));
        EXPECT_TRUE(test_support::eventually([&] {
            report = frame(session, false);
            return report.cells != cells && made();
        }));
        return session.outputs().display().read_window().rgba;
    };
    EXPECT_TRUE(second_picture(true) == second_picture(false));
}

TEST_P(SessionRest, APictureAtRestGetsAllCellsThoughNoPauseHoldsThemAndSomeOfThemSoon) {
    Config config = config_with(1e-6);
    config.quality.still_budget_ms = 1e-6; // a piece in each frame
    Session session(config, large_, *context_);
    FrameReport report = first_frame(session, false);
    for (int rest = 0; rest < 2; ++rest) {
        SCOPED_TRACE(rest);
        std::uint64_t most = 0; // cells of pictures that came before
        int coarse = 0;
        ASSERT_TRUE(test_support::eventually([&] {
            const auto ends = [&] { return report.final && report.cells > 0; };
            for (int i = 0; i < 50 && !ends(); ++i) { // the worker may take its time
                report = frame(session, false);
                if (!report.redrawn ||
                    (report.reason != QualityReason::in_parts && report.coarsest == 0))
                    continue;
                if (report.coarsest == 0)
                    EXPECT_GE(report.cells, most) << "all of them in the end";
                most = std::max(most, report.cells);
                coarse += report.coarsest > 0;
            }
            return ends();
        }));
        EXPECT_EQ(report.coarsest, 0u);
        EXPECT_GT(report.cells, 3 * kFew);
        EXPECT_EQ(report.footprint, render::Footprint::surface);
        if (rest == 0)
            EXPECT_GT(coarse, 0) << "all cells take long";
        for (int i = 0; i < 3; ++i)
            report = frame(session, true);
        EXPECT_TRUE(report.coarsest > 0 || report.mesh_level > 0)
            << "of less detail while it moves";
    }
}

TEST_P(SessionRest, AfterMotionAllCellsThatAreThereStayAndNoOtherSetTakesTheirPlace) {
    const index::Extract real = extract();
    std::atomic<int> at_rest = 0; // searches for pictures at rest
    Session session(config_with(1e-6), large_, *context_,
                    [&](const index::SurfacesQuery& query, std::stop_token stop) {
                        at_rest += query.detail.at_rest;
                        return real(query, std::move(stop));
                    });
    FrameReport report = first_frame(session, false);
    const auto comes_to_rest = [&] {
        return test_support::eventually([&] {
            report = frame(session, false);
            return report.final && report.cells > 0 && report.coarsest == 0;
        });
    };
    ASSERT_TRUE(comes_to_rest());
    const int searches = at_rest;
    const std::uint64_t all = report.cells;
    for (int orbit = 0; orbit < 3; ++orbit) {
        SCOPED_TRACE(orbit);
        for (int i = 0; i < 8; ++i) {
            interaction::InputState input = head_at_rest(frame_++ / 60.0);
            input.devices[0].pose->position.x = 0.05f * static_cast<float>(i + orbit);
            report = session.frame(input, {}, Waiting::never);
        }
        ASSERT_EQ(report.pace, interaction::Pace::moving);
        std::vector<std::uint64_t> shown{report.cells}; // each number when another one comes
        ASSERT_TRUE(test_support::eventually([&] {
            report = frame(session, false);
            if (report.cells != shown.back())
                shown.push_back(report.cells);
            EXPECT_NE(report.footprint, render::Footprint::gaussian);
            return report.final && report.coarsest == 0;
        }));
        EXPECT_LE(shown.size(), 2u) << "the cells that moved, and then all of them";
        EXPECT_EQ(report.cells, all);
    }
    EXPECT_LE(at_rest, searches + 1) << "none for each orbit: all cells are there";
}

TEST_P(SessionRest, ATimeThatStallsTakesNoCellsFromAPictureAtRest) {
    Config config = config_with(1e-6);
    config.quality.still_budget_ms = 2; // three quarters of it hold 20,000 cells
    std::atomic<bool> stalls = false;
    Session session(config, large_, *context_);
    session.share_frames(std::make_unique<KnownTimes>(stalls));
    FrameReport report = first_frame(session, false);
    std::uint64_t most = 0;
    int coarse = 0; // sets of a coarser level
    ASSERT_TRUE(test_support::eventually([&] {
        report = frame(session, false);
        if (!report.redrawn || report.cells < kFirstAtRest)
            return report.final && report.cells > 0 && report.coarsest == 0;
        if (report.coarsest == 0)
            EXPECT_GE(report.cells, most);
        coarse += report.coarsest > 0 && report.cells > most;
        most = std::max(most, report.cells);
        stalls = coarse > 0;
        return false;
    }));
    EXPECT_EQ(coarse, 1);
    EXPECT_EQ(report.coarsest, 0u);
    EXPECT_GT(most, 3 * kFew);
}

TEST_P(SessionRest, TheFirstFrameDoesNotAskForAllCells) {
    std::atomic<bool> all = false;
    const index::Extract real = index::extract_from(large_);
    Session session(config_with(1e-6), large_, *context_,
                    [&](const index::SurfacesQuery& query, std::stop_token stop) {
                        all = all || query.detail.most_cells == 0;
                        return real(query, std::move(stop));
                    });
    EXPECT_TRUE(test_support::eventually([&] { return frame(session, true).cells > 0; }));
    EXPECT_FALSE(all);
}

TEST_P(SessionRest, SomeMoreCellsComeBeforeFarMoreThanWereDrawn) {
    Config config = config_with(1e-6);     // moving pictures have as few as there may be
    config.quality.still_budget_ms = 1000; // would hold all
    Session session(config, large_, *context_, uncounted(extract()));
    session.share_frames(std::make_unique<KnownTimes>());
    FrameReport report = first_frame(session, true);
    ASSERT_TRUE(test_support::eventually([&] {
        report = frame(session, true);
        return report.cells > 0 && report.cells < 2 * DetailChooser::kFewest;
    }));
    const std::uint64_t moving = report.cells;
    std::uint64_t most = moving;
    int coarse = 0; // sets of more
    ASSERT_TRUE(test_support::eventually([&] {
        report = frame(session, false);
        if (report.cells > most && report.coarsest > 0) {
            EXPECT_LE(report.cells, 12 * moving);
            most = report.cells;
            ++coarse;
        }
        return report.final && report.coarsest == 0;
    }));
    EXPECT_EQ(coarse, 1);
    EXPECT_GT(report.cells, 12 * moving);
}

TEST_P(SessionRest, FarMoreCellsThanWereDrawnAreDrawnInPartsThoughTheyAreExpectedToFit) {
    const index::Extract real = extract();
    const index::Extract controlled = [&](const index::SurfacesQuery& query, std::stop_token stop) {
        return with_cells(real, query.detail.at_rest ? 0 : DetailChooser::kFewest, query, stop);
    };
    Session session(config_with(20), large_, *context_, controlled);
    session.share_frames(std::make_unique<KnownTimes>()); // all know 14 ms
    FrameReport report = first_frame(session, false);
    std::uint64_t last = 0, far = 0; // cells that were drawn
    ASSERT_TRUE(test_support::eventually([&] {
        report = frame(session, false);
        if (report.redrawn && last > 0 && report.cells > 4 * last) {
            EXPECT_EQ(report.reason, QualityReason::in_parts) << report.cells << " after " << last;
            far = report.cells;
        }
        last = report.redrawn ? report.cells : last;
        return report.final && report.cells > 0 && report.coarsest == 0;
    }));
    EXPECT_GT(far, 0u);
}

TEST_P(SessionRest, AllCellsAreFoundWhileTheFirstOnesAreDrawnWhichAreSeenAllTheSame) {
    Config config = config_with(1e-6);
    config.quality.still_budget_ms = 2;
    const index::Extract real = extract();
    std::atomic<bool> all_asked = false, all_found = false;
    Session session(
        config, large_, *context_, [&](const index::SurfacesQuery& query, std::stop_token stop) {
            constexpr std::uint64_t kMany = 1'000'000; // more than there are
            all_asked = all_asked || (query.detail.at_rest && query.detail.most_cells >= kMany);
            index::ExtractionPtr set = real(query, stop);
            if (set && query.detail.at_rest && !set->coarse())
                all_found = true;
            return set;
        });
    session.share_frames(std::make_unique<KnownTimes>());
    FrameReport report = first_frame(session, false);
    ASSERT_TRUE(test_support::eventually([&] {
        report = frame(session, false);
        return report.cells > kFirstAtRest && report.coarsest > 0;
    })) << "the first set at rest, of 18,524 cells";
    ASSERT_TRUE(test_support::eventually([&] { // which waits for what is on its way
        if (!all_asked)
            report = frame(session, false);
        return all_asked.load();
    }));
    ASSERT_TRUE(test_support::eventually([&] { return all_found.load(); }));
    int coarse = 0; // pictures in parts
    ASSERT_TRUE(test_support::eventually([&] {
        report = frame(session, false);
        coarse += report.coarsest > 0 && report.cells > kFirstAtRest;
        return report.final && report.coarsest == 0;
    }));
    EXPECT_GT(coarse, 0) << "they stay until all are drawn";
}

TEST_P(SessionRest, ASetForMotionThatComesWhenThePictureRestsTakesNoCellsBack) {
    const index::Extract real = uncounted(extract());
    constexpr std::uint64_t kMany = 3 * kFew / 2;
    std::atomic<bool> stalls = false, hold = false, held = false;
    test_support::Gate at_rest;
    std::atomic<std::uint64_t> late = 0; // cells
    // One that has just been found when it is no longer wanted cannot be stopped.
    const index::Extract controlled = [&](const index::SurfacesQuery& query, std::stop_token stop) {
        if (query.detail.at_rest && late > 0)
            at_rest.pass(stop);
        if (query.detail.at_rest || query.detail.most_cells >= kMany || !hold)
            return real(query, std::move(stop));
        held = true;
        hold.wait(true);
        const index::ExtractionPtr set = real(query, {});
        late = set->cells();
        return set;
    };
    Session session(config_with(4), large_, *context_, controlled);
    const auto let_go = [&] {
        hold = false;
        hold.notify_all();
    };
    const std::shared_ptr<void> at_last(nullptr, [&](void*) { let_go(); });
    session.share_frames(std::make_unique<KnownTimes>(stalls)); // 40,000 cells fit
    FrameReport report = first_frame(session, true);
    ASSERT_TRUE(test_support::eventually([&] {
        report = frame(session, true);
        return report.cells > kMany;
    }));
    hold = stalls = true;
    ASSERT_TRUE(test_support::eventually([&] {
        report = frame(session, true);
        return held.load();
    })) << "a smaller set is asked for";
    for (int i = 0; i < 20; ++i)
        report = frame(session, false);
    const std::uint64_t many = report.cells;
    let_go();
    ASSERT_TRUE(test_support::eventually([&] { return late > 0; }));
    EXPECT_LT(late, many);
    for (int i = 0; i < 30; ++i)
        EXPECT_EQ(frame(session, false).cells, many) << i;
    at_rest.open();
    std::uint64_t most = many;
    ASSERT_TRUE(test_support::eventually([&] {
        report = frame(session, false);
        EXPECT_GE(report.cells, most);
        most = report.cells;
        return report.final && report.coarsest == 0;
    }));
    EXPECT_GT(most, many);
}

/// Waves in the colors of a second array, noise, whose percentiles lie the closer together the coarser
/// the cells are that average it.
class SessionRestInColors : public SessionRest {
  protected:
    SessionRestInColors()
        : noise_({97, 97, 97}, 1, index::ValueType::f32, [this](double, double, double, double) {
              return static_cast<double>(random_()) / std::mt19937::max();
          }) {
        index::MemorySeries waves(waves_.view()), noise(noise_.view());
        noise.info().array = "noise";
        build_index(waves, folder_.path() / "colored.isochron", {.color = &noise});
        large_ = index::IndexFile::open(folder_.path() / "colored.isochron");
    }
    static interaction::Commands between_percentiles() {
        interaction::Commands commands;
        commands.isovalue = 0.1;
        commands.coloring = interaction::Coloring{
            .by = interaction::ColorBy::value, .map = "polar", .percentiles = {{10, 90}}};
        return commands;
    }
    static std::vector<std::uint8_t> picture(const Session& session) {
        return session.outputs().display().read_window().rgba;
    }

    std::mt19937 random_;
    index::TestField noise_;
};

TEST_P(SessionRestInColors, AFinerSetInPartsHasTheColorsAndTheLegendOfItsOwnPercentiles) {
    Session session(config_with(1e-6), large_, *context_);
    FrameReport report = frame(session, false, between_percentiles());
    int coarse = 0, in_parts = 0; // pictures
    ASSERT_TRUE(test_support::eventually([&] {
        report = frame(session, false);
        coarse += report.redrawn && report.cells > 0 && report.coarsest > 0;
        in_parts += report.redrawn && report.reason == QualityReason::in_parts;
        return report.final && report.cells > 0 && report.coarsest == 0;
    }));
    EXPECT_GT(coarse, 0);
    EXPECT_GT(in_parts, 0);

    Config at_once = config_with(1e-6);
    at_once.quality.settled = report.footprint;
    Session whole(at_once, large_, *context_);
    for (int i = 0; i < 30; ++i)
        whole.frame(head_at_rest(i / 60.0),
                    i == 0 ? between_percentiles() : interaction::Commands(), Waiting::for_cells);
    EXPECT_EQ(whole.log().frames().back().cells, report.cells);
    EXPECT_TRUE(picture(session) == picture(whole));
}

TEST_P(SessionRestInColors, AReplayThatTurnsToOtherCellsWithinAFrameShowsTheirPercentilesInIt) {
    Config config = config_with(1e-6);
    config.memory.most_cells = 100'000; // so all cells, which are found first, give way
    Session session(config, large_, *context_);
    const FrameReport first =
        session.frame(head_at_rest(0), between_percentiles(), Waiting::for_cells);
    ASSERT_GT(first.coarsest, 0u);
    const auto shown = picture(session);
    const FrameReport second = session.frame(head_at_rest(0.01), {}, Waiting::for_cells);
    ASSERT_EQ(second.footprint, first.footprint);
    ASSERT_EQ(second.cells, first.cells);
    EXPECT_TRUE(picture(session) == shown);
}

INSTANTIATE_TEST_SUITE_P(Contexts, SessionRestInColors,
                         testing::Values(stereo::ContextKind::egl, stereo::ContextKind::osmesa),
                         context_name);
INSTANTIATE_TEST_SUITE_P(Contexts, SessionRest,
                         testing::Values(stereo::ContextKind::egl, stereo::ContextKind::osmesa),
                         context_name);

} // namespace
} // namespace isochron::app
