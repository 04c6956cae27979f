// A file that gets shorter, fails or is slow: one error line of its reader, and never a signal.
#include "index/error.h"
#include "index/extraction/extractor.h"
#include "index/file/index_file.h"
#include "index/indexing/index_build.h"
#include "index/system/input_file.h"
#include "index/system/parallel.h"
#include "index/system/request_ring.h"
#include "tests/support/gate.h"
#include "tests/support/memory_series.h"
#include "tests/support/reader_fixtures.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <sys/wait.h>
#include <unistd.h>

#include <atomic>
#include <filesystem>
#include <functional>
#include <random>
#include <thread>

namespace isochron::index {
namespace {

using testing::HasSubstr;

/// A file that gives a few bytes at a time, late, and on some day not at all.
class PoorSource final : public ByteSource {
  public:
    explicit PoorSource(const std::filesystem::path& path) : bytes_(read_file(path)) {}

    const std::string& name() const override { return name_; }
    std::uint64_t size() const override { return bytes_.size(); }

    std::atomic<bool> fails{false};
    std::atomic<std::uint64_t> most{~std::uint64_t{0}}; ///< bytes of one read
    std::atomic<std::uint64_t> ends{~std::uint64_t{0}};
    std::function<void()> at_read; ///< called at the begin of every read

  protected:
    std::size_t read_some(std::uint64_t offset, std::span<std::byte> out) const override {
        if (at_read)
            at_read();
        if (fails)
            throw Error(name_ + ": cannot be read: Input/output error");
        const std::uint64_t end = std::min<std::uint64_t>(bytes_.size(), ends);
        const std::uint64_t left = offset < end ? end - offset : 0;
        const std::size_t count = std::min({left, std::uint64_t{out.size()}, most.load()});
        std::memcpy(out.data(), bytes_.data() + offset, count);
        return count;
    }

  private:
    std::string name_ = "poor.isochron", bytes_;
};

class ByteSourceTest : public testing::Test {
  protected:
    ByteSourceTest() {
        MemorySeries series(field_.view());
        build_index(series, path_, {.with_tree = true});
        auto source = std::make_unique<PoorSource>(path_);
        source_ = source.get();
        file_ = IndexFile::open(std::move(source), 1);
    }

