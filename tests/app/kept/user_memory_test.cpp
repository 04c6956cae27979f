// What the program remembers between sessions.
#include "app/kept/user_memory.h"
#include "tests/support/test_folder.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

namespace isochron::app {
namespace {

TEST(UserMemory, KeepsTheNewestDataThatAreStillThereAndEachOnce) {
    test_support::TestFolder folder, data;
    const auto file = [&](int i) { return data.path() / fmt::format("{}.isochron", i); };
    for (int i = 0; i < 14; ++i) {
        data.write(fmt::format("{}.isochron", i), "?");
        UserMemory(folder.path() / "made").remember(file(i));
    }
    UserMemory memory(folder.path() / "made");
    ASSERT_EQ(memory.recent().size(), UserMemory::kMost);
    EXPECT_EQ(memory.recent().front(), file(13));
    memory.remember(file(9));
    EXPECT_EQ(memory.recent().front(), file(9));
    EXPECT_EQ(memory.recent().size(), UserMemory::kMost);
    std::filesystem::remove(file(13));
    EXPECT_EQ(memory.recent()[1], file(12));
}

TEST(UserMemory, KeepsFoldersAndSeriesToo) {
    test_support::TestFolder folder, data;
    std::filesystem::create_directory(data.path() / "run");
    UserMemory memory(folder.path());
    memory.remember(data.path() / "run");
    memory.remember(data.path() / "run/t[0-9]*.vti");
    EXPECT_EQ(memory.recent().size(), 2u);
    std::filesystem::remove(data.path() / "run");
    EXPECT_TRUE(memory.recent().empty());
}

TEST(UserMemory, KeepsTheArrayThatWasChosenOfEachData) {
    test_support::TestFolder folder;
    UserMemory memory(folder.path());
    EXPECT_EQ(memory.array_of("/data/run.h5"), "");
    memory.remember_array("/data/run.h5", "rho");
    memory.remember_array("/data/run.h5.old", "u.magnitude");
    memory.remember_array("/data/run.h5", "fields/heat flux");
    EXPECT_EQ(memory.array_of("/data/run.h5"), "fields/heat flux");
    EXPECT_EQ(memory.array_of("/data/./run.h5.old"), "u.magnitude");
    for (int i = 0; i < 150; ++i)
        memory.remember_array(fmt::format("/data/{}", i), "p");
    EXPECT_EQ(memory.array_of("/data/run.h5"), "") << "the oldest go";
    EXPECT_EQ(memory.array_of("/data/149"), "p");
}

TEST(UserMemory, SaysOnceThatTheFirstLinesWereSeenAndNothingWithoutAFolder) {
    test_support::TestFolder folder;
    EXPECT_FALSE(UserMemory(folder.path()).introduced());
    UserMemory(folder.path()).set_introduced();
    EXPECT_TRUE(UserMemory(folder.path()).introduced());
    for (const std::optional<std::filesystem::path>& nowhere :
         {std::optional<std::filesystem::path>(), {"/proc/nothing"}}) {
        UserMemory memory(nowhere);
        memory.remember(folder.path() / "a.isochron");
        memory.set_introduced();
        EXPECT_TRUE(memory.recent().empty());
    }
    EXPECT_TRUE(UserMemory(std::nullopt).introduced());
}

} // namespace
} // namespace isochron::app
