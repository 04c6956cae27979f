// A new file appears complete or not at all, also beside leftovers of others.
#include "index/system/new_file.h"

#include "index/error.h"
#include "index/system/temporary_folder.h"
#include "tests/support/test_folder.h"

#include <gtest/gtest.h>

#include <array>
#include <chrono>
#include <csignal>
#include <fstream>
#include <span>
#include <string>
#include <vector>

#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

namespace isochron::index {
namespace {

namespace fs = std::filesystem;
using test_support::TestFolder;

void make_old(const fs::path& path) {
    fs::last_write_time(path, fs::file_time_type::clock::now() - std::chrono::minutes(5));
}

TEST(NewFile, RemovesOnlyOldFilesThatNobodyWrites) {
    const TestFolder folder;
    const fs::path killed = folder.write(".a.0001.tmp", "a part"),
                   fresh = folder.write(".a.0002.tmp", "a part"),
                   foreign = folder.write(".b.0003.tmp", "of another name"),
                   notes = folder.write("notes", "not to be touched");
    const fs::path pipe = folder.path() / ".a.0004.tmp", link = folder.path() / ".a.0005.tmp";
    ASSERT_EQ(mkfifo(pipe.c_str(), 0600), 0);
    fs::create_symlink(notes, link);
    NewFile living(folder.path() / "a", NewFile::Writers::several);
    for (const fs::path& each : {killed, foreign, notes, pipe, living.temporary()})
        make_old(each);
    NewFile file(folder.path() / "a");
    file.remove_remains(); // a pipe without a writer would have it wait for ever
    EXPECT_FALSE(fs::exists(killed));
    for (const fs::path& each : {fresh, foreign, notes, pipe, living.temporary()})
        EXPECT_TRUE(fs::exists(each)) << each;
    EXPECT_TRUE(fs::is_symlink(link));
}

TEST(NewFile, LiesWhereLinksLeadAndLeavesTheLinks) {
    const TestFolder folder;
    fs::create_directory(folder.path() / "scratch");
    fs::create_symlink("scratch/b", folder.path() / "a");
    fs::create_symlink("c", folder.path() / "scratch" / "b");
    for (int twice = 0; twice < 2; ++twice) { // where nothing is yet, and over an earlier one
        NewFile file(folder.path() / "a");
        EXPECT_EQ(file.temporary().parent_path().filename(), "scratch");
        file.commit();
        EXPECT_TRUE(fs::is_symlink(folder.path() / "a"));
        EXPECT_TRUE(fs::is_symlink(folder.path() / "scratch" / "b"));
        EXPECT_TRUE(fs::is_regular_file(fs::symlink_status(folder.path() / "scratch" / "c")));
    }
    fs::create_symlink("f", folder.path() / "e");
    fs::create_symlink("e", folder.path() / "f");
    EXPECT_THROW(NewFile{folder.path() / "e"}, Error) << "in a circle";
}

/// Ends as `kill -9` ends a command, with what it had begun.
template <class Work>
void killed_amid(const Work& work) {
    const pid_t child = ::fork();
    if (child == 0) {
        work();
        ::kill(::getpid(), SIGKILL);
    }
    int status = 0;
    ASSERT_EQ(::waitpid(child, &status, 0), child);
    ASSERT_TRUE(WIFSIGNALED(status));
}

void begin_file(const fs::path& path, NewFile::Writers writers = NewFile::Writers::one) {
    NewFile file(path, writers);
    const std::string text = "a part";
    file.write_at(0, std::as_bytes(std::span(text)));
    ::kill(::getpid(), SIGKILL);
}

TEST(NewFile, OfANewNameLeavesNothingWhenItsProcessIsKilled) {
    const TestFolder folder;
    killed_amid([&] { begin_file(folder.path() / "new"); });
    EXPECT_EQ(folder.names(), std::vector<std::string>{});
}

TEST(NewFile, IsWholeWhereAnotherTookTheNameMeanwhile) {
    const TestFolder folder;
    NewFile first(folder.path() / "a"), second(folder.path() / "a");
    const std::string one = "one", two = "two";
    first.write_at(0, std::as_bytes(std::span(one)));
    second.write_at(0, std::as_bytes(std::span(two)));
    first.commit();
    EXPECT_EQ(folder.read("a"), "one");
    second.commit();
    EXPECT_EQ(folder.read("a"), "two");
    EXPECT_EQ(folder.names(), std::vector<std::string>{"a"});
}

TEST(NewFile, IsReadableBeforeItHasAName) {
    const TestFolder folder;
    NewFile file(folder.path() / "a");
    const std::string text = "text";
    file.write_at(0, std::as_bytes(std::span(text)));
    EXPECT_FALSE(fs::exists(file.temporary()));
    std::ifstream in(file.path_to_open());
    std::string read;
    in >> read;
    EXPECT_EQ(read, "text");
}

TEST(LeftFiles, OfLivingProcessesStay) {
    const TestFolder folder;
    std::array<int, 2> alive{}, done{};
    ASSERT_EQ(::pipe(alive.data()), 0);
    ASSERT_EQ(::pipe(done.data()), 0);
    const pid_t child = ::fork();
    if (child == 0) {
        const TemporaryFolder temporary(folder.path() / "movie.mp4");
        const NewFile file(folder.path() / "several", NewFile::Writers::several);
        char byte = 0;
        const bool told = ::write(alive[1], &byte, 1) == 1;
        ::_exit(told && ::read(done[0], &byte, 1) == 1 ? 0 : 1);
    }
    char byte = 0;
    ASSERT_EQ(::read(alive[0], &byte, 1), 1);
    const auto there = folder.names();
    EXPECT_EQ(there.size(), 2u);
    for (const std::string& name : there)
        make_old(folder.path() / name);
    remove_remains_in(folder.path());
    EXPECT_EQ(folder.names(), there);
    ASSERT_EQ(::write(done[1], &byte, 1), 1);
    ::waitpid(child, nullptr, 0);
    for (const int each : {alive[0], alive[1], done[0], done[1]})
        ::close(each);
}

TEST(LeftFiles, AreRemovedByTheNextProcess) {
    const TestFolder folder;
    folder.write("replaced", "before");
    killed_amid([&] { begin_file(folder.path() / "replaced"); });
    killed_amid([&] { begin_file(folder.path() / "several", NewFile::Writers::several); });
    killed_amid([&] {
        const TemporaryFolder temporary(folder.path() / "movie.mp4");
        std::ofstream(temporary.path() / "movie.mp4") << "a part";
        ::kill(::getpid(), SIGKILL);
    });
    EXPECT_EQ(folder.names().size(), 4u);
    for (const std::string& name : folder.names())
        make_old(folder.path() / name);
    const fs::path fresh = folder.write(".new.isochron-00000001.tmp", "a part");
    remove_remains_in(folder.path());
    EXPECT_EQ(folder.names(), (std::vector<std::string>{fresh.filename(), "replaced"}));
    EXPECT_EQ(folder.read("replaced"), "before");
}

} // namespace
} // namespace isochron::index
