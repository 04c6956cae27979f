// Background work is done completely and in order, without blocking the caller.
#include "app/frame/background_work.h"

#include "index/error.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <future>
#include <stdexcept>

namespace isochron::app {
namespace {

using testing::ElementsAre;

TEST(BackgroundWork, TasksAreDoneInOrder) {
    BackgroundWork work;
    for (int i = 0; i < 3; ++i)
        work.post([i] { return std::to_string(i); });
    work.finish();
    EXPECT_THAT(work.messages(), ElementsAre("0", "1", "2"));
    EXPECT_TRUE(work.messages().empty());
}

TEST(BackgroundWork, PostingDoesNotWaitForATaskThatHangs) {
    std::promise<void> release;
    BackgroundWork work;
    work.post([held = release.get_future().share()] {
        held.wait();
        return std::string("released");
    });
    for (int i = 0; i < 100; ++i)
        work.post([] { return std::string(); });
    EXPECT_TRUE(work.messages().empty());
    release.set_value();
    work.finish();
    EXPECT_THAT(work.messages(), ElementsAre("released"));
}

TEST(BackgroundWork, AFailureIsToldAndDoesNotStopTheRest) {
    BackgroundWork work;
    work.post([]() -> std::string { throw std::runtime_error("disk full"); });
    work.post([] { return std::string("saved"); });
    EXPECT_THROW(work.finish(), index::Error);
    EXPECT_THAT(work.messages(), ElementsAre("disk full", "saved"));
}

TEST(BackgroundWork, WakesForAMessageAndNotForEveryTask) {
    int wakes = 0; // by the worker alone, until it has finished
    BackgroundWork work;
    work.set_wake([&wakes] { ++wakes; });
    for (int i = 0; i < 5; ++i)
        work.post([] { return std::string(); });
    work.post([] { return std::string("saved"); });
    work.post([]() -> std::string { throw std::runtime_error("disk full"); });
    EXPECT_THROW(work.finish(), index::Error);
    EXPECT_EQ(wakes, 2);
}

TEST(BackgroundWork, LeavingDoesWhatWasPosted) {
    int done = 0;
    {
        BackgroundWork work;
        for (int i = 0; i < 50; ++i)
            work.post([&done] {
                ++done;
                return std::string();
            });
    }
    EXPECT_EQ(done, 50);
}

} // namespace
} // namespace isochron::app
