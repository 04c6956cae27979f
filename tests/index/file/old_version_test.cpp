// Indices of file version 2 are refused in one line, and `build` reads them.
#include "index/error.h"
#include "index/file/index_series.h"
#include "index/indexing/index_build.h"
#include "tests/support/memory_series.h"
#include "tests/support/reader_fixtures.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

namespace isochron::index {
namespace {

using testing::HasSubstr;

/// Writes what version 2 wrote of a series with colors, as far as it can be read still.
class OldFile {
  public:
    OldFile(const StepValues& volume, const StepValues& colors, const Metadata& metadata)
        : bytes_(4096, '\0') {
        const std::vector<std::uint64_t> sums = checksums(volume);
        place(0, [&] { put_steps(volume); });
        for (std::size_t empty = 1; empty < 5; ++empty)
            place(empty, [] {});
        place(5, [&] { put(std::as_bytes(std::span(sums))); });
        const std::string text = to_json(metadata);
        place(6, [&] { put(std::as_bytes(std::span(text))); });
        const std::uint64_t sum = checksum_of(std::as_bytes(std::span(text)));
        std::memcpy(bytes_.data() + 32 + 6 * 24 + 16, &sum, sizeof sum);
        align();
        const std::uint64_t begin = bytes_.size();
        const std::vector<std::uint64_t> color_sums = checksums(colors);
        put(std::as_bytes(std::span(color_sums)));
        put_steps(colors);
        set(208, begin);
        set(216, bytes_.size() - begin);
        std::memcpy(bytes_.data(), "ISOCHRON", 8);
        const std::array<std::uint32_t, 2> head{2, 0x01020304};
        std::memcpy(bytes_.data() + 8, head.data(), sizeof head);
        set(16, bytes_.size());
    }
    std::string& bytes() { return bytes_; }

  private:
    void set(std::size_t at, std::uint64_t number) {
        std::memcpy(bytes_.data() + at, &number, sizeof number);
    }
    void align() { bytes_.resize((bytes_.size() + 63) / 64 * 64); }
    void put(std::span<const std::byte> bytes) {
        bytes_.append(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    }
    void put_steps(const StepValues& values) {
        for (std::size_t t = 0; t < values.steps; ++t) {
            align();
            put(values.step_bytes(t));
        }
        align();
    }
    template <class F>
    void place(std::size_t section, F&& write) {
        align();
        const std::uint64_t begin = bytes_.size();
        write();
        set(32 + section * 24, begin);
        set(32 + section * 24 + 8, bytes_.size() - begin);
    }
    static std::vector<std::uint64_t> checksums(const StepValues& values) {
        std::vector<std::uint64_t> sums;
        for (std::size_t t = 0; t < values.steps; ++t)
            sums.push_back(checksum_of(values.step_bytes(t)));
        return sums;
    }

    std::string bytes_;
};

class OldVersionTest : public testing::Test {
  protected:
    OldVersionTest() {
        MemorySeries series(volume_.view()), colors(colors_.view());
        series.info().length_unit = "mm";
        colors.info().array = "temperature";
        build_index(series, fresh_, {.color = &colors});
        const auto file = IndexFile::open(fresh_);
        Metadata metadata{.info = file->info(),
                          .stats = file->stats(),
                          .plan = file->plan(),
                          .tree = {},
                          .referral = {},
                          .color = *file->color()};
        OldFile old(volume_.view(), colors_.view(), metadata);
        std::ofstream(old_, std::ios::binary) << old.bytes();
        old.bytes()[4096 + 70] ^= 1;
        std::ofstream(damaged_, std::ios::binary) << old.bytes();
    }

    static ReadOptions of_array(const std::string& name) {
        ReadOptions options;
        options.array = name;
        return options;
    }
    std::string error_of(const std::function<void()>& work) {
        try {
            work();
        } catch (const Error& error) {
            return error.what();
        }
        return {};
    }

    test_support::TestFolder folder_;
    std::filesystem::path fresh_ = folder_.path() / "fresh.isochron",
                          old_ = folder_.path() / "old.isochron",
                          damaged_ = folder_.path() / "damaged.isochron";
    TestField volume_{{19, 18, 17}, 3, ValueType::f32, moving_sphere};
    TestField colors_{{19, 18, 17}, 3, ValueType::i16, moving_sphere};
};

TEST_F(OldVersionTest, IsRefusedInOneLineThatSaysWhatToDo) {
    EXPECT_THAT(error_of([&] { IndexFile::open(old_); }),
                HasSubstr("old.isochron: file version 2, this program reads versions 3 to 5; "
                          "isochron build"));
}

TEST_F(OldVersionTest, BecomesTheIndexThatItsSourcesGiveNow) {
    EXPECT_TRUE(is_index(old_));
    EXPECT_EQ(color_of_index(old_), "temperature");
    for (const std::filesystem::path& from : {old_, fresh_}) {
        const auto series = open_index_series(from, {});
        const auto colors = open_index_series(from, of_array("temperature"));
        EXPECT_EQ(series->info().length_unit, "mm");
        build_index(*series, folder_.path() / "new.isochron", {.color = colors.get()});
        EXPECT_EQ(read_file(folder_.path() / "new.isochron"), read_file(fresh_));
    }
    ReadOptions in_meters;
    in_meters.length_unit = "m";
    EXPECT_EQ(open_index_series(old_, in_meters)->info().length_unit, "m");
    EXPECT_THAT(error_of([&] { open_index_series(old_, of_array("pressure")); }),
                HasSubstr("has no array pressure, only test and temperature"));
}

TEST_F(OldVersionTest, IsCheckedWhileItIsRead) {
    const auto series = open_index_series(damaged_, {});
    EXPECT_THAT(error_of([&] { build_index(*series, folder_.path() / "new.isochron", {}); }),
                HasSubstr("damaged.isochron: damaged: the checksum of step 0 does not match"));
    EXPECT_FALSE(std::filesystem::exists(folder_.path() / "new.isochron"));
}

} // namespace
} // namespace isochron::index
