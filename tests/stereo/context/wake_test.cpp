// Who waits is woken: from threads, from signal handlers, and by a call that came before.
#include "stereo/context/wake.h"

#include <gtest/gtest.h>

#include <cerrno>
#include <csignal>
#include <thread>

#include <sys/eventfd.h>
#include <unistd.h>

namespace isochron::stereo {
namespace {

constexpr std::chrono::duration<double> kForever{1e9}; // the test's limit ends a hang

TEST(Wake, EndsAWaitFromAnotherThread) {
    const Wake wake;
    const std::jthread other([&wake] { wake(); });
    wake.wait(-1, kForever);
    EXPECT_TRUE(wake.take());
    EXPECT_FALSE(wake.take()) << "it is taken once";
}

TEST(Wake, ACallBeforeTheWaitIsNotLost) {
    const Wake wake;
    wake();
    wake();
    wake.wait(-1, kForever);
    EXPECT_TRUE(wake.take());
    EXPECT_FALSE(wake.take());
}

TEST(Wake, AnotherDescriptorEndsTheWaitToo) {
    const Wake wake;
    const int other = eventfd(1, 0);
    wake.wait(other, kForever);
    EXPECT_FALSE(wake.take());
    close(other);
}

TEST(Wake, EndsWhenTheTimeIsOver) {
    const Wake wake;
    for (const double seconds : {-1.0, 0.0, 1e-3})
        wake.wait(-1, std::chrono::duration<double>(seconds));
    EXPECT_FALSE(wake.take());
}

const Wake* of_the_handler = nullptr;

TEST(Wake, MayBeCalledInASignalHandler) {
    const Wake wake;
    of_the_handler = &wake;
    const auto before = std::signal(SIGUSR1, [](int) { (*of_the_handler)(); });
    errno = ENOENT;
    std::raise(SIGUSR1);
    EXPECT_EQ(errno, ENOENT) << "the interrupted code may be about to look at it";
    wake.wait(-1, kForever);
    EXPECT_TRUE(wake.take());
    std::signal(SIGUSR1, before);
}

} // namespace
} // namespace isochron::stereo
