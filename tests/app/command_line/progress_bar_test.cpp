// The bar on a terminal, and its lines elsewhere.
#include "app/command_line/progress_bar.h"

#include "tests/support/eventually.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <poll.h>
#include <pty.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdio>
#include <string>

namespace isochron::app {
namespace {

using testing::HasSubstr;

/// What a terminal shows up to the end of its n-th line: a terminal passes on what is written to it
/// piece by piece.
std::string lines(int terminal, std::ptrdiff_t n) {
    std::string shown;
    std::array<char, 4096> bytes{};
    pollfd ready{terminal, POLLIN, 0};
    constexpr auto kPatience = std::chrono::milliseconds(test_support::kPatience);
    while (std::ranges::count(shown, '\n') < n &&
           ::poll(&ready, 1, static_cast<int>(kPatience.count())) == 1) {
        const ssize_t size = ::read(terminal, bytes.data(), bytes.size());
        if (size <= 0)
            break;
        shown.append(bytes.data(), static_cast<std::size_t>(size));
    }
    return shown;
}

TEST(ProgressBar, IsRedrawnInPlaceOnATerminal) {
    int ours = -1, theirs = -1;
    ASSERT_EQ(::openpty(&ours, &theirs, nullptr, nullptr, nullptr), 0);
    std::FILE* terminal = ::fdopen(theirs, "w");
    {
        ProgressBar bar(terminal);
        const index::Progress progress = bar.progress();
        progress("reading", 0.5);
        progress("reading", 0.501); // still 50 %: not drawn again
        progress("writing", 1);
    }
    const std::string shown = lines(ours, 2);
    EXPECT_THAT(shown, HasSubstr("reading          [############            ]  50 %"));
    EXPECT_EQ(shown.find("reading"), shown.rfind("reading"));
    EXPECT_THAT(shown, HasSubstr("writing          [########################] 100 %"));
    EXPECT_TRUE(shown.ends_with("\n")) << "the line of the last phase is ended";
    std::fclose(terminal);
    ::close(ours);
}

TEST(ProgressBar, IsOneLineForEachPhaseInALog) {
    std::FILE* log = std::tmpfile();
    ASSERT_TRUE(log);
    {
        ProgressBar bar(log);
        for (const double fraction : {0.0, 0.5, 1.0})
            bar.show("reading", fraction);
        bar.show("writing", 0.25);
    }
    std::rewind(log);
    std::array<char, 256> bytes{};
    const std::size_t size = std::fread(bytes.data(), 1, bytes.size(), log);
    EXPECT_EQ(std::string(bytes.data(), size), "reading ...\nwriting ...\n");
    std::fclose(log);
}

} // namespace
} // namespace isochron::app
