// A new file appears complete or not at all, also beside leftovers of others.
#include "index/system/new_file.h"

#include "index/error.h"
#include "index/system/temporary/temporary_folder.h"
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

TEST(NewFile, LeavesNothingWithoutACommitHoweverManyWrite) {
    const TestFolder folder;
    for (const auto writers : {NewFile::Writers::one, NewFile::Writers::several}) {
        NewFile(folder.path() / "new", writers).reserve(4096);
        EXPECT_TRUE(folder.names().empty());
    }
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

TEST(NewFile, OfANameThatIsThereLeavesNothingWhenItsProcessIsKilled) {
    const TestFolder folder;
    folder.write("replaced", "before");
    killed_amid([&] { begin_file(folder.path() / "replaced"); });
    EXPECT_EQ(folder.names(), std::vector<std::string>{"replaced"});
    EXPECT_EQ(folder.read("replaced"), "before");
}

/// What a killed process leaves: with a ledger of this test alone.
class LeftFiles : public testing::Test {
  protected:
    LeftFiles() { use_state(state.path()); }
    static void use_state(const fs::path& path) { setenv("XDG_STATE_HOME", path.c_str(), 1); }

    /// Leaves a temporary file and a temporary folder with a file in it, all of them old.
    void leave() const {
        killed_amid([&] { begin_file(folder.path() / "several", NewFile::Writers::several); });
        killed_amid([&] {
            const TemporaryFolder temporary(folder.path() / "movie.mp4", "movie");
            for (const char* name : {"movie.mp4", ".movie.gif.isochron-00000001.tmp"})
                std::ofstream(temporary.path() / name) << "a part";
            ::kill(::getpid(), SIGKILL);
        });
        for (const std::string& name : folder.names())
            make_old(folder.path() / name);
    }
    /// The name of what was left for this file.
    fs::path left_of(const std::string& file) const {
        for (const std::string& name : folder.names())
            if (name.starts_with("." + file + ".isochron-"))
                return folder.path() / name;
        return folder.path() / "nothing is left";
    }
    /// Runs another command in the folder.
    void next_process() const {
        const pid_t child = ::fork();
        if (child == 0) {
            remove_remains_in(folder.path());
            ::_exit(0);
        }
        ::waitpid(child, nullptr, 0);
    }
    std::vector<fs::path> ledger() const {
        std::vector<fs::path> entries;
        std::error_code none;
        for (const auto& entry :
             fs::directory_iterator(state.path() / "isochron" / "unfinished", none))
            entries.push_back(entry.path());
        return entries;
    }
    /// A folder that means a lot to its user, and whose name a neighbor has changed to `to`.
    void move_users_folder(const fs::path& to) const {
        fs::create_directories(folder.path() / "results" / "2024");
        folder.write("results/2024/thesis.txt", "years of work");
        folder.write("results/movie.txt", "notes");
        fs::rename(folder.path() / "results", to);
        make_old(to);
    }
    static void expect_whole(const fs::path& users) {
        EXPECT_TRUE(fs::exists(users / "2024" / "thesis.txt")) << users;
        EXPECT_TRUE(fs::exists(users / "movie.txt")) << users;
    }

    TestFolder state, folder;
};

TEST_F(LeftFiles, OfLivingProcessesStay) {
    std::array<int, 2> alive{}, done{};
    ASSERT_EQ(::pipe(alive.data()), 0);
    ASSERT_EQ(::pipe(done.data()), 0);
    const pid_t child = ::fork();
    if (child == 0) {
        const TemporaryFolder temporary(folder.path() / "movie.mp4", "movie");
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

TEST_F(LeftFiles, AreRemovedByTheNextProcess) {
    folder.write("replaced", "before");
    leave();
    EXPECT_EQ(folder.names().size(), 3u);
    EXPECT_EQ(ledger().size(), 2u);
    next_process();
    EXPECT_EQ(folder.names(), std::vector<std::string>{"replaced"});
    EXPECT_TRUE(ledger().empty());
}

TEST_F(LeftFiles, AreNoneWithoutAnEntryInTheLedger) {
    leave();
    const fs::path users = folder.path() / ".a.isochron-12345678.tmp",
                   file = folder.write(".b.isochron-12345678.tmp", "not of a command");
    move_users_folder(users);
    make_old(file);
    next_process();
    expect_whole(users);
    EXPECT_EQ(folder.names().size(), 2u);
}

TEST_F(LeftFiles, AreNoneWhereAnotherOneHasTheirName) {
    leave();
    for (const char* name : {"several", "movie.mp4"}) {
        const fs::path left = left_of(name);
        fs::rename(left, folder.path() / (std::string("away ") + name));
        move_users_folder(left);
    }
    next_process();
    expect_whole(left_of("several"));
    expect_whole(left_of("movie.mp4"));
    EXPECT_TRUE(ledger().empty()) << "what they name is gone";
}

TEST_F(LeftFiles, AreNoneThatWereBornLaterUnderTheSameNumber) {
    leave();
    for (const fs::path& entry : ledger()) { // as if the numbers had been used again
        std::string text = fs::read_symlink(entry).string();
        const std::size_t at = text.find(' ', text.find(' ') + 1) + 1;
        text[at] = text[at] == '1' ? '2' : '1';
        fs::remove(entry);
        fs::create_symlink(text, entry);
    }
    next_process();
    EXPECT_EQ(folder.names().size(), 2u);
}

TEST_F(LeftFiles, InAFolderAreOnlyThoseThatItsProcessWrote) {
    leave();
    const fs::path left = left_of("movie.mp4");
    fs::create_directories(left / "movie" / "2024");
    std::ofstream(left / "thesis.txt") << "years of work";
    make_old(left);
    next_process();
    EXPECT_TRUE(fs::exists(left / "thesis.txt"));
    EXPECT_TRUE(fs::exists(left / "movie" / "2024"));
    EXPECT_FALSE(fs::exists(left / "movie.mp4"));
}

TEST_F(LeftFiles, OfAProcessThatEndsAreNotWhatTookTheirName) {
    fs::path name;
    {
        const TemporaryFolder temporary(folder.path() / "movie.mp4", "movie");
        name = temporary.path();
        fs::rename(name, folder.path() / "away");
        move_users_folder(name);
    }
    expect_whole(name);
    {
        const NewFile file(folder.path() / "several", NewFile::Writers::several);
        name = file.temporary();
        fs::rename(name, folder.path() / "away too");
        std::ofstream(name) << "years of work";
    }
    EXPECT_TRUE(fs::exists(name));
    EXPECT_TRUE(ledger().empty());
}

TEST_F(LeftFiles, AreNotAFolderThatHasItsName) {
    const fs::path name = folder.path() / "movie", other = folder.path() / "other";
    {
        TemporaryFolder temporary(name, "frame_");
        std::ofstream(temporary.path() / "frame_0.png") << "a picture";
        EXPECT_FALSE(temporary.take_name(name));
        EXPECT_TRUE(ledger().empty());
    }
    fs::create_directory(other);
    EXPECT_TRUE(fs::exists(name / "frame_0.png"));
    EXPECT_EQ(fs::status(name).permissions(), fs::status(other).permissions());
    TemporaryFolder second(name, "frame_");
    EXPECT_TRUE(second.take_name(name)) << "something is there";
    EXPECT_EQ(fs::status(second.path()).permissions(), fs::perms::owner_all);
}

TEST_F(LeftFiles, AreLeftAloneWhereNoLedgerCanBeKept) {
    const fs::path ours = state.path() / "isochron" / "unfinished";
    const auto stay = [&](const char* why) {
        leave();
        next_process();
        EXPECT_EQ(folder.names().size(), 2u) << why;
        for (const std::string& name : folder.names())
            fs::remove_all(folder.path() / name);
    };
    use_state("/proc/none");
    stay("no folder");
    use_state(state.path());
    fs::create_directories(ours);
    fs::permissions(ours, fs::perms::all);
    stay("others could have written in it");
    fs::remove(ours);
    fs::create_directory(state.path() / "elsewhere");
    fs::permissions(state.path() / "elsewhere", fs::perms::owner_all);
    fs::create_directory_symlink(state.path() / "elsewhere", ours);
    stay("it is elsewhere");
}

TEST_F(LeftFiles, AreInALedgerThatSeveralProcessesKeepAndThatNeverGrowsLong) {
    const fs::path path = state.path() / "isochron" / "unfinished";
    std::vector<pid_t> children;
    for (int child = 0; child < 4; ++child) {
        children.push_back(::fork());
        if (children.back() != 0)
            continue;
        const fs::path own = folder.path() / std::to_string(child);
        for (int i = 0; i < 20; ++i) {
            NewFile(own, NewFile::Writers::several).commit();
            const TemporaryFolder temporary(own, "movie");
        }
        ::_exit(0);
    }
    for (const pid_t child : children)
        ::waitpid(child, nullptr, 0);
    EXPECT_EQ(folder.names().size(), 4u);
    EXPECT_TRUE(ledger().empty()) << "all are committed";
    EXPECT_EQ(fs::status(path).permissions(), fs::perms::owner_all);
    for (int i = 0; i < 1100; ++i)
        fs::create_symlink("1 2 3 /gone/.a.isochron-12345678.tmp", path / std::to_string(i));
    fs::create_symlink("/home", path / "no entry");
    next_process();
    EXPECT_EQ(ledger().size(), 1000u);
}

} // namespace
} // namespace isochron::index
