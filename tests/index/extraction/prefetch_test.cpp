// Prefetching: steps are made before a playback asks for them, as far as there is room.
#include "index/extraction/extractor.h"
#include "tests/support/eventually.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <condition_variable>
#include <memory>
#include <mutex>
#include <stdexcept>
#include <vector>

namespace isochron::index {
namespace {

using test_support::eventually;

/// Extractions of some bytes, at once; which steps were made, in order.
class SizedExtraction {
  public:
    explicit SizedExtraction(std::size_t bytes) : bytes_(bytes) {}
    Extract extract() {
        return [this](const SurfacesQuery& query, const std::stop_token&) -> ExtractionPtr {
            auto extraction = std::make_shared<Extraction>();
            extraction->query = query;
            extraction->colors.resize(bytes_ / sizeof(std::uint16_t));
            {
                const std::scoped_lock lock(mutex_);
                steps_.push_back(query.instant.step);
            }
            came_.notify_all();
            return extraction;
        };
    }
    std::vector<std::uint32_t> steps() {
        const std::scoped_lock lock(mutex_);
        return steps_;
    }
    /// Waits until so many steps were made and are at hand.
    void await(const Extractor& extractor, std::size_t made) {
        std::unique_lock lock(mutex_);
        ASSERT_TRUE(test_support::is_told(came_, lock, [&] { return steps_.size() >= made; }));
        const std::uint32_t last = steps_.back();
        lock.unlock();
        ASSERT_TRUE(eventually([&] {
            const auto at_hand = extractor.at_hand();
            return std::ranges::find(at_hand, last) != at_hand.end();
        }));
    }