    test_support::TestFolder folder_;
    std::filesystem::path path_ = folder_.path() / "a.isochron";
    TestField field_{{40, 35, 37}, 3, ValueType::u8, moving_sphere};
    PoorSource* source_ = nullptr; ///< source of the file
    std::shared_ptr<const IndexFile> file_;
};

TEST_F(ByteSourceTest, FetchingReadsNothingForTheCallerAndLeavesErrorsToTheRead) {
    const auto source = open_bytes(path_);
    std::vector<std::byte> all(source->size());
    source->fetch(0, source->size(), {});
    EXPECT_EQ(source->bytes_read(), 0u);
    source->read(0, all);
    EXPECT_EQ(std::string(reinterpret_cast<const char*>(all.data()), all.size()), read_file(path_));
    std::filesystem::resize_file(path_, 100);
    EXPECT_NO_THROW(source->fetch(0, all.size(), {}));
    EXPECT_THROW(source->read(0, all), Error);
}

/// Places of a file that lie anywhere, and room for their bytes.
struct SomeReads {
    SomeReads(std::mt19937& random, std::uint64_t size, std::size_t count) {
        for (std::size_t i = 0; i < count; ++i) {
            const std::uint64_t offset = random() % size;
            bytes.emplace_back(random() % (std::min<std::uint64_t>(size - offset, 9000) + 1));
            ranges.push_back({offset, bytes.back().size()});
            reads.push_back({offset, bytes.back()});
        }
    }
    bool are_of(std::string_view file) const {
        for (std::size_t i = 0; i < reads.size(); ++i)
            if (file.substr(reads[i].offset, bytes[i].size()) !=
                std::string_view(reinterpret_cast<const char*>(bytes[i].data()), bytes[i].size()))
                return false;
        return true;
    }
    std::vector<std::vector<std::byte>> bytes;
    std::vector<ByteRange> ranges;
    std::vector<RangeRead> reads;
};

TEST_F(ByteSourceTest, RangesReadTogetherAreWhatTheyAreAloneForAnyNumberAndInSeveralThreads) {
    std::mt19937 random(test_seed());
    const auto source = open_bytes(path_);
    const std::string file = read_file(path_);
    for (const std::size_t count : {0u, 1u, 2u, 63u, 64u, 65u, 300u}) {
        SomeReads some(random, file.size(), count);
        const std::uint64_t before = source->bytes_read();
        source->expect_each(some.ranges);
        source->read_each(some.reads);
        EXPECT_TRUE(some.are_of(file)) << count;
        std::uint64_t bytes = 0;
        for (const ByteRange& range : some.ranges)
            bytes += range.bytes;
        EXPECT_EQ(source->bytes_read() - before, bytes);
    }
    std::vector<SomeReads> all;
    for (int i = 0; i < 4; ++i)
        all.emplace_back(random, file.size(), 150);
    {
        std::vector<std::jthread> threads;
        for (SomeReads& some : all)
            threads.emplace_back([&] {
                source->expect_each(some.ranges);
                source->read_each(some.reads);
            });
    }
    for (const SomeReads& some : all)
        EXPECT_TRUE(some.are_of(file));
}

TEST_F(ByteSourceTest, ARangeBehindTheEndOfAFileThatBecameShorterIsNamed) {
    std::mt19937 random(test_seed());
    const auto source = open_bytes(path_);
    SomeReads some(random, source->size(), 100);
    std::filesystem::resize_file(path_, 100);
    some.reads.push_back({50, some.bytes.emplace_back(51)});
    try {
        source->read_each(some.reads);
        FAIL() << "no error";
    } catch (const Error& error) {
        EXPECT_THAT(error.what(), HasSubstr("a.isochron: truncated: nothing at byte "));
    }
}

TEST_F(ByteSourceTest, AForkedProcessReadsRangesWithoutTheRequestsOfTheOther) {
    std::mt19937 random(test_seed());
    const auto source = open_bytes(path_);
    const std::string file = read_file(path_);
    const auto reads = [&] {
        SomeReads some(random, file.size(), 100);
        source->expect_each(some.ranges);
        source->read_each(some.reads);
        return some.are_of(file);
    };
    EXPECT_TRUE(reads());
    const pid_t child = ::fork();
    if (child == 0)
        ::_exit(reads() ? 0 : 1);
    EXPECT_TRUE(reads());
    int status = -1;
    ASSERT_EQ(::waitpid(child, &status, 0), child);
    EXPECT_EQ(status, 0);
}

TEST_F(ByteSourceTest, ARingSaysHowManyBytesOfEachRangeCame) {
    const auto ring = RequestRing::make();
    if (!ring)
        GTEST_SKIP() << "the system gives none";
    const std::string bytes = read_file(path_);
    const InputFile file(path_);
    std::vector<std::byte> room(70 * 10);
    std::vector<RangeRead> reads;
    for (std::size_t i = 0; i < 70; ++i) // the last ones reach over the end, and lie behind it
        reads.push_back({bytes.size() - 65 + i, std::span(room).subspan(10 * i, 10)});
    std::vector<std::size_t> got(70, 99);
    EXPECT_TRUE(ring->announce(file.descriptor(), {{{0, 4096}, {8192, 100}}}));
    for (int time = 0; time < 3; ++time) {
        ring->read(file.descriptor(), reads, got);
        for (std::size_t i = 0; i < 70; ++i) {
            EXPECT_EQ(got[i], i >= 65 ? 0 : std::min<std::size_t>(10, 65 - i));
            EXPECT_EQ(std::memcmp(reads[i].out.data(), bytes.data() + reads[i].offset, got[i]), 0);
        }
    }
    ring->read(-1, reads, got);
    EXPECT_EQ(got, std::vector<std::size_t>(70, 0)) << "there is no such file";
}

TEST_F(ByteSourceTest, ReadsThatComeInPiecesGiveTheSame) {
    source_->most = 7;
    EXPECT_EQ(search_in(file_)({Instant(1), 100.0}, {})->ids,
              BruteForce(field_.view(), 1).active(100.0));
    EXPECT_NO_THROW(file_->verify());
}

TEST_F(ByteSourceTest, AFailureIsOneLineOfEveryMethodAndTheNextSearchIsRight) {
    for (const SearchMethod method :
         {SearchMethod::bricks, SearchMethod::tree, SearchMethod::scan}) {
        const Search search = search_in(file_, method);
        source_->fails = true;
        try {
            search({Instant(2), 100.0}, {});
            FAIL() << "no error";
        } catch (const Error& error) {
            EXPECT_STREQ(error.what(), "poor.isochron: cannot be read: Input/output error");
        }
        source_->fails = false;
        EXPECT_EQ(search({Instant(2), 100.0}, {})->ids, BruteForce(field_.view(), 2).active(100.0));
    }
}

TEST_F(ByteSourceTest, AFileThatIsMadeShorterIsOneLineAndTheLastPictureStays) {
    const auto file = IndexFile::open(path_, 1);
    Extractor extractor(extract_from(file));
    extractor.request({.query = {Instant(0), {100.0}}, .ahead = {}});
    extractor.wait();
    const ExtractionPtr shown = extractor.newest();
    ASSERT_NE(shown, nullptr);
    std::filesystem::resize_file(path_, 5000);
    extractor.request({.query = {Instant(1), {120.0}}, .ahead = {}});
    extractor.wait();
    ASSERT_TRUE(extractor.failure());
    EXPECT_THAT(*extractor.failure(), HasSubstr("a.isochron: truncated: nothing at byte "));
    EXPECT_EQ(extractor.newest(), shown);
}

TEST_F(ByteSourceTest, ASlowDiskHoldsNobodyUpWhoAsks) {
    // Were a call to wait for the disk, the test would not come to an end.
    test_support::Gate disk;
    source_->at_read = [&] { disk.pass(); };
    Extractor extractor(extract_from(file_));
    extractor.request({.query = {Instant(0), {100.0}}, .ahead = {}});
    EXPECT_EQ(extractor.newest(), nullptr);
    EXPECT_TRUE(extractor.busy());
    disk.open();
    extractor.wait();
    EXPECT_EQ(extractor.newest()->surfaces[0].ids, BruteForce(field_.view(), 0).active(100.0));
}

TEST_F(ByteSourceTest, AnAbandonedSearchEndsWithTheReadsThatAreUnderWay) {
    const TestField field({36, 34, 800}, 1, ValueType::u8, moving_sphere);
    MemorySeries series(field.view());
    build_index(series, path_, {.tiers = TierSet().with(Tier::bricks)});
    // Each thread, and the one that asks ahead, may be under way, before the next look at the
    // token, with the tables of a layer and of its neighbors, which nothing keeps here, the one of
    // its chunks, and these.
    const unsigned under_way = 6 * (thread_count(0) + 1);
    for (const SearchMethod method : {SearchMethod::bricks, SearchMethod::scan})
        for (const unsigned abandoned_at : {1u, 4u, 20u}) {
            auto made = std::make_unique<PoorSource>(path_);
            PoorSource& source = *made;
            const Search search = search_in(IndexFile::open(std::move(made), 1), method);
            std::stop_source stop;
            std::atomic<unsigned> reads{0}, after{0};
            source.at_read = [&] {
                if (stop.stop_requested())
                    ++after;
                if (++reads == abandoned_at)
                    stop.request_stop();
            };
            EXPECT_EQ(search({Instant(0), 100.0}, stop.get_token()), nullptr);
            EXPECT_LE(after, under_way);
            source.at_read = [&] { ++reads; };
            reads = 0;
            EXPECT_EQ(search({Instant(0), 100.0}, {})->ids,
                      BruteForce(field.view(), 0).active(100.0));
            EXPECT_GT(reads, abandoned_at + 3 * under_way) << "there was nothing to abandon";
        }
}

TEST_F(ByteSourceTest, VerifyNoticesThatAnOpenFileHasBecomeShorter) {
    for (const std::uint64_t end : {std::uint64_t{0}, std::uint64_t{100}, std::uint64_t{4096},
                                    source_->size() / 4, source_->size() / 2}) {
        source_->ends = end;
        EXPECT_THROW(file_->verify(), Error) << end;
    }
}

} // namespace
} // namespace isochron::index
