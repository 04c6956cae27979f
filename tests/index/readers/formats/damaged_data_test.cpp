// Data with a wrong checksum, with bytes behind their declared end, or with wrong counts.
#include "index/readers/formats/open_series.h"
#include "tests/index/readers/formats/packed.h"
#include "tests/support/reader_fixtures.h"
#include "tests/support/test_seed.h"

#include <gmock/gmock.h>

#include <sys/stat.h>

#include <cstring>
#include <random>

namespace isochron::index {
namespace {

using testing::AllOf;
using testing::HasSubstr;

constexpr std::size_t kVerticesPerStep = 8 * 7 * 6;

std::string nrrd(const std::string& encoding, const std::string& more = "") {
    return "NRRD0004\ntype: float\ndimension: 4\nsizes: 8 7 6 2\nspacings: 1 1 1 1\nencoding: " +
           encoding + "\n" + more + "\n";
}
std::string mha(const std::string& more) {
    return "ObjectType = Image\nNDims = 4\nDimSize = 8 7 6 2\nElementType = MET_FLOAT\n" + more +
           "ElementDataFile = LOCAL\n";
}

/// A NIfTI-1 header of two steps of 8 x 7 x 6 f32.
std::string nifti_header() {
    std::string head(352, '\0');
    const auto put = [&](std::size_t offset, auto value) {
        std::memcpy(head.data() + offset, &value, sizeof value);
    };
    put(0, std::int32_t{348});
    const std::int16_t dim[8]{4, 8, 7, 6, 2, 1, 1, 1};
    std::memcpy(head.data() + 40, dim, sizeof dim);
    put(70, std::int16_t{16});
    put(72, std::int16_t{32});
    for (std::size_t i = 0; i < 8; ++i)
        put(76 + 4 * i, 1.0f);
    put(108, 352.0f);
    std::memcpy(head.data() + 344, "n+1", 4);
    return head;
}

class DamagedData : public testing::Test {
  protected:
    /// The values of both steps, first the second, then the first, as a viewer may ask for them.
    std::vector<float> read(const std::string& name, const std::string& bytes,
                            const ReadOptions& options = {}) const {
        const auto series = open_series({folder_.write(name, bytes)}, options);
        std::vector<float> values;
        for (std::size_t step = series->info().steps(); step-- > 0;)
            for (const float value : values_of<float>(*series, step))
                values.push_back(value);
        return values;
    }
    std::string complaint(const std::string& name, const std::string& bytes) const {
        return error_of([&] { read(name, bytes); });
    }

