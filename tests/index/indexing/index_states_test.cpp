// The states of a growing index: what they leave in the file, and what is known of earlier ones.
#include "index/error.h"
#include "index/file/index_states.h"
#include "index/indexing/appended_series.h"
#include "index/indexing/index_build.h"
#include "index/system/growing_file.h"
#include "tests/support/memory_series.h"
#include "tests/support/reader_fixtures.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstring>
#include <random>

namespace isochron::index {
namespace {

using testing::HasSubstr;

class IndexStatesTest : public testing::Test {
  protected:
    StepValues first(std::size_t steps) const {
        StepValues values = field.view();
        values.steps = steps;
        return values;
    }
    void build(std::size_t steps) {
        MemorySeries series(first(steps));
        build_index(series, path, {});
    }
    /// Appends up to so many steps.
    void append(std::size_t steps) {
        const auto held = IndexFile::open(path);
        GrowingFile file(path, true);
        const auto series = append_to(held, "a", std::make_unique<MemorySeries>(first(steps)));
        append_index(*series, *held, file, path, {}, {}, *alone());
    }
    std::uint64_t section_bytes() const {
        std::uint64_t bytes = 0;
        const auto file = IndexFile::open(path);
        for (const Section& section : file->header().sections)
            bytes += section.bytes;
        return bytes;
    }
    /// Flips a bit.
    void damage(std::uint64_t offset) const {
        std::string bytes = read_file(path);
        bytes[offset] = static_cast<char>(bytes[offset] ^ 4);
        folder.write("a.isochron", bytes);
    }

    static constexpr std::uint32_t kSteps = 70;
    TestField field{{9, 8, 7}, kSteps, ValueType::u8, moving_sphere};
    TestFolder folder;
    std::filesystem::path path = folder.path() / "a.isochron";
};

/// A file that becomes another one after a number of reads.
class ChangingFile final : public ByteSource {
  public:
    struct Contents {
        const std::string* now;
        const std::string* later;
        std::size_t reads; ///< until then
    };
    explicit ChangingFile(Contents& contents) : contents_(contents), size_(contents.now->size()) {}
    const std::string& name() const override { return name_; }
    std::uint64_t size() const override { return size_; }

  protected:
    std::size_t read_some(std::uint64_t offset, std::span<std::byte> out) const override {
        if (contents_.reads-- == 0)
            contents_.now = contents_.later;
        const std::string& now = *contents_.now;
        const std::size_t count = std::min<std::size_t>(out.size(), now.size() - offset);
        std::memcpy(out.data(), now.data() + offset, count);
        return count;
    }

