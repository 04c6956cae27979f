// Processes that wait for each other, simulated by threads.
#include "stereo/cluster.h"

#include "index/error.h"
#include "tests/support/test_seed.h"
#include "tests/support/thread_team.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <functional>
#include <latch>
#include <random>
#include <thread>

namespace isochron::stereo {
namespace {

using test_support::ThreadPost;
using test_support::ThreadTeam;
using testing::HasSubstr;
using testing::StartsWith;
using Bytes = std::vector<std::byte>;

/// What each member says in each round, known to all.
Bytes said(unsigned rank, unsigned round) {
    static const std::uint32_t seed = test_seed();
    std::mt19937 random(seed + 1000 * rank + round);
    Bytes bytes(random() % 3 == 0 ? 0 : random() % 3000);
    for (std::byte& byte : bytes)
        byte = static_cast<std::byte>(random());
    return bytes;
}

using Now = std::function<Cluster::Clock::time_point()>;

/// A clock on which 10 ms pass whenever a test says so.
class TestClock {
  public:
    void tick() { ++ticks_; }
    Cluster::Clock::time_point now() const {
        return Cluster::Clock::time_point(std::chrono::milliseconds(10 * ticks_));
    }

  private:
    std::atomic<int> ticks_ = 0;
};

/// A member for each part, each in a thread of its own.
/// @param now the clock of rank 0, or of all: else no time passes, and nobody is ever missed
void play(const std::vector<std::function<void(Cluster&)>>& parts, ClusterLimits limits = {},
          ThreadPost* post = nullptr, const Now& now = {}, bool of_all = false) {
    const Now still = [] { return Cluster::Clock::time_point(); };
    ThreadPost own(static_cast<unsigned>(parts.size()));
    std::vector<std::jthread> threads;
    for (unsigned rank = 0; rank < parts.size(); ++rank)
        threads.emplace_back([&, rank] {
            ThreadTeam team(post ? *post : own, rank);
            Cluster cluster(team, limits, now && (of_all || rank == 0) ? now : still);
            parts[rank](cluster);
        });
}

std::string loss(Cluster& cluster) {
    try {
        cluster.gather({});
    } catch (const ProcessLost& lost) {
        return lost.what();
    }
    return "";
}

TEST(Cluster, EverybodyGetsWhatEverybodySaysAndWhatRankZeroTells) {
    static constexpr unsigned kMembers = 5, kRounds = 40;
    const auto part = [](Cluster& cluster) {
        for (unsigned round = 0; round < kRounds; ++round) {
            if (cluster.rank() == 0)
                cluster.tell(said(99, round));
            else
                EXPECT_EQ(cluster.hear(), said(99, round));
            const auto all = cluster.gather(said(cluster.rank(), round));
            ASSERT_EQ(all.size(), kMembers);
            for (unsigned rank = 0; rank < kMembers; ++rank)
                EXPECT_EQ(all[rank], said(rank, round));
        }
    };
    play(std::vector<std::function<void(Cluster&)>>(kMembers, part));
    play({[](Cluster& alone) { EXPECT_EQ(alone.gather(said(0, 0)).front(), said(0, 0)); }});
}

TEST(Cluster, AMemberThatFallsSilentIsNamedFirstByRankZero) {
    const ClusterLimits limits{ClusterLimits::Duration(0.2), ClusterLimits::Duration(60)};
    TestClock clock; // goes on while rank 0 waits, then while rank 2 does
    std::latch named(1);
    std::string first, second;
    play(
        {[&](Cluster& cluster) {
             cluster.while_waiting([&] { clock.tick(); });
             first = loss(cluster);
             named.count_down();
         },
         [](Cluster&) {},
         [&](Cluster& cluster) {
             cluster.while_waiting([&] {
                 if (named.try_wait())
                     clock.tick();
             });
             second = loss(cluster);
             EXPECT_TRUE(named.try_wait());
         }},
        limits, nullptr, [&] { return clock.now(); }, true);
    EXPECT_THAT(first, StartsWith("process 1 on "));
    EXPECT_THAT(first, HasSubstr(": no sign of life for "));
    EXPECT_THAT(second, StartsWith("process 0 on ")) << "who has left by then";
}

TEST(Cluster, WorkThatTakesLongIsNoSilence) {
    const ClusterLimits limits{ClusterLimits::Duration(1.0), ClusterLimits::Duration(600)};
    ThreadPost post(2);
    // A beat of the one who works is an eighth of the silence, however long it takes here.
    const Now by_beats = [&] {
        return Cluster::Clock::time_point(std::chrono::milliseconds(125 * post.posted[1]));
    };
    play({[](Cluster& cluster) { EXPECT_EQ(loss(cluster), ""); },
          [&](Cluster& cluster) {
              // Two silences long, by its own signs of life.
              for (int beats = post.posted[1]; beats < 20; beats = post.posted[1])
                  post.posted[1].wait(beats);
              EXPECT_EQ(loss(cluster), "");
          }},
         limits, &post, by_beats);
}

TEST(Cluster, AMemberThatLivesButDoesNotGetOnIsNamed) {
    const ClusterLimits limits{ClusterLimits::Duration(60), ClusterLimits::Duration(0.2)};
    TestClock clock;
    std::latch noticed(1);
    std::string said_of_it;
    play({[&](Cluster& cluster) {
              cluster.while_waiting([&] { clock.tick(); });
              said_of_it = loss(cluster);
              noticed.count_down();
          },
          [&](Cluster&) { noticed.wait(); }},
         limits, nullptr, [&] { return clock.now(); });
    EXPECT_THAT(said_of_it, StartsWith("process 1 on "));
    EXPECT_THAT(said_of_it, HasSubstr("alive, but at one thing for "));
}

TEST(Cluster, APartThatFailsInOneMemberFailsInAll) {
    const auto part = [](Cluster& cluster) {
        EXPECT_THROW(cluster.together([&] {
            if (cluster.rank() == 2)
                throw std::runtime_error("no file");
        }),
                     std::runtime_error);
        EXPECT_EQ(loss(cluster), "") << "and they go on together";
    };
    play({part, part, part});
}

TEST(Cluster, AMessageThatIsCutShortIsAnError) {
    ThreadPost post(2);
    ThreadTeam zero(post, 0), one(post, 1);
    for (const std::size_t length : {0u, 7u, 9u, 16u}) {
        Bytes words{std::byte{1}};
        words.resize(1 + length, std::byte{9});
        zero.post(1, words);
        EXPECT_THROW(Cluster(one, {}), index::Error) << length;
    }
}

} // namespace
} // namespace isochron::stereo
