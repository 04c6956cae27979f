// Indexes of data that were only to be looked at: kept, made again, and gone.
#include "app/indexing/kept_index.h"

#include "app/indexing/build_sources.h"
#include "app/indexing/file_patterns.h"
#include "index/file/index_file.h"
#include "index/indexing/index_build.h"
#include "tests/support/test_folder.h"

#include <gmock/gmock.h>

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
        fs::path path = kept_index(arguments, cache_, {}, most);
        testing::internal::GetCapturedStderr();
        return path;
    }
    std::size_t count() const {
        return static_cast<std::size_t>(
            std::distance(fs::directory_iterator(cache_), fs::directory_iterator()));
    }

    /// Gives a file another time of writing, however coarse the clock of the file system is.
    void make_later(const std::string& name) const {
        const fs::path file = folder_.path() / name;
        fs::last_write_time(file, fs::last_write_time(file) + std::chrono::seconds(7));
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
    write('b');
    make_later("t.raw");
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

/// Ends the making of an index.
struct Ended {};

class LargeKeptIndex : public KeptIndex {
  protected:
    static constexpr std::size_t kBytes = 224 * 224 * 224;
    LargeKeptIndex() {
        arguments_.dims = {224, 224, 224};
        for (int step = 0; step < 5; ++step) { // 54 MiB, nearly all of it holes
            const std::string name = "s" + std::to_string(step) + ".raw";
            folder_.write(name, std::string(1000, static_cast<char>('a' + step)));
            fs::resize_file(folder_.path() / name, kBytes);
        }
        arguments_.files = {(folder_.path() / "s*.raw").string()};
    }
    /// The numbers of steps that were reported, up to where it ends.
    std::vector<std::size_t> held(std::size_t end) {
        std::vector<std::size_t> steps;
        path_.clear();
        try {
            path_ =
                kept_index(arguments_, cache_,
                           {.held =
                                [&](const fs::path& path, std::size_t now) {
                                    steps.push_back(now);
                                    EXPECT_EQ(index::IndexFile::open(path)->info().steps(), now);
                                },
                            .progress =
                                [&](std::string_view, double fraction) {
                                    EXPECT_LE(fraction, 1);
                                    if (!steps.empty() && steps.back() >= end)
                                        throw Ended();
                                }});
        } catch (const Ended&) { // as it was asked to
        }
        return steps;
    }
    fs::path path_; ///< path of the complete index
};

TEST_F(LargeKeptIndex, HasItsFirstStepSoonAndGoesOnWhereItEnded) {
    EXPECT_THAT(held(2), testing::ElementsAre(1, 2));
    EXPECT_TRUE(path_.empty());
    EXPECT_EQ(count(), 1u) << "and nothing half made beside it";
    EXPECT_THAT(held(100), testing::ElementsAre(2, 4, 5));
    EXPECT_THAT(held(100), testing::ElementsAre(5)) << "it is complete";
    const BuildSources sources = open_sources(expand_patterns(arguments_.files), arguments_);
    const fs::path whole = folder_.path() / "whole.isochron";
    index::build_index(*sources.volume, whole, build_options(arguments_, sources));
    const auto expected = index::IndexFile::open(whole), made = index::IndexFile::open(path_);
    EXPECT_EQ(made->content_hash(), expected->content_hash());
    EXPECT_EQ(made->info().times, expected->info().times);
    EXPECT_EQ(made->info().sources, expected->info().sources);
    EXPECT_EQ(made->stats().high, expected->stats().high);
    made->verify();
}

TEST_F(LargeKeptIndex, IsBegunAnewWhereAFileWasWrittenToInBetween) {
    EXPECT_THAT(held(2), testing::ElementsAre(1, 2));
    folder_.write("s0.raw", std::string(kBytes, 'z'));
    make_later("s0.raw");
    EXPECT_THAT(held(100), testing::ElementsAre(1, 2, 4, 5));
    EXPECT_EQ(index::IndexFile::open(path_)->stats().high, 'z');
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