  private:
    Contents& contents_;
    std::uint64_t size_;
    std::string name_ = "memory";
};

TEST_F(IndexStatesTest, WhatManyAppendsLeaveBehindIsAFewTimesTheSections) {
    build(kSteps);
    const std::uint64_t anew = std::filesystem::file_size(path);
    build(1);
    for (std::size_t steps = 2; steps <= kSteps; ++steps) {
        append(steps);
        const auto file = IndexFile::open(path);
        ASSERT_NO_THROW(file->verify()) << steps;
        ASSERT_EQ(file->info().steps(), steps);
    }
    EXPECT_LT(std::filesystem::file_size(path),
              anew + 8 * section_bytes()); // sections of the last state
    const auto grown = IndexFile::open(path);
    build(kSteps);
    const auto whole = IndexFile::open(path);
    EXPECT_EQ(grown->content_hash(), whole->content_hash());
    EXPECT_EQ(grown->stats().counts, whole->stats().counts);
    for (std::uint32_t step = 0; step < kSteps; ++step)
        EXPECT_TRUE(std::ranges::equal(grown->load(step).values.step_bytes(step),
                                       field.view().step_bytes(step)));
}

TEST_F(IndexStatesTest, EveryStateThatAnIndexHasGrownFromIsKnown) {
    build(3);
    std::vector<std::uint64_t> hashes{IndexFile::open(path)->content_hash()};
    for (const std::size_t steps : {4, 7, 8, 20}) {
        append(steps);
        const auto file = IndexFile::open(path);
        EXPECT_EQ(file->metadata().earlier, hashes);
        hashes.push_back(file->content_hash());
        for (const std::uint64_t hash : hashes)
            EXPECT_TRUE(has_had(*file, hash));
        EXPECT_TRUE(has_had(*file, hashes.front(), 3));
        EXPECT_FALSE(has_had(*file, hashes.front(), 4));
        EXPECT_FALSE(has_had(*file, hashes.front() ^ 1));
    }
    // Built anew it has grown from nothing, and is known by its first steps all the same.
    build(20);
    EXPECT_TRUE(IndexFile::open(path)->metadata().earlier.empty());
    for (const std::uint64_t hash : hashes)
        EXPECT_TRUE(has_had(*IndexFile::open(path), hash));
}

TEST_F(IndexStatesTest, ANewestHeaderThatIsDamagedIsToldWhereWhatItNamesIsWhole) {
    std::mt19937 random(test_seed());
    build(3);
    for (std::size_t steps = 4; steps < 10; ++steps) {
        append(steps);
        const std::string whole = read_file(path);
        const auto newest = IndexFile::open(path);
        EXPECT_EQ(lost_state(*newest), std::nullopt);
        const std::uint64_t at = slot_of(newest->header()), other = kHeaderBytes - at;
        for (int i = 0; i < 20; ++i) {
            folder.write("a.isochron", whole);
            damage(at + random() % sizeof(FileHeader));
            if (at == 0 && read_file(path).substr(0, 16) != whole.substr(0, 16))
                continue; // no index any more
            const auto left = IndexFile::open(path);
            EXPECT_EQ(left->info().steps(), steps - 1);
            ASSERT_TRUE(lost_state(*left));
            EXPECT_THAT(*lost_state(*left),
                        HasSubstr(fmt::format("its first {} steps are what is left", steps - 1)));
        }
        // There is nothing to say of the older header, or of one whose sections are not there.
        folder.write("a.isochron", whole);
        damage(other + 24 + random() % 100);
        EXPECT_EQ(IndexFile::open(path)->info().steps(), steps);
        EXPECT_EQ(lost_state(*IndexFile::open(path)), std::nullopt);
        folder.write("a.isochron", whole);
        damage(at + 40);
        for (const Section& section : newest->header().sections)
            if (section.bytes > 0)
                damage(section.offset + random() % section.bytes);
        EXPECT_EQ(lost_state(*IndexFile::open(path)), std::nullopt);
        folder.write("a.isochron", whole);
    }
}

TEST_F(IndexStatesTest, WhoOpensItWhileTwoAppendsFinishSeesTheOldStateOrTheNew) {
    build(3);
    const std::string before = read_file(path);
    append(4);
    append(6);
    const std::string after = read_file(path);
    const auto hash_of = [&](const std::string& bytes) {
        folder.write("a.isochron", bytes);
        return IndexFile::open(path)->content_hash();
    };
    const std::uint64_t old_hash = hash_of(before), new_hash = hash_of(after);
    std::size_t once = 0, mixed = 0, old_states = 0; // opened in one go; from two states
    for (std::size_t reads = 0; reads < 40; ++reads) {
        ChangingFile::Contents contents{&before, &after, reads};
        try {
            IndexFile::open(std::make_unique<ChangingFile>(contents));
            ++once;
        } catch (const Error&) {
            ++mixed;
        }
        contents = {&before, &after, reads};
        const auto file = open_newest([&] { return std::make_unique<ChangingFile>(contents); });
        const bool old = file->info().steps() == 3;
        EXPECT_EQ(file->content_hash(), old ? old_hash : new_hash) << reads;
        old_states += old ? 1 : 0;
    }
    EXPECT_GT(once, 0u);
    EXPECT_GT(mixed, 0u) << "nothing was to be tried again";
    EXPECT_GT(old_states, 0u);
    EXPECT_LT(old_states, 40u);
    // What stays damaged is said, as it was.
    std::string damaged = before;
    folder.write("a.isochron", before);
    damaged[IndexFile::open(path)->header().section(SectionKind::metadata).offset] ^= 1;
    ChangingFile::Contents contents{&damaged, &damaged, 0};
    try {
        open_newest([&] { return std::make_unique<ChangingFile>(contents); });
        FAIL() << "no error";
    } catch (const Error& error) {
        EXPECT_THAT(error.what(), HasSubstr("the checksum of section metadata does not match"));
    }
}

} // namespace
} // namespace isochron::index
