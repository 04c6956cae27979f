// A new file appears complete or not at all, also beside leftovers of others.
#include "index/system/new_file.h"

#include "index/error.h"
#include "tests/support/test_folder.h"

#include <gtest/gtest.h>

#include <chrono>

#include <sys/stat.h>

namespace isochron::index {
namespace {

namespace fs = std::filesystem;

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
    NewFile living(folder.path() / "a");
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

} // namespace
} // namespace isochron::index