    const std::vector<float> values_ = [] {
        std::mt19937 random(test_seed());
        std::vector<float> values(2 * kVerticesPerStep);
        for (float& value : values)
            value = static_cast<float>(random() % 1000);
        return values;
    }();
    const std::string plain_ = text_of(values_);
    /// Each kind of compressed file, whole.
    const std::vector<std::pair<std::string, std::string>> packed_{
        {"a.nii.gz", gzip(nifti_header() + plain_)},
        {"a.nrrd", nrrd("gzip") + gzip(plain_)},
        {"b.nrrd", nrrd("bzip2") + bzip2(plain_)},
        {"a.mha", mha("CompressedData = True\n") + zlib(plain_)}};
    /// Each kind of file that is not.
    const std::vector<std::pair<std::string, std::string>> loose_{
        {"a.nii", nifti_header() + plain_},
        {"a.nrrd", nrrd("raw") + plain_},
        {"a.mha", mha("") + plain_},
        {"b.nrrd", nrrd("ascii") + as_words(values_)},
        {"b.mha", mha("BinaryData = False\n") + as_words(values_)}};
    TestFolder folder_;
};

TEST_F(DamagedData, NoFlippedBitOfWhatHasACheckChangesAValue) {
    std::mt19937 random(test_seed());
    for (const auto& [name, whole] : packed_) {
        const std::vector<float> good = read(name, whole);
        ASSERT_EQ(good.size(), values_.size());
        const std::size_t from = whole.size() - whole.size() / 2; // well behind the header
        int refused = 0;
        for (int i = 0; i < 200; ++i) {
            std::string damaged = whole;
            const std::size_t at = from + random() % (whole.size() - from);
            damaged[at] = static_cast<char>(damaged[at] ^ (1 << random() % 8));
            try {
                EXPECT_EQ(read(name, damaged), good) << name << ", byte " << at;
            } catch (const Error& error) {
                EXPECT_THAT(error.what(), HasSubstr(name));
                ++refused;
            }
        }
        EXPECT_GT(refused, 150) << name;
    }
}

TEST_F(DamagedData, ACheckThatIsCutOffIsMissed) {
    for (const auto& [name, whole] : packed_)
        for (const std::size_t cut : {1u, 3u})
            EXPECT_THAT(complaint(name, whole.substr(0, whole.size() - cut)),
                        AllOf(HasSubstr(name), HasSubstr("truncated")));
}

TEST_F(DamagedData, WhatIsLeftOverIsAnErrorThatSaysHowMuch) {
    ReadOptions allowed;
    allowed.allow_surplus = true;
    for (const auto& [name, whole] : loose_) {
        const std::string more = whole + (name.starts_with("b") ? " 1 23 \n" : "1 23");
        EXPECT_THAT(complaint(name, more),
                    AllOf(HasSubstr(name), HasSubstr("4 bytes follow the values of the 2 steps")));
        EXPECT_EQ(read(name, more, allowed), read(name, whole));
    }
    for (const auto& [name, whole] : packed_) {
        EXPECT_THAT(
            complaint(name, whole + "12345"),
            AllOf(HasSubstr(name), HasSubstr("5 bytes follow the end of the compressed data")));
        EXPECT_EQ(read(name, whole + "12345", allowed), read(name, whole));
    }
    const std::vector<std::pair<std::string, std::string>> longer{
        {"a.nii.gz", gzip(nifti_header() + plain_ + "1234567")},
        {"a.nrrd", nrrd("gzip") + gzip(plain_ + "1234567")},
        {"c.nrrd", nrrd("gzip") + gzip(plain_) + gzip("1234567")},
        {"b.nrrd", nrrd("bzip2") + bzip2(plain_ + "1234567")},
        {"a.mha", mha("CompressedData = True\n") + zlib(plain_ + "1234567")}};
    for (const auto& [name, whole] : longer) {
        EXPECT_THAT(complaint(name, whole),
                    AllOf(HasSubstr(name), HasSubstr("7 bytes follow the values of the 2 steps")));
        EXPECT_EQ(read(name, whole, allowed).size(), values_.size());
    }
}

TEST_F(DamagedData, StreamsInSeveralPartsAreOne) {
    const std::string nothing = gzip(""); // as bgzip ends its files
    const std::string half = plain_.substr(0, 1000), rest = plain_.substr(1000);
    EXPECT_EQ(read("a.nrrd", nrrd("gzip") + gzip(half) + gzip(rest) + nothing),
              read("a.nrrd", nrrd("raw") + plain_));
    EXPECT_EQ(read("a.nrrd", nrrd("bzip2") + bzip2(half) + bzip2(rest)),
              read("a.nrrd", nrrd("raw") + plain_));
}

TEST_F(DamagedData, StepsThatNoFileCanHoldAreRefusedBeforeAnythingIsMade) {
    const auto with_steps = [](const std::string& encoding, const std::string& steps) {
        return "NRRD0004\ntype: uchar\ndimension: 4\nsizes: 2 2 2 " + steps +
               "\nspacings: 1 1 1 1\nencoding: " + encoding + "\n\n";
    };
    // The file could hold them, compressed: 20 kB of bzip2 may be 40 GB.
    const std::string bomb =
        with_steps("bzip2", "4000000000") + bzip2(std::string(100, 'x')) + std::string(20'000, 'x');
    EXPECT_THAT(error_of([&] { open_series({folder_.write("bomb.nrrd", bomb)}); }),
                HasSubstr("bomb.nrrd: 4000000000 steps, at most 1048576 are supported"));
    const std::string lie = with_steps("raw", "9000000000000000000") + "12345678";
    EXPECT_THAT(error_of([&] { open_series({folder_.write("lie.nrrd", lie)}); }),
                HasSubstr("lie.nrrd: 9000000000000000000 steps, at most"));
}

TEST_F(DamagedData, LinesToSkipAreReadOnce) {
    const std::string lines(3'000'000, '\n');
    folder_.write("a.raw", lines + "x\n12345678");
    const auto header = [&](const std::string& data, const std::string& skip) {
        return folder_.write("a.nhdr", "NRRD0004\ntype: uchar\ndimension: 3\nsizes: 2 2 2\n"
                                       "encoding: raw\ndata file: " +
                                           data + "\nline skip: " + skip + "\n");
    };
    const auto series = open_series({header("a.raw", "3000001")});
    EXPECT_EQ(values_of<std::uint8_t>(*series, 0),
              (std::vector<std::uint8_t>{'1', '2', '3', '4', '5', '6', '7', '8'}));
    EXPECT_THAT(error_of([&] { open_series({header("a.raw", "9223372036854775807")}); }),
                HasSubstr("a.raw: truncated: 3000001 lines, expected 9223372036854775807 to skip"));
    EXPECT_THAT(error_of([&] { open_series({header("/dev/zero", "1")}); }),
                HasSubstr("/dev/zero: not a regular file"));
    ASSERT_EQ(::mkfifo((folder_.path() / "pipe").c_str(), 0600), 0);
    EXPECT_THAT(error_of([&] { open_series({header("pipe", "1")}); }),
                HasSubstr("pipe: not a regular file"));
}

TEST_F(DamagedData, AWordThatIsNoNumberIsShownInPart) {
    const std::string error = complaint("a.nrrd", nrrd("ascii") + std::string(100'000, '7') + "x");
    EXPECT_THAT(error, AllOf(HasSubstr("a.nrrd: `777"), HasSubstr("is not a value of the array")));
    EXPECT_LT(error.size(), 300u);
}

} // namespace
} // namespace isochron::index
