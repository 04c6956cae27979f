// The exact picture at rest in parts in a cluster: shown by all in one frame, given up by all.
#include "tests/support/eventually.h"
#include "tests/support/session_fixture.h"

#include <algorithm>
#include <array>
#include <functional>
#include <memory>
#include <vector>

namespace isochron::app {
namespace {

using render::Footprint;

/// What two processes have told each other.
struct Told {
    FramePlan plan;
    std::array<FrameAnswer, 2> answers;
};

/// One of two processes that take turns on one thread.
class InTurn final : public FramesAlone {
  public:
    InTurn(Told& told, std::size_t rank) : told_(told), rank_(rank) {}
    bool leads() const override { return rank_ == 0; }
    bool alone() const override { return false; }
    bool parts_are_whole() const override {
        return std::ranges::all_of(told_.answers, &FrameAnswer::parts_whole);
    }
    Milliseconds parts_took(Milliseconds) const override {
        return std::ranges::max(told_.answers, {}, &FrameAnswer::parts_took).parts_took;
    }
    FramePlan agree(const FramePlan& mine) override {
        return rank_ == 0 ? told_.plan = mine : told_.plan;
    }
    void swap_barrier(const std::function<FrameAnswer()>& mine) override {
        told_.answers[rank_] = mine();
    }

  private:
    Told& told_;
    std::size_t rank_;
};

class PartsInCluster : public SessionTest {
  protected:
    /// No footprint but quads fits, and each frame has time for one piece.
    static Config partial() {
        Config config = small_config();
        config.rendering.frame_rate_limit = 60;
        config.quality.frame_budget_ms = config.quality.still_budget_ms = 1e-6;
        config.rendering.samples = 1;
        return config;
    }
    PartsInCluster() {
        first_.share_frames(std::make_unique<InTurn>(told_, 0));
        second_.share_frames(std::make_unique<InTurn>(told_, 1));
        interaction::Commands commands;
        commands.isovalue = 2.0;
        frame(commands, Waiting::for_cells);
    }
    /// A frame of both. @return that of rank 0
    FrameReport frame(const interaction::Commands& commands = {},
                      Waiting waiting = Waiting::never) {
        interaction::InputState input = head_at_rest(frame_++ / 60.0);
        input.devices[0].pose->position.x = head_;
        const FrameReport report = first_.frame(input, commands, waiting);
        second_.frame(input, commands, waiting);
        EXPECT_EQ(last(second_).footprint, report.footprint) << "in frame " << frame_;
        EXPECT_EQ(last(second_).in_parts, report.in_parts);
        return report;
    }
    static const FrameReport& last(const Session& session) { return session.log().frames().back(); }
    static std::vector<std::uint8_t> picture(const Session& session) {
        return session.outputs().display().read_eye(stereo::Eye::right).rgba;
    }
    bool rests_until(const std::function<bool(const FrameReport&)>& wanted) {
        return test_support::eventually([&] {
            for (int i = 0; i < 50; ++i)
                if (wanted(frame()))
                    return true;
            return false;
        });
    }
    static bool begun(const FrameReport& report) {
        return report.in_parts && report.footprint != *report.in_parts;
    }

    Told told_;
    Session first_{partial(), file_, *context_}, second_{partial(), file_, *context_};
    int frame_ = 0;
    float head_ = 0;
};

INSTANTIATE_TEST_SUITE_P(, PartsInCluster,
                         testing::Values(stereo::ContextKind::egl, stereo::ContextKind::osmesa),
                         context_name);

TEST_P(PartsInCluster, AreShownByAllInTheFrameAfterTheLastOneHasThem) {
    ASSERT_TRUE(rests_until(begun));
    const auto before = picture(second_);
    while (!told_.answers[0].parts_whole || !told_.answers[1].parts_whole) {
        const FrameReport report = frame();
        ASSERT_LT(frame_, 5000);
        ASSERT_NE(report.footprint, Footprint::surface) << "not all have it";
        ASSERT_EQ(picture(second_), before);
    }
    const FrameReport report = frame();
    EXPECT_EQ(report.footprint, Footprint::surface);
    EXPECT_TRUE(report.redrawn && last(second_).redrawn);
    EXPECT_NE(picture(second_), before);
    EXPECT_TRUE(frame().final && last(second_).final);

    Config at_once = partial();
    at_once.quality.settled = Footprint::surface;
    Session whole(at_once, file_, *context_);
    interaction::Commands commands;
    commands.isovalue = 2.0;
    for (int i = 0; i < 30; ++i)
        whole.frame(head_at_rest(i / 60.0), i == 0 ? commands : interaction::Commands{},
                    Waiting::for_cells);
    EXPECT_EQ(picture(first_), picture(whole));
    EXPECT_EQ(picture(second_), picture(whole));
}

TEST_P(PartsInCluster, TellAllWhatTheyTookWhereTheyTookLongest) {
    ASSERT_TRUE(rests_until(begun));
    while (!told_.answers[0].parts_whole || !told_.answers[1].parts_whole) {
        frame();
        ASSERT_LT(frame_, 5000);
    }
    for (const FrameAnswer& answer : told_.answers)
        EXPECT_GT(answer.parts_took.count(), 0);
    told_.answers[1].parts_took = Milliseconds(12345);
    ASSERT_EQ(frame().footprint, Footprint::surface);
    const FrameReport report = frame();
    ASSERT_TRUE(report.expected && last(second_).expected);
    EXPECT_NEAR(report.expected->count(), 12345, 1);
    EXPECT_NEAR(last(second_).expected->count(), 12345, 1);
}

TEST_P(PartsInCluster, WaitForTheSlowestAndAreGivenUpByAllForInput) {
    ASSERT_TRUE(rests_until(begun));
    for (int i = 0; i < 400; ++i) {
        told_.answers[1].parts_whole = false; // as if it never got there
        ASSERT_NE(frame().footprint, Footprint::surface);
    }
    EXPECT_TRUE(told_.answers[0].parts_whole) << "rank 0 has it, and waits";
    head_ = 0.2f;
    const FrameReport moved = frame();
    EXPECT_TRUE(moved.redrawn && last(second_).redrawn);
    EXPECT_FALSE(moved.in_parts);
    EXPECT_FALSE(told_.answers[0].parts_whole || told_.answers[1].parts_whole);
    EXPECT_TRUE(rests_until(&FrameReport::final)) << "they begin anew";
    EXPECT_EQ(last(second_).footprint, Footprint::surface);
}

} // namespace
} // namespace isochron::app
