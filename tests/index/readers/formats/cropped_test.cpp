// Parts of volumes: they lie where they lay, and have the values that they had.
#include "index/readers/formats/open_series.h"
#include "tests/support/reader_fixtures.h"

#include <gmock/gmock.h>

namespace isochron::index {
namespace {

using testing::Contains;
using testing::HasSubstr;

constexpr std::array<std::uint32_t, 3> kWhole{7, 6, 5};

std::uint8_t value_at(std::size_t x, std::size_t y, std::size_t z) {
    return static_cast<std::uint8_t>(x + kWhole[0] * (y + kWhole[1] * z));
}

class Cropped : public testing::Test {
  protected:
    std::unique_ptr<VolumeSeries> open(const ReadOptions& options) {
        return open_series({file_}, options);
    }

    /// Compares every value, whether the step is read or streamed.
    void expect_part(VolumeSeries& series, const std::array<std::uint32_t, 3>& first,
                     const std::array<std::uint32_t, 3>& stride,
                     const std::array<std::uint32_t, 3>& count) {
        ASSERT_EQ(series.info().grid.vertices, count);
        std::vector<std::uint8_t> wanted;
        for (std::uint32_t z = 0; z < count[2]; ++z)
            for (std::uint32_t y = 0; y < count[1]; ++y)
                for (std::uint32_t x = 0; x < count[0]; ++x)
                    wanted.push_back(value_at(first[0] + x * stride[0], first[1] + y * stride[1],
                                              first[2] + z * stride[2]));
        EXPECT_EQ(values_of<std::uint8_t>(series, 0), wanted);
        std::vector<std::uint8_t> streamed;
        series.stream(0, [&](std::span<const std::byte> piece) {
            for (const std::byte each : piece)
                streamed.push_back(static_cast<std::uint8_t>(each));
        });
        EXPECT_EQ(streamed, wanted);
    }

    TestFolder folder_;
    std::filesystem::path file_ =
        folder_.write("v.nrrd", "NRRD0004\ntype: uchar\ndimension: 3\nsizes: 7 6 5\nspace "
                                "dimension: 3\nspace directions: (0,2,0) (3,0,0) (0,0,-4)\nspace "
                                "origin: (10,20,30)\nencoding: raw\n\n" +
                                    text_of(ramp<std::uint8_t>(7 * 6 * 5)));
};

TEST_F(Cropped, PartsHaveTheirValuesAndTheirPlace) {
    ReadOptions options;
    options.crop = {{{1, 4}, {2, 5}, {3, 4}}};
    const auto series = open(options);
    expect_part(*series, {1, 2, 3}, {1, 1, 1}, {4, 4, 2});
    EXPECT_EQ(series->info().grid.origin, glm::dvec3(10 + 2 * 3, 20 + 1 * 2, 30 - 3 * 4));
    EXPECT_EQ(series->info().grid.spacing, glm::dvec3(2, 3, 4));
    EXPECT_THAT(series->info().notes, Contains(HasSubstr("vertices 1:4,2:5,3:4 of 7 x 6 x 5")));
}

TEST_F(Cropped, StridesTakeEachOfSoManyVertices) {
    ReadOptions options;
    options.stride = {{2, 3, 1}};
    const auto series = open(options);
    expect_part(*series, {0, 0, 0}, {2, 3, 1}, {4, 2, 5});
    EXPECT_EQ(series->info().grid.spacing, glm::dvec3(4, 9, 4));
    EXPECT_EQ(series->info().grid.origin, glm::dvec3(10, 20, 30));
    options.crop = {{{1, 6}, {0, 5}, {0, 4}}};
    expect_part(*open(options), {1, 0, 0}, {2, 3, 1}, {3, 2, 5});
}

TEST_F(Cropped, PartsThatThereAreNotAreRefused) {
    ReadOptions options;
    options.crop = {{{1, 7}, {2, 5}, {3, 4}}};
    EXPECT_THAT(error_of([&] { open(options); }),
                HasSubstr("--crop 1:7 along x, expected vertices of 0:6"));
    options.crop = {{{1, 6}, {5, 2}, {3, 4}}};
    EXPECT_THAT(error_of([&] { open(options); }), HasSubstr("--crop 5:2 along y"));
    options.crop = {{{1, 6}, {2, 5}, {4, 4}}};
    EXPECT_THAT(error_of([&] { open(options); }), HasSubstr("expected at least 2"));
}

} // namespace
} // namespace isochron::index
