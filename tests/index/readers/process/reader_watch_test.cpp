// When a reader is waited for no longer, by signs that the tests make up.
#include "index/readers/process/reader_watch.h"

#include "index/readers/process/message_socket.h"

#include <gtest/gtest.h>

namespace isochron::index {
namespace {

using std::chrono::seconds;

static_assert(ReaderWatch::kLook == MessageSocket::kAwait, "each wait is one look");

/// Looks at made-up signs until the watch says why it ends, at most for an hour.
/// @param next the signs of each look, by its number
template <class Next>
std::pair<double, std::string> ended_by(ReaderWatch& watch, const Next& next) {
    constexpr int kAnHour = 36'000;
    for (int look = 0; look < kAnHour; ++look)
        if (const auto why = watch.look(next(look)))
            return {std::chrono::duration<double>(look * ReaderWatch::kLook).count(), *why};
    return {-1, ""};
}

ReaderWatch watch_of(seconds patience, seconds of_bytes) {
    ReaderWatch watch;
    watch.begin(patience, of_bytes);
    return watch;
}

TEST(ReaderWatch, EndsOneThatDoesNothing) {
    auto watch = watch_of(seconds(60), seconds(5));
    const auto [after, why] = ended_by(watch, [](int) { return ProcessSigns{}; });
    EXPECT_EQ(after, 60);
    EXPECT_EQ(why, "its reader made no progress for 60 s and was stopped");
}

TEST(ReaderWatch, EndsOneThatTouchesAPageNowAndThen) {
    auto watch = watch_of(seconds(60), seconds(5));
    const auto [after, why] = ended_by(watch, [](int look) {
        return ProcessSigns{.touched = static_cast<std::uint64_t>(look / 300)};
    });
    EXPECT_EQ(after, 65);
    EXPECT_EQ(why, "its reader did nothing in 65 s of one request and was stopped");
}

TEST(ReaderWatch, EndsNoneThatWorksOrWaitsForADiskOrForAProcessor) {
    for (const auto& signs :
         {ProcessSigns{.waits_for_disk = true}, ProcessSigns{.runs = true}, ProcessSigns{}}) {
        auto watch = watch_of(seconds(60), seconds(0));
        const bool computes = !signs.waits_for_disk && !signs.runs;
        const auto [after, why] = ended_by(watch, [&](int look) {
            ProcessSigns now = signs;
            now.read = static_cast<std::uint64_t>(look); // it progresses
            if (computes)
                now.worked = std::chrono::milliseconds(look);
            return now;
        });
        EXPECT_EQ(after, -1) << why;
    }
}

TEST(ReaderWatch, CountsEachRequestByItself) {
    auto watch = watch_of(seconds(60), seconds(0));
    for (int look = 0; look < 590; ++look)
        ASSERT_FALSE(watch.look(ProcessSigns{}));
    watch.begin(seconds(60), seconds(0));
    EXPECT_EQ(ended_by(watch, [](int) { return ProcessSigns{}; }).first, 59.9);
}

} // namespace
} // namespace isochron::index
