// An asker answers each question once, in order, and makes nobody wait.
#include "app/frame/asker.h"

#include "tests/support/eventually.h"
#include "tests/support/gate.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <atomic>
#include <cstdint>
#include <memory>
#include <new>
#include <stdexcept>
#include <string>

namespace isochron::app {
namespace {

using test_support::eventually;
using testing::ElementsAre;
using testing::IsEmpty;

/// What a test asks: each question does one of these.
struct Asked {
    std::string name;
    std::shared_ptr<test_support::Gate> gate =
        nullptr; ///< held here until it opens or nobody waits
    std::string fault = {};
    bool memory = true;
};

std::string answer_to(const Asked& question, const Asking& asking) {
    asking.progress(50);
    if (question.gate)
        question.gate->pass(asking.stop);
    if (!question.memory)
        throw std::bad_alloc();
    if (!question.fault.empty())
        throw std::runtime_error(question.fault);
    return question.name;
}

std::string failure_of(const Asked& question, const std::string& why, bool canceled) {
    return question.name + ": " + why + (canceled ? ", by the owner" : "");
}

class AskerTest : public testing::Test {
  protected:
    bool has_begun() const {
        return eventually([this] { return asker_.percent() == 50; });
    }
    std::shared_ptr<test_support::Gate> gate_ = std::make_shared<test_support::Gate>();
    std::atomic<int> wakes_{0};
    Asker<Asked, std::string> asker_{answer_to, failure_of};
};

TEST_F(AskerTest, AnswersEachQuestionOnceInOrder) {
    for (const char* name : {"one", "two", "three"})
        EXPECT_TRUE(asker_.ask({name}));
    asker_.finish();
    EXPECT_THAT(asker_.take(), ElementsAre("one", "two", "three"));
    EXPECT_THAT(asker_.take(), IsEmpty());
}

TEST_F(AskerTest, NeitherAskingNorTakingNorCancelingWaitsForAQuestionThatHangs) {
    asker_.ask({"hangs", gate_});
    ASSERT_TRUE(has_begun());
    asker_.ask({"behind it"});
    EXPECT_THAT(asker_.take(), IsEmpty());
    EXPECT_EQ(asker_.percent(), 0u);
    gate_->open();
    asker_.finish();
    EXPECT_THAT(asker_.take(), ElementsAre("hangs", "behind it"));
}

TEST_F(AskerTest, AFailureIsAnAnswer) {
    asker_.ask({"one", nullptr, "disk full"});
    asker_.ask({"two", nullptr, "", false});
    asker_.ask({"three"});
    asker_.finish();
    EXPECT_THAT(asker_.take(),
                ElementsAre("one: disk full",
                            testing::StartsWith("two: there is not enough memory"), "three"));
}

TEST_F(AskerTest, CancelingEndsTheQuestionsSoFarAndNoLaterOne) {
    asker_.ask({"begun", gate_, "given up"});
    ASSERT_TRUE(has_begun());
    asker_.ask({"waits", gate_});
    asker_.cancel();
    asker_.ask({"later"});
    asker_.finish();
    EXPECT_THAT(asker_.take(), ElementsAre("begun: given up, by the owner",
                                           "waits: canceled, by the owner", "later"));
}

TEST_F(AskerTest, TakesNoMoreQuestionsThanItsOwnerAllows) {
    asker_.ask({"begun", gate_});
    ASSERT_TRUE(has_begun());
    EXPECT_TRUE(asker_.ask({"first"}, 2));
    EXPECT_TRUE(asker_.ask({"second"}, 2));
    EXPECT_FALSE(asker_.ask({"third"}, 2));
    gate_->open();
    asker_.finish();
    EXPECT_FALSE(asker_.ask({"third"}, 3)) << "three answers wait to be taken";
    EXPECT_THAT(asker_.take(), ElementsAre("begun", "first", "second"));
    EXPECT_TRUE(asker_.ask({"third"}, 3));
}

TEST_F(AskerTest, WakesForProgressAndForAnAnswerThatIsThere) {
    std::atomic<std::uint32_t> percent{0};
    asker_.set_wake([&] {
        if (++wakes_ == 1)
            percent = asker_.percent();
    });
    asker_.ask({"one"});
    asker_.finish();
    EXPECT_EQ(percent, 50u);
    EXPECT_EQ(wakes_, 2);
    EXPECT_THAT(asker_.take(), ElementsAre("one"));
}

TEST(Asker, ItsEndCancelsWhatHangsAndWhatWaits) {
    const auto gate = std::make_shared<test_support::Gate>();
    Asker<Asked, std::string> asker(answer_to, failure_of);
    for (int i = 0; i < 3; ++i)
        asker.ask({"hangs", gate});
}

} // namespace
} // namespace isochron::app
