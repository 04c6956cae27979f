// The extraction thread: the newest query wins; prefetch and failures; it never blocks the caller.
#include "index/extraction/extractor.h"
#include "tests/index/extraction/held_extraction.h"
#include "tests/support/eventually.h"
#include "tests/support/gate.h"
#include "tests/support/test_field.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <future>
#include <latch>
#include <random>
#include <thread>
#include <vector>

namespace isochron::index {
namespace {

using test_support::eventually;

TEST(Extractor, WakesWhenASearchHasEndedOneWayOrTheOther) {
    std::counting_semaphore<> woken{0};
    HeldExtraction held;
    Extractor extractor(
        [extract = held.extract()](const SurfacesQuery& query, std::stop_token stop) {
            ExtractionPtr made = extract(query, std::move(stop));
            if (query.instant == Instant(2))
                throw Error("unreadable");
            return made;
        });
    extractor.set_wake([&woken] { woken.release(); });
    for (const std::uint32_t step : {1u, 2u}) {
        extractor.request({{Instant(step), {0.5}}, {}});
        held.let_go();
        woken.acquire(); // the test's limit ends a hang
        EXPECT_FALSE(extractor.busy()) << "there is something to take by then";
    }
    EXPECT_TRUE(extractor.failure());
}

TEST(Extractor, AnswersWhatIsAsked) {
    Extractor extractor(
        [](const SurfacesQuery& query, std::stop_token) { return empty_extraction(query); });
    EXPECT_EQ(extractor.newest(), nullptr);
    EXPECT_FALSE(extractor.busy());
    extractor.wait(); // nothing asked: nothing to wait for
    extractor.request({.query = {Instant(7), {1.5}}, .ahead = {}});
    extractor.wait();
    ASSERT_NE(extractor.newest(), nullptr);
    EXPECT_EQ(extractor.newest()->query, (SurfacesQuery{Instant(7), {1.5}}));
    EXPECT_FALSE(extractor.failure());
}

TEST(Extractor, WhatIsForgottenIsAnsweredAnewAlsoWhileItIsBeingFound) {
    HeldExtraction held(false); // gives what it found although it was stopped
    Extractor extractor(held.extract());
    extractor.request({.query = {Instant(3), {1.0}}, .ahead = {}});
    held.wait_until_started();
    held.let_go();
    extractor.wait();
    const ExtractionPtr first = extractor.newest();
    extractor.forget();
    EXPECT_EQ(extractor.newest(), first) << "it stays until there is another";
    EXPECT_TRUE(extractor.busy());
    held.wait_until_started();
    extractor.forget();
    held.let_go();
    held.wait_until_started();
    EXPECT_EQ(extractor.newest(), first);
    held.let_go();
    extractor.wait();
    EXPECT_NE(extractor.newest(), first);
    EXPECT_EQ(held.calls(3), 3);
}

TEST(Extractor, FinishesWhatIsNearlyDoneWhereTheLastSearchIsAMeasure) {
    using std::chrono::milliseconds;
    EXPECT_FALSE(is_worth_finishing(milliseconds(9), milliseconds(40)));
    EXPECT_TRUE(is_worth_finishing(milliseconds(10), milliseconds(40)));
    EXPECT_TRUE(is_worth_finishing(milliseconds(80), milliseconds(40)));
    EXPECT_FALSE(is_worth_finishing(milliseconds(81), milliseconds(40)));
    EXPECT_FALSE(is_worth_finishing(milliseconds(3), milliseconds(4)));
}

TEST(Extractor, TheLatestRequestWins) {
    HeldExtraction held;
    Extractor extractor(held.extract());
    extractor.request({.query = {Instant(0), {1.0}}, .ahead = {}});
    held.wait_until_started();
    for (std::uint32_t step = 1; step <= 5; ++step)
        extractor.request({.query = {Instant(step), {1.0}}, .ahead = {}});
    held.let_go(2);
    extractor.wait();
    EXPECT_EQ(extractor.newest()->query.instant, Instant(5));
    for (std::uint32_t step = 1; step <= 4; ++step)
        EXPECT_EQ(held.calls(step), 0) << "a request that was replaced in time is never searched";
}

TEST(Extractor, AfterAnAbandonedSearchTheNextIsFinishedAndShown) {
    HeldExtraction held;
    Extractor extractor(held.extract());
    extractor.request({.query = {Instant(0), {1.0}}, .ahead = {}});
    held.wait_until_started();
    extractor.request({.query = {Instant(1), {1.0}}, .ahead = {}}); // abandons step 0
    held.let_go();
    held.wait_until_started(); // step 1
    EXPECT_EQ(extractor.newest(), nullptr);
    extractor.request({.query = {Instant(2), {1.0}}, .ahead = {}}); // does not abandon step 1
    held.let_go();
    held.wait_until_started(); // step 2; step 1 is shown meanwhile
    ASSERT_NE(extractor.newest(), nullptr);
    EXPECT_EQ(extractor.newest()->query.instant, Instant(1));
    EXPECT_TRUE(extractor.busy());
    held.let_go();
    extractor.wait();
    EXPECT_EQ(extractor.newest()->query.instant, Instant(2));
}

TEST(Extractor, APrefetchedStepIsAnsweredWithoutAnotherSearch) {
    HeldExtraction held;
    Extractor extractor(held.extract());
    extractor.request({.query = {Instant(3), {1.0}}, .ahead = StepsAhead{4}});
    held.let_go(2);
    held.wait_until_started();
    held.wait_until_started(); // the prefetch
    extractor.request({.query = {Instant(4), {1.0}}, .ahead = {}});
    extractor.wait();
    EXPECT_EQ(extractor.newest()->query.instant, Instant(4));
    EXPECT_EQ(held.calls(4), 1);
    extractor.request({.query = {Instant(3), {1.0}}, .ahead = {}});
    extractor.wait();
    EXPECT_EQ(extractor.newest()->query.instant, Instant(3));
    EXPECT_EQ(held.calls(3), 1) << "stepping back is answered from the recent sets too";
}

TEST(Extractor, ARunningPrefetchOfTheRequestedStepGoesOn) {
    HeldExtraction held;
    Extractor extractor(held.extract());
    extractor.request({.query = {Instant(3), {1.0}}, .ahead = StepsAhead{4}});
    held.let_go();
    held.wait_until_started();
    held.wait_until_started(); // the prefetch is now held
    extractor.request({.query = {Instant(4), {1.0}}, .ahead = {}});
    EXPECT_TRUE(extractor.busy());
    held.let_go();
    extractor.wait();
    EXPECT_EQ(extractor.newest()->query.instant, Instant(4));
    EXPECT_EQ(held.calls(4), 1);
}

TEST(Extractor, APrefetchGivesWayToARequest) {
    HeldExtraction held;
    Extractor extractor(held.extract());
    extractor.request({.query = {Instant(3), {1.0}}, .ahead = StepsAhead{4}});
    held.let_go();
    held.wait_until_started();
    held.wait_until_started(); // the prefetch is now held
    extractor.request({.query = {Instant(9), {2.0}}, .ahead = {}});
    held.let_go(2);
    extractor.wait();
    EXPECT_EQ(extractor.newest()->query, (SurfacesQuery{Instant(9), {2.0}}));
}

bool comes_to_hand(const Extractor& extractor, std::uint32_t step) {
    return eventually([&] {
        const auto at_hand = extractor.at_hand();
        return std::ranges::find(at_hand, step) != at_hand.end();
    });
}

TEST(Extractor, WhatIsAtHandIsNotReplacedByAnOlderSearch) {
    HeldExtraction held(false);
    Extractor extractor(held.extract());
    held.let_go(2);
    for (const std::uint32_t step : {1u, 2u}) {
        extractor.request({.query = {Instant(step), {1.0}}, .ahead = {}});
        extractor.wait();
        held.wait_until_started();
    }
    extractor.request({.query = {Instant(3), {1.0}}, .ahead = {}});
    held.wait_until_started();
    extractor.request({.query = {Instant(1), {1.0}}, .ahead = {}});
    EXPECT_EQ(extractor.newest()->query.instant, Instant(1));
    held.let_go();
    ASSERT_TRUE(comes_to_hand(extractor, 3));
    EXPECT_EQ(extractor.newest()->query.instant, Instant(1));
    extractor.request({.query = {Instant(4), {1.0}}, .ahead = {}});
    held.wait_until_started();
    held.let_go();
    extractor.wait();
    EXPECT_EQ(extractor.newest()->query.instant, Instant(4));
}

TEST(Extractor, NothingIsPrefetchedWhileIsovaluesAreDragged) {
    HeldExtraction held;
    Extractor extractor(held.extract());
    held.let_go(1000);
    for (std::uint32_t step = 0; step < 50; ++step) {
        extractor.request({.query = {Instant(step), {1.0 + step}}, .ahead = StepsAhead{100 + step}});
        extractor.wait();
        if (step == 0) {
            ASSERT_TRUE(held.is_searched(100)) << "nothing says that it is dragged";
        }
    }
    ASSERT_TRUE(eventually([&] { return held.worker_rests(); }));
    for (std::uint32_t step = 1; step < 50; ++step)
        EXPECT_EQ(held.calls(100 + step), 0);
    // Held still, at the same step or at the next.
    const auto expect_prefetch_of = [&](std::uint32_t step) {
        EXPECT_TRUE(held.is_searched(step));
        EXPECT_EQ(held.calls(step), 1);
    };
    extractor.request({.query = {Instant(49), {50.0}}, .ahead = StepsAhead{149}});
    expect_prefetch_of(149);
    extractor.request({.query = {Instant(50), {51.0}}, .ahead = StepsAhead{150}});
    extractor.wait();
    extractor.request({.query = {Instant(51), {51.0}}, .ahead = StepsAhead{151}});
    expect_prefetch_of(151);
    EXPECT_EQ(held.calls(150), 0);
}

TEST(Extractor, AskingAgainForWhatIsAskedDoesNothing) {
    HeldExtraction held;
    Extractor extractor(held.extract());
    const double nan = std::numeric_limits<double>::quiet_NaN();
    for (const double isovalue : {1.0, nan}) {
        extractor.request({.query = {Instant(1), {isovalue}}, .ahead = {}});
        held.wait_until_started();
        for (int i = 0; i < 10; ++i)
            extractor.request({.query = {Instant(1), {isovalue}}, .ahead = {}});
        held.let_go();
        extractor.wait();
        const ExtractionPtr shown = extractor.newest();
        extractor.request({.query = {Instant(1), {isovalue}}, .ahead = {}});
        EXPECT_FALSE(extractor.busy());
        EXPECT_EQ(extractor.newest(), shown);
    }
    EXPECT_EQ(held.calls(1), 2);
}

TEST(Extractor, AFailureIsReportedUntilALaterQuerySucceeds) {
    Extractor extractor([](const SurfacesQuery& query, std::stop_token) -> ExtractionPtr {
        if (query.instant == Instant(1))
            throw std::runtime_error("step 1 cannot be read");
        if (query.instant == Instant(2))
            throw 42;
        if (query.instant == Instant(3))
            return nullptr;
        return empty_extraction(query);
    });
    extractor.request({.query = {Instant(0), {1.0}}, .ahead = {}});
    extractor.wait();
    for (const std::uint32_t step : {1u, 2u, 3u}) {
        extractor.request({.query = {Instant(step), {1.0}}, .ahead = {}});
        extractor.wait();
        EXPECT_TRUE(extractor.failure());
        EXPECT_EQ(extractor.newest()->query.instant, Instant(0)) << "the last picture stays";
        if (step == 1) {
            EXPECT_EQ(*extractor.failure(), "step 1 cannot be read");
        }
    }
    extractor.request({.query = {Instant(4), {1.0}}, .ahead = {}});
    extractor.wait();
    EXPECT_FALSE(extractor.failure());
    EXPECT_EQ(extractor.newest()->query.instant, Instant(4));
}

TEST(Extractor, AFailedPrefetchIsSilentUntilItsStepIsAsked) {
    std::promise<void> prefetched;
    std::atomic<int> tries = 0;
    Extractor extractor([&](const SurfacesQuery& query, std::stop_token) -> ExtractionPtr {
        if (query.instant == Instant(0))
            return empty_extraction(query);
        if (++tries == 1) {
            prefetched.set_value();
            throw std::runtime_error("bad step");
        }
        throw std::runtime_error("bad step, asked");
    });
    extractor.request({.query = {Instant(0), {1.0}}, .ahead = StepsAhead{1}});
    extractor.wait();
    prefetched.get_future().wait();
    EXPECT_FALSE(extractor.failure());
    extractor.request({.query = {Instant(1), {1.0}}, .ahead = {}});
    extractor.wait();
    ASSERT_TRUE(extractor.failure());
    EXPECT_EQ(extractor.failure()->substr(0, 8), "bad step");
}

TEST(Extractor, NoCallWaitsForASearchThatIgnoresItsStop) {
    // The caller's work is done on this thread while the search is held: if any call waited for the
    // search, the test would not come to an end.
    HeldExtraction held(false);
    Extractor extractor(held.extract());
    extractor.request({.query = {Instant(0), {1.0}}, .ahead = StepsAhead{1}});
    held.wait_until_started();
    for (std::uint32_t i = 0; i < 1000; ++i) {
        extractor.request({.query = {Instant(i % 7), {double(i)}}, .ahead = StepsAhead{i % 5}});
        EXPECT_EQ(extractor.newest(), nullptr);
        EXPECT_TRUE(extractor.busy());
        EXPECT_FALSE(extractor.failure());
    }
    held.let_go(10);
    extractor.wait();
    EXPECT_EQ(extractor.newest()->query, (SurfacesQuery{Instant(999 % 7), {999.0}}));
}

TEST(Extractor, DestructionStopsTheSearchAndJoins) {
    std::atomic<bool> ended = false;
    {
        std::latch started(1);
        Extractor extractor(
            [&](const SurfacesQuery&, const std::stop_token& stop) -> ExtractionPtr {
                started.count_down();
                test_support::Gate().pass(stop);
                ended = true;
                return nullptr;
            });
        extractor.request({.query = {Instant(0), {1.0}}, .ahead = {}});
        started.wait();
    }
    EXPECT_TRUE(ended);
}

TEST(Extractor, RandomRequestsFromOneThreadAndReadersOnOthersEndWithTheLastAnswer) {
    const std::uint32_t seed = test_seed();
    std::mt19937 random(seed);
    Extractor extractor(
        [](const SurfacesQuery& query, const std::stop_token& stop) -> ExtractionPtr {
            auto extraction = std::make_shared<Extraction>();
            extraction->query = query;
            auto& ids = extraction->surfaces.emplace_back().ids;
            for (CellId id = 0; id < 2000; ++id) {
                if (id % 100 == 0 && stop.stop_requested())
                    return nullptr;
                ids.push_back(id * query.instant.step);
            }
            if (query.instant == Instant(13))
                throw std::runtime_error("13");
            return extraction;
        });
    std::atomic<bool> done = false;
    const auto look = [&] {
        while (!done) {
            if (const ExtractionPtr newest = extractor.newest()) {
                const auto& ids = newest->surfaces.front().ids;
                ASSERT_EQ(ids.size(), 2000u);
                ASSERT_EQ(ids.back(), 1999u * newest->query.instant.step);
            }
            (void)extractor.busy();
            (void)extractor.failure();
        }
    };
    std::thread reader_a(look), reader_b(look);
    for (int i = 0; i < 3000; ++i) {
        const auto step = static_cast<std::uint32_t>(random() % 20);
        Request request{.query = {Instant(step), {double(random() % 3)}}, .ahead = {}};
        if (random() % 2)
            request.ahead = StepsAhead{step + 1};
        extractor.request(request);
        if (random() % 8 == 0)
            extractor.wait();
    }
    extractor.request({.query = {Instant(5), {99.0}}, .ahead = StepsAhead{6}});
    extractor.wait();
    EXPECT_EQ(extractor.newest()->query, (SurfacesQuery{Instant(5), {99.0}}));
    EXPECT_FALSE(extractor.failure());
    done = true;
    reader_a.join();
    reader_b.join();
}

} // namespace
} // namespace isochron::index
