// Indexes of data that were only to be looked at: kept, made again, and gone.
#include "app/commands/kept_index.h"

#include "index/file/index_file.h"
#include "tests/support/test_folder.h"

#include <gmock/gmock.h>

#include <thread>

namespace isochron::app {
namespace {

namespace fs = std::filesystem;
using test_support::TestFolder;

class KeptIndex : public testing::Test {
  protected:
    KeptIndex() { write('a'); }

    void write(char value) const { folder_.write("t.raw", std::string(64, value)); }
    fs::path kept(const BuildArguments& arguments, std::uint64_t most = kMostKeptBytes) const {
        testing::internal::CaptureStderr();
        fs::path path = kept_index(arguments, cache_, most);
        testing::internal::GetCapturedStderr();
        return path;
    }
    std::size_t count() const {
        return static_cast<std::size_t>(
            std::distance(fs::directory_iterator(cache_), fs::directory_iterator()));
    }

    TestFolder folder_;
    fs::path cache_ = folder_.path() / "cache" / "isochron";
    BuildArguments arguments_ = [this] {
        BuildArguments arguments;
        arguments.files = {(folder_.path() / "t.raw").string()};
        arguments.dims = {4, 4, 4};
        arguments.type = "u8";
        return arguments;
    }();
};

TEST_F(KeptIndex, IsMadeOnceForTheSameFilesAndOptions) {
    const fs::path first = kept(arguments_);
    const auto hash = index::IndexFile::open(first)->content_hash();
    const std::uintmax_t node = fs::hard_link_count(first);
    const std::string bytes = folder_.read("cache/isochron/" + first.filename().string());
    EXPECT_EQ(kept(arguments_), first);
    EXPECT_EQ(index::IndexFile::open(first)->content_hash(), hash);
    EXPECT_EQ(fs::hard_link_count(first), node);
    EXPECT_EQ(folder_.read("cache/isochron/" + first.filename().string()), bytes);
    EXPECT_EQ(count(), 1u);
    BuildArguments other = arguments_;
    other.read.value_unit = "K";
    EXPECT_NE(kept(other), first);
    EXPECT_EQ(count(), 2u);
}

TEST_F(KeptIndex, IsMadeAgainWhereAFileWasWrittenTo) {
    const fs::path first = kept(arguments_);
    const auto hash = index::IndexFile::open(first)->content_hash();
    std::this_thread::sleep_for(std::chrono::milliseconds(20)); // another time of writing
    write('b');
    EXPECT_EQ(kept(arguments_), first);
    EXPECT_NE(index::IndexFile::open(first)->content_hash(), hash);
    EXPECT_EQ(index::IndexFile::open(first)->stats().low, 'b');
}

TEST_F(KeptIndex, IsMadeAgainWhereItIsDamaged) {
    const fs::path first = kept(arguments_);
    fs::resize_file(first, 100);
    EXPECT_EQ(kept(arguments_), first);
    EXPECT_EQ(index::IndexFile::open(first)->stats().low, 'a');
}

TEST_F(KeptIndex, GoesWhereAllTakeMoreThanTheyMay) {
    BuildArguments other = arguments_;
    other.read.value_unit = "K";
    const fs::path oldest = kept(arguments_), used = kept(other);
    fs::last_write_time(oldest, fs::file_time_type::clock::now() - std::chrono::hours(2));
    fs::last_write_time(used, fs::file_time_type::clock::now() - std::chrono::hours(1));
    folder_.write("cache/isochron/notes.txt", "not ours");
    other.read.value_unit = "Pa";
    const fs::path newest = kept(other, fs::file_size(used) * 2 + 4096);
    EXPECT_FALSE(fs::exists(oldest));
    EXPECT_TRUE(fs::exists(used));
    EXPECT_TRUE(fs::exists(newest));
    EXPECT_TRUE(fs::exists(cache_ / "notes.txt"));
    other.read.value_unit = "s";
    const fs::path alone = kept(other, 1); // stays, however large it is
    EXPECT_TRUE(fs::exists(alone));
    EXPECT_EQ(count(), 2u);
}

} // namespace
} // namespace isochron::app