  private:
    std::size_t bytes_;
    std::mutex mutex_;
    std::condition_variable came_;
    std::vector<std::uint32_t> steps_;
};

TEST(Prefetch, AsManyStepsArePrefetchedAsThereIsRoomForAlongThePlayback) {
    constexpr std::size_t kBytes = 1 << 20;
    SizedExtraction made(kBytes);
    Extractor extractor(made.extract(), 5 * kBytes + kBytes / 2);
    extractor.request({.query = {Instant(8), {1.0}}, .ahead = StepsAhead{9, 10}});
    made.await(extractor, 6);
    EXPECT_EQ(extractor.at_hand(), (std::vector<std::uint32_t>{0, 1, 2, 3, 9}));
    EXPECT_EQ(made.steps(), (std::vector<std::uint32_t>{8, 9, 0, 1, 2, 3}));
    extractor.request({.query = {Instant(9), {1.0}}, .ahead = StepsAhead{0, 10}});
    EXPECT_EQ(extractor.newest()->query.instant, Instant(9)) << "at once";
    EXPECT_FALSE(extractor.busy());
    made.await(extractor, 7);
    EXPECT_EQ(made.steps().back(), 4u);
    EXPECT_EQ(extractor.at_hand(), (std::vector<std::uint32_t>{0, 1, 2, 3, 4}));
    // Backwards, what is nearest comes first.
    extractor.request({.query = {Instant(7), {1.0}}, .ahead = StepsAhead{6, 10, true}});
    made.await(extractor, 10);
    EXPECT_EQ(made.steps(), (std::vector<std::uint32_t>{8, 9, 0, 1, 2, 3, 4, 7, 6, 5}));
    EXPECT_EQ(extractor.at_hand(), (std::vector<std::uint32_t>{2, 3, 4, 5, 6}));
}

TEST(Prefetch, ComesInTheOrderInWhichStepsAreShown) {
    const auto order = [](const StepsAhead& ahead) {
        std::vector<std::uint32_t> steps;
        for (std::uint32_t i = 0; i < ahead.count(); ++i)
            steps.push_back(ahead.at(i));
        return steps;
    };
    using Steps = std::vector<std::uint32_t>;
    EXPECT_EQ(order({.next = 1, .steps = 4, .first = 10, .every = 5}), (Steps{15, 20, 25}));
    EXPECT_EQ(order({.next = 1, .steps = 4, .reverse = true, .first = 10, .every = 5}),
              (Steps{15, 10, 25}));
    EXPECT_EQ(order({.next = 3, .steps = 5, .to_and_fro = true}), (Steps{3, 4, 1, 0})) << "from 2";
    EXPECT_EQ(order({.next = 3, .steps = 5, .reverse = true, .to_and_fro = true}),
              (Steps{3, 2, 1, 0}))
        << "from the end";
    EXPECT_EQ(order({.next = 1, .steps = 5, .to_and_fro = true}), (Steps{1, 2, 3, 4}));
    EXPECT_EQ(order({.next = 1, .steps = 2, .to_and_fro = true}), Steps{1});
}

TEST(Prefetch, WhatHasAMeshAnswersWhoNeedsNoneAndNotTheOtherWayRound) {
    SizedExtraction made(1000);
    Extractor extractor(made.extract());
    const auto ask = [&](std::uint32_t step, std::uint64_t room) {
        extractor.request(
            {.query = {.instant = Instant(step), .isovalues = {1.0}, .mesh_room = room},
             .ahead = {}});
        extractor.wait();
        return extractor.newest()->query.mesh_room;
    };
    EXPECT_EQ(ask(3, 0), 0u);
    EXPECT_EQ(ask(3, 100), 100u);
    EXPECT_EQ(ask(3, 0), 100u) << "what is there is kept";
    EXPECT_EQ(ask(4, 0), 0u);
    EXPECT_EQ(ask(3, 0), 100u);
    EXPECT_EQ(ask(3, 100), 100u);
    EXPECT_EQ(ask(4, 100), 100u);
    EXPECT_EQ(made.steps(), (std::vector<std::uint32_t>{3, 3, 4, 4}));
}

TEST(Prefetch, WithoutRoomIsOfTheNextStepAlone) {
    SizedExtraction made(1000);
    Extractor extractor(made.extract());
    extractor.request({.query = {Instant(8), {1.0}}, .ahead = StepsAhead{9, 10}});
    made.await(extractor, 2);
    for (std::uint32_t step = 9; step < 30; ++step) {
        extractor.request({.query = {Instant(step % 10), {1.0}}, .ahead = StepsAhead{(step + 1) % 10, 10}});
        EXPECT_EQ(extractor.newest()->query.instant, Instant(step % 10));
        made.await(extractor, step - 6);
        EXPECT_EQ(made.steps().back(), (step + 1) % 10);
        EXPECT_LE(extractor.at_hand().size(), 3u);
    }
}

TEST(Prefetch, OfAStepThatFailsEndsThere) {
    std::mutex mutex;
    std::vector<std::uint32_t> asked;
    Extractor extractor(
        [&](const SurfacesQuery& query, const std::stop_token&) -> ExtractionPtr {
            const std::scoped_lock lock(mutex);
            asked.push_back(query.instant.step);
            if (query.instant == Instant(3))
                throw std::runtime_error("bad step");
            auto extraction = std::make_shared<Extraction>();
            extraction->query = query;
            return extraction;
        },
        1 << 20);
    extractor.request({.query = {Instant(1), {1.0}}, .ahead = StepsAhead{2, 6}});
    ASSERT_TRUE(eventually([&] {
        const std::scoped_lock lock(mutex);
        return !asked.empty() && asked.back() == 3;
    }));
    extractor.request({.query = {Instant(2), {1.0}}, .ahead = {}});
    EXPECT_EQ(extractor.newest()->query.instant, Instant(2));
    EXPECT_FALSE(extractor.failure());
    const std::scoped_lock lock(mutex);
    EXPECT_EQ(asked, (std::vector<std::uint32_t>{1, 2, 3}));
}

} // namespace
} // namespace isochron::index
