// The advice on what is shown between two steps, taken again once all steps are indexed.
#include "app/explore/later_advice.h"

#include "app/explore/explore_start.h"
#include "tests/support/eventually.h"
#include "tests/support/session_fixture.h"

#include <gtest/gtest.h>

#include <optional>

namespace isochron::app {
namespace {

using interaction::BetweenSteps;
using interaction::Commands;

class LaterAdviceTest : public SessionTest {
  protected:
    LaterAdviceTest() : session_(small_config(), file_, *context_) {
        ExplorerState state = session_.state();
        state.between = other(advised_between(*file_));
        session_.set_state(state);
    }
    static BetweenSteps other(BetweenSteps between) {
        return between == BetweenSteps::blend ? BetweenSteps::hold : BetweenSteps::blend;
    }
    /// What is asked for before one frame.
    std::optional<BetweenSteps> asked(const Commands& by_user = {}) {
        Commands asked;
        advice_.before_frame(session_, by_user, asked);
        return asked.between;
    }

    Session session_;
    bool whole_ = false;
    LaterAdvice advice_{[this](const Session&) { return whole_; }};
};

TEST_P(LaterAdviceTest, IsObeyedOnceAllStepsAreThereAndNeverAgain) {
    for (int i = 0; i < 5; ++i)
        EXPECT_FALSE(asked());
    whole_ = true;
    std::optional<BetweenSteps> obeyed;
    ASSERT_TRUE(test_support::eventually([&] { return (obeyed = asked()).has_value(); }));
    EXPECT_EQ(obeyed, advised_between(*file_));
    for (int i = 0; i < 5; ++i)
        EXPECT_FALSE(asked());
}

TEST_P(LaterAdviceTest, DoesNotOverruleAUserWhoHasChosen) {
    Commands chosen;
    chosen.between = session_.state().between;
    EXPECT_FALSE(asked(chosen));
    whole_ = true;
    for (int i = 0; i < 50; ++i)
        EXPECT_FALSE(asked());
}

INSTANTIATE_TEST_SUITE_P(, LaterAdviceTest, testing::Values(stereo::ContextKind::egl),
                         context_name);

} // namespace
} // namespace isochron::app
